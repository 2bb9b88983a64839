#include "formulation/leaves.hpp"

#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>

#include "parallel.hpp"

namespace kreisel::core {
namespace {

constexpr std::size_t piece = 1 << 14;  // leaves that are worth a thread: some tenths of a millisecond

std::uint64_t volume_of(const Cube& cube) { return std::uint64_t{cube.edge} * cube.edge * cube.edge; }

bool is_full(const Cube& cube, const CubeSums& sums) { return voxels(sums) == volume_of(cube); }

/// Is the cube one of the parts, of whatever size, of `parent`?
bool holds(const Cube& parent, const Cube& cube) {
  const int mask = ~(parent.edge - 1);
  return cube.edge < parent.edge && (cube.x & mask) == parent.x && (cube.y & mask) == parent.y &&
         (cube.z & mask) == parent.z;
}

/// Moments of a cube that is interior all through: box_moments() of its place on the grid.
void put_full(const Grid& grid, const Cube& cube, double* s) {
  const double edge = grid.h * cube.edge, half = edge / 2;
  const double x = grid.face(0, cube.x) + half, y = grid.face(1, cube.y) + half,
               z = grid.face(2, cube.z) + half;
  const double volume = edge * edge * edge, own = edge * edge / 12;
  s[S1] = volume;
  s[SX] = volume * x;
  s[SY] = volume * y;
  s[SZ] = volume * z;
  s[SXY] = volume * x * y;
  s[SYZ] = volume * y * z;
  s[SXZ] = volume * x * z;
  s[SXX] = volume * (x * x + own);
  s[SYY] = volume * (y * y + own);
  s[SZZ] = volume * (z * z + own);
}

/// Cube::child() of every part, in order: a cube is one word, and so is the step to a part.
void put_children(const Cube& cube, Cube* out) {
  constexpr auto word = [](int x, int y, int z, int edge) {
    return std::bit_cast<std::uint64_t>(Cube{static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y),
                                             static_cast<std::uint16_t>(z),
                                             static_cast<std::uint16_t>(edge)});
  };
  const int half = cube.edge / 2, shift = std::countr_zero(static_cast<unsigned>(half));
  const std::uint64_t first = word(cube.x, cube.y, cube.z, half);
  for (int part = 0; part < 8; ++part)
    out[part] = std::bit_cast<Cube>(first + (word(part & 1, part >> 1 & 1, part >> 2, 0) << shift));
}

/// Calls body(begin, end) for pieces of [0, size) on all threads.
template <class Body>
void for_pieces(std::size_t size, const Body& body) {
  parallel_for((size + piece - 1) / piece,
               [&](std::size_t p) { body(p * piece, std::min(size, (p + 1) * piece)); });
}

}  // namespace

CubeSums Leaves::sums(std::size_t leaf) const {
  const auto at = std::ranges::lower_bound(mixed_, leaf, {}, &Mixed::leaf);
  return at != mixed_.end() && at->leaf == leaf ? at->sums : full_cube(cubes_[leaf].edge);
}

std::uint64_t Leaves::voxels(std::size_t leaf) const { return kreisel::core::voxels(sums(leaf)); }

void Leaves::start(int edge) {
  cubes_ = uniform_cubes(grid_, edge);
  const std::vector<CubeSums> sums = kernel_(cubes_);
  size_ = 0;
  mixed_.clear();
  for (std::size_t c = 0; c < sums.size(); ++c) {
    if (kreisel::core::voxels(sums[c]) == 0) continue;
    if (!is_full(cubes_[c], sums[c])) mixed_.push_back({static_cast<std::uint32_t>(size_), sums[c]});
    cubes_[size_++] = cubes_[c];
  }
}

void Leaves::moments(Eigen::Matrix<double, 10, Eigen::Dynamic>& all) const {
  all.resize(10, static_cast<Eigen::Index>(size_));
  for_pieces(size_, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) put_full(grid_, cubes_[c], all.data() + 10 * c);
    for (auto at = std::ranges::lower_bound(mixed_, begin, {}, &Mixed::leaf);
         at != mixed_.end() && at->leaf < end; ++at)
      all.col(at->leaf) = moments_of(grid_, cubes_[at->leaf], at->sums);
  });
}

