#include "geometry/box_pairs.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <utility>

#include "parallel.hpp"
#include "stop.hpp"

namespace kreisel::core {
namespace {

using Visit = std::function<void(std::uint32_t, std::uint32_t)>;

/// Boxes that are near each other, and those of other parts that reach in.
struct Part {
  std::span<NumberedBox> own;
  std::vector<NumberedBox> guests;
};

NumberedBox around(std::span<const NumberedBox> boxes) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  NumberedBox all{Eigen::Vector3f::Constant(infinity), Eigen::Vector3f::Constant(-infinity), 0};
  for (const NumberedBox& b : boxes) {
    all.lo = all.lo.cwiseMin(b.lo);
    all.hi = all.hi.cwiseMax(b.hi);
  }
  return all;
}

/// Along the longest side of what lies around them.
std::array<Part, 2> halved(const Part& part) {
  const NumberedBox all = around(part.own);
  int axis = 0;
  (all.hi - all.lo).maxCoeff(&axis);
  const auto middle = part.own.begin() + std::ptrdiff_t(part.own.size() / 2);
  std::nth_element(part.own.begin(), middle, part.own.end(), [&](const NumberedBox& a, const NumberedBox& b) {
    return a.lo[axis] + a.hi[axis] < b.lo[axis] + b.hi[axis];
  });
  std::array<Part, 2> halves = {Part{{part.own.begin(), middle}, {}}, Part{{middle, part.own.end()}, {}}};
  for (const std::size_t k : {0u, 1u}) {
    const NumberedBox here = around(halves[k].own);
    const auto let_in = [&](std::span<const NumberedBox> boxes) {
      for (const NumberedBox& b : boxes)
        if (b.meets(here)) halves[k].guests.push_back(b);
    };
    let_in(part.guests);
    let_in(halves[1 - k].own);
  }
  return halves;
}

void visit_all(const Part& part, const Visit& visit) {
  stop_here();
  constexpr std::size_t few = 16;
  if (part.own.size() > few) {
    for (const Part& half : halved(part)) visit_all(half, visit);
    return;
  }
  for (std::size_t i = 0; i < part.own.size(); ++i) {
    const NumberedBox& a = part.own[i];
    for (const NumberedBox& b : part.own.subspan(i + 1))
      if (a.meets(b)) visit(std::min(a.number, b.number), std::max(a.number, b.number));
    for (const NumberedBox& b : part.guests)  // where `b` is at home, `a` is a guest
      if (a.number < b.number && a.meets(b)) visit(a.number, b.number);
  }
}

}  // namespace

void for_each_overlap(std::vector<NumberedBox> boxes, const Visit& visit) {
  constexpr std::size_t enough_for_any_machine = 256, worth_a_thread = 4096;
  std::vector<Part> parts(1);
  parts[0].own = boxes;
  while (parts.size() < enough_for_any_machine && parts[0].own.size() > worth_a_thread) {
    std::vector<Part> halves(2 * parts.size());
    parallel_for(parts.size(), [&](std::size_t i) {
      auto [one, other] = halved(std::exchange(parts[i], {}));
      halves[2 * i] = std::move(one);
      halves[2 * i + 1] = std::move(other);
    });
    parts = std::move(halves);
  }
  parallel_for(parts.size(), [&](std::size_t i) { visit_all(std::exchange(parts[i], {}), visit); });
}

}  // namespace kreisel::core
