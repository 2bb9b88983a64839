// arrow_layout.cpp - where the entries of an arrow go: one copy a run of the caller's values, no search.
#include <algorithm>
#include <utility>

#include "solve/arrow.hpp"

namespace kreisel {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// Where each row of K is.
struct Place {
  enum { border, single, block } kind = border;
  int index = 0, in_block = 0;
};

std::vector<Place> places_of(int size, const ArrowShape& shape) {
  std::vector<Place> places(at(size));
  const auto number = [&](const std::vector<int>& rows, decltype(Place::kind) kind) {
    for (std::size_t k = 0; k < rows.size(); ++k) places[at(rows[k])] = {kind, static_cast<int>(k), 0};
  };
  number(shape.border, Place::border);
  number(shape.singles, Place::single);
  for (std::size_t b = 0; b < shape.blocks.size(); ++b)
    for (std::size_t k = 0; k < shape.blocks[b].size(); ++k)
      places[at(shape.blocks[b][k])] = {Place::block, static_cast<int>(b), static_cast<int>(k)};
  return places;
}

/// The pair of an entry with the one nearer to the border last.
std::pair<Place, Place> ordered(const std::vector<Place>& places, const Pattern& p, std::size_t e) {
  Place a = places[at(p.rows[e] - p.base)], b = places[at(p.columns[e] - p.base)];
  if (a.kind == Place::border && b.kind != Place::border) std::swap(a, b);
  return {a, b};
}

void add_once(std::vector<int>& all, int value) {
  if (const auto where = std::ranges::lower_bound(all, value); where == all.end() || *where != value)
    all.insert(where, value);
}

std::size_t position(const std::vector<int>& all, int value) {
  return static_cast<std::size_t>(std::ranges::lower_bound(all, value) - all.begin());
}

}  // namespace

std::unique_ptr<Arrow> Arrow::of(const Pattern& pattern) {
  auto shape = ArrowShape::of(pattern);
  return shape ? std::make_unique<Arrow>(pattern, std::move(*shape)) : nullptr;
}

Arrow::Arrow(const Pattern& pattern, ArrowShape shape) : size_(pattern.size), shape_(std::move(shape)) {
  for (std::vector<int>& rows : shape_.blocks) blocks_.push_back({rows, {}, 0});
  lay_out(pattern);
}

void Arrow::lay_out(const Pattern& pattern) {
  const std::vector<Place> places = places_of(size_, shape_);
  const std::size_t entries = pattern.rows.size();
  std::vector<char> tied(shape_.border.size());
  for (std::size_t e = 0; e < entries; ++e)
    if (const auto [a, b] = ordered(places, pattern, e); b.kind == Place::border) {
      if (a.kind == Place::single) tied[at(b.index)] = 1;
      if (a.kind == Place::block) add_once(blocks_[at(a.index)].tied, b.index);
    }
  for (std::size_t k = 0; k < tied.size(); ++k)
    if (tied[k]) tied_.push_back(static_cast<int>(k));

  const std::size_t singles = shape_.singles.size(), border = shape_.border.size();
  border_at_ = singles * (1 + tied_.size());
  std::size_t end = border_at_ + border * border;
  for (Block& block : blocks_) {
    block.at = end;
    end += block.rows.size() * (block.rows.size() + block.tied.size());
  }
  store_.resize(end);

  const auto slot = [&](std::size_t e) {
    const auto [a, b] = ordered(places, pattern, e);
    if (a.kind == Place::border)
      return border_at_ + at(std::min(a.index, b.index)) * border + at(std::max(a.index, b.index));
    if (a.kind == Place::single)
      return at(a.index) + (b.kind == Place::border ? (1 + position(tied_, b.index)) * singles : 0);
    const Block& block = blocks_[at(a.index)];
    const std::size_t rows = block.rows.size();
    const std::size_t column =
        b.kind == Place::border ? rows + position(block.tied, b.index) : at(std::min(a.in_block, b.in_block));
    const int row = b.kind == Place::border ? a.in_block : std::max(a.in_block, b.in_block);
    return block.at + column * rows + at(row);
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

}  // namespace kreisel