std::vector<std::uint8_t> Leaves::split(std::span<const std::uint8_t> marked) {
  std::vector<Cube> cut;
  for (const Mixed& m : mixed_)
    if (marked[m.leaf])
      for (int part = 0; part < 8; ++part) cut.push_back(cubes_[m.leaf].child(part));
  const std::vector<CubeSums> of_cut = kernel_(cut);

  std::vector<std::uint8_t> count(size_);
  for (std::size_t c = 0; c < size_; ++c) count[c] = static_cast<std::uint8_t>(1 + 7 * marked[c]);
  std::size_t next = 0;
  for (const Mixed& m : mixed_)
    if (marked[m.leaf]) {
      const auto parts = std::span(of_cut).subspan(next, 8);
      count[m.leaf] = static_cast<std::uint8_t>(
          std::ranges::count_if(parts, [](const CubeSums& sums) { return kreisel::core::voxels(sums) > 0; }));
      next += 8;
    }
  std::vector<std::size_t> first = {0};  // of what comes of each piece
  for (std::size_t c = 0; c < size_; c += piece)
    first.push_back(
        std::accumulate(count.begin() + c, count.begin() + std::min(size_, c + piece), first.back()));
  if (spare_.size() < first.back()) spare_.resize(first.back());
  // Where not all eight parts hold interior, they come below.
  for_pieces(size_, [&](std::size_t begin, std::size_t end) {
    Cube* out = spare_.data() + first[begin / piece];
    for (std::size_t c = begin; c < end; out += count[c++])
      if (!marked[c])
        *out = cubes_[c];
      else if (count[c] == 8)
        put_children(cubes_[c], out);
  });
  std::vector<Mixed> mixed;
  mixed.reserve(mixed_.size());
  std::size_t leaf = 0, at = 0;  // of these, and of those that come
  next = 0;
  for (const Mixed& m : mixed_) {
    if (m.leaf / piece > leaf / piece) leaf = m.leaf / piece * piece, at = first[m.leaf / piece];
    at = std::accumulate(count.begin() + leaf, count.begin() + m.leaf, at);
    leaf = m.leaf;
    if (!marked[leaf]) {
      mixed.push_back({static_cast<std::uint32_t>(at), m.sums});
      continue;
    }
    std::size_t to = at;
    for (const std::size_t end = next + 8; next < end; ++next) {
      if (kreisel::core::voxels(of_cut[next]) == 0) continue;
      spare_[to] = cut[next];
      if (!is_full(cut[next], of_cut[next])) mixed.push_back({static_cast<std::uint32_t>(to), of_cut[next]});
      ++to;
    }
  }
  size_ = first.back();
  std::swap(cubes_, spare_);
  mixed_ = std::move(mixed);
  return count;
}

std::vector<Leaves::Family> Leaves::siblings(
    int most_edge, const std::function<bool(std::size_t begin, std::size_t end)>& agree) const {
  const std::span<const Cube> all = cubes();
  std::vector<Family> families;
  for (std::size_t c = 0; c < size_;) {
    const Cube parent = all[c].parent();
    std::size_t end = c + 1;
    bool whole = false;
    if (parent.edge <= most_edge && (c == 0 || !holds(parent, all[c - 1]))) {
      while (end < size_ && all[end].edge == all[c].edge && holds(parent, all[end])) ++end;
      whole = (end == size_ || !holds(parent, all[end])) && agree(c, end);
    }
    if (!whole) end = c + 1;
    families.push_back(
        {static_cast<std::uint32_t>(c), static_cast<std::uint32_t>(end), whole ? parent : all[c]});
    c = end;
  }
  return families;
}

void Leaves::merge(std::span<const Family> families) {
  std::vector<Mixed> mixed;
  auto of_old = mixed_.begin();
  for (std::size_t i = 0; i < families.size(); ++i) {
    const auto& [begin, end, cube] = families[i];
    const auto first = of_old;
    while (of_old != mixed_.end() && of_old->leaf < end) ++of_old;
    if (cube == cubes_[begin]) {
      if (first != of_old) mixed.push_back({static_cast<std::uint32_t>(i), first->sums});
    } else {
      CubeSums whole{};
      for (std::size_t c = begin; c < end; ++c) {
        const CubeSums part = in_parent(sums(c), cubes_[c]);
        for (std::size_t k = 0; k < whole.size(); ++k) whole[k] += part[k];
      }
      if (!is_full(cube, whole)) mixed.push_back({static_cast<std::uint32_t>(i), whole});
    }
    cubes_[i] = cube;  // families are no more than the leaves before them
  }
  size_ = families.size();
  mixed_ = std::move(mixed);
}

}  // namespace kreisel::core
