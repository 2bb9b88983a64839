// arrow_layout.cpp - where the entries of an arrow go: one copy a run of the caller's values, no search.
#include <algorithm>
#include <utility>

#include "solve/arrow.hpp"

namespace kreisel::core {
namespace {

std::size_t whole(int i) { return static_cast<std::size_t>(i); }

/// Where each row of K is.
struct Place {
  int group = -1;  ///< none: the border
  int index = 0;   ///< of the block in its group, or in the border
  int row = 0;     ///< of the block
};

std::vector<Place> places_of(int size, const std::vector<int>& border,
                             const std::vector<ArrowGroup>& groups) {
  std::vector<Place> places(whole(size));
  for (std::size_t k = 0; k < border.size(); ++k) places[whole(border[k])] = {-1, static_cast<int>(k), 0};
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (std::size_t b = 0; b < groups[g].count(); ++b)
      for (int i = 0; i < groups[g].rows(); ++i)
        places[whole(groups[g].row(b, i))] = {static_cast<int>(g), static_cast<int>(b), i};
  return places;
}

/// The pair of an entry with the one nearer to the border last.
std::pair<Place, Place> ordered(const std::vector<Place>& places, const Pattern& p, std::size_t e) {
  Place a = places[whole(p.rows[e] - p.base)], b = places[whole(p.columns[e] - p.base)];
  if (a.group < 0) std::swap(a, b);
  return {a, b};
}

}  // namespace

std::unique_ptr<Arrow> Arrow::of(const Pattern& pattern) {
  const auto shape = ArrowShape::of(pattern);
  return shape ? std::make_unique<Arrow>(pattern, *shape) : nullptr;
}

Arrow::Arrow(const Pattern& pattern, const ArrowShape& shape)
    : size_(pattern.size), own_border_(shape.border) {
  for (std::size_t k = 0; k < shape.blocks.size(); ++k)
    if (!shape.blocks[k].empty()) groups_.emplace_back(static_cast<int>(k) + 1, shape.blocks[k]);
  lay_out(pattern);
}

void Arrow::lay_out(const Pattern& pattern) {
  const std::vector<Place> places = places_of(size_, own_border_, groups_);
  const std::size_t entries = pattern.rows.size(), border = own_border_.size();
  std::vector<std::vector<char>> tied(groups_.size(), std::vector<char>(border));
  for (std::size_t e = 0; e < entries; ++e)
    if (const auto [a, b] = ordered(places, pattern, e); a.group >= 0 && b.group < 0)
      tied[whole(a.group)][whole(b.index)] = 1;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    std::vector<int> ties;
    for (std::size_t k = 0; k < border; ++k)
      if (tied[g][k]) ties.push_back(static_cast<int>(k));
    border_at_ = groups_[g].lay_out(std::move(ties), border_at_);
  }
  const std::size_t end = border_at_ + border * border;
  store_.resize(end);

  const auto slot = [&](std::size_t e) {
    const auto [a, b] = ordered(places, pattern, e);
    if (a.group < 0)
      return border_at_ + whole(std::min(a.index, b.index)) * border + whole(std::max(a.index, b.index));
    const ArrowGroup& group = groups_[whole(a.group)];
    return b.group < 0 ? group.tie(whole(a.index), a.row, b.index) : group.own(whole(a.index), a.row, b.row);
  };
  std::vector<bool> written(end);
  for (std::size_t e = 0; e < entries; ++e) {
    const std::size_t to = slot(e);
    const bool first = !written[to];
    written[to] = true;
    if (!runs_.empty() && runs_.back().first == first && runs_.back().to + runs_.back().count == to)
      ++runs_.back().count;
    else
      runs_.push_back({e, to, 1, first});
  }
}

}  // namespace kreisel::core
