#include "mesh/solid/orient.hpp"

#include <algorithm>
#include <utility>

#include "mesh/query/sides.hpp"
#include "mesh/solid/self_intersections.hpp"
#include "stop.hpp"

namespace kreisel::core {
namespace {

constexpr std::uint32_t none = (std::uint32_t{1} << Side::triangle_bits) - 1;

/// Across one side of a triangle: the neighbour, and whether the two run the same way along the edge.
struct Neighbour {
  std::uint32_t triangle : Side::triangle_bits = none;
  bool conflict : 1 = false;
};

std::vector<Neighbour> neighbours(const TriangleMesh& mesh) {
  std::vector<Neighbour> across(3 * mesh.triangles.size());
  for_each_edge(sorted_sides(mesh), [&](auto first, auto last) {
    if (last - first != 2) return;
    const bool conflict = first[0].forward == first[1].forward;
    for (const std::size_t k : {0u, 1u})
      across[3 * std::size_t{first[k].triangle} + first[k].corner] = {first[1 - k].triangle, conflict};
  });
  return across;
}

void turn(Triangle& t) { std::swap(t[1], t[2]); }

/// An inside-out shell that runs through one that is not may be meant: what it takes away is for the user to
/// say.
void leave_those_that_meet_others(const TriangleMesh& mesh, const std::vector<Shell>& all,
                                  const std::vector<std::vector<std::uint32_t>>& enclosing,
                                  std::vector<bool>& turns) {
  if (std::ranges::all_of(turns, [](bool t) { return t; })) return;
  std::vector<std::uint32_t> shell_of(mesh.triangles.size());
  for (std::uint32_t i = 0; i < all.size(); ++i)
    for (const std::uint32_t t : all[i].triangles) shell_of[t] = i;
  DisjointSets together(all.size());
  for (const auto& [s, t] : self_intersections(mesh)) together.join(shell_of[s], shell_of[t]);
  std::vector<bool> stays(all.size(), false);
  for (std::uint32_t i = 0; i < all.size(); ++i)
    if (enclosing[i].empty() && !turns[i]) stays[together.find(i)] = true;
  for (std::uint32_t i = 0; i < all.size(); ++i) turns[i] = turns[i] && !stays[together.find(i)];
}

}  // namespace

std::size_t orient_shells(TriangleMesh& mesh) {
  const std::vector<Neighbour> across = neighbours(mesh);
  enum State : char { unseen, keep, flip };
  std::vector<char> state(mesh.triangles.size(), unseen);
  std::size_t turned = 0;
  for (std::uint32_t seed = 0; seed < state.size(); ++seed) {
    if (state[seed] != unseen) continue;
    std::vector<std::uint32_t> shell{seed};
    state[seed] = keep;
    std::size_t flips = 0;
    bool orientable = true;
    for (std::size_t next = 0; next < shell.size(); ++next) {
      stop_here();
      for (std::size_t k = 0; k < 3; ++k) {
        const Neighbour n = across[3 * std::size_t{shell[next]} + k];
        if (n.triangle == none) continue;
        const char wanted = (state[shell[next]] == flip) != n.conflict ? flip : keep;
        if (state[n.triangle] == unseen) {
          state[n.triangle] = wanted;
          flips += wanted == flip;
          shell.push_back(n.triangle);
        } else if (state[n.triangle] != wanted) {
          orientable = false;
        }
      }
    }
    if (!orientable) continue;
    const char fewest = 2 * flips <= shell.size() ? flip : keep;
    for (const std::uint32_t t : shell)
      if (state[t] == fewest) {
        turn(mesh.triangles[t]);
        ++turned;
      }
  }
  return turned;
}

std::size_t face_outward(TriangleMesh& mesh, const std::vector<Shell>& all) {
  const auto enclosing = enclosing_shells(mesh, all);
  std::vector<bool> turns(all.size());
  for (std::uint32_t i = 0; i < all.size(); ++i) turns[i] = enclosing[i].empty() && all[i].volume < 0;
  if (std::ranges::find(turns, true) == turns.end()) return 0;
  leave_those_that_meet_others(mesh, all, enclosing, turns);
  const auto inside_out = [&](std::uint32_t i) { return enclosing[i].empty() && turns[i]; };
  std::size_t turned = 0;
  for (std::uint32_t i = 0; i < all.size(); ++i) {
    bool flip = inside_out(i);
    for (const std::uint32_t outer : enclosing[i]) flip = flip || inside_out(outer);
    if (!flip) continue;
    for (const std::uint32_t t : all[i].triangles) turn(mesh.triangles[t]);
    ++turned;
  }
  return turned;
}

}  // namespace kreisel::core
