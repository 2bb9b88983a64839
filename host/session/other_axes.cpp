#include "session/other_axes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "physics/units.hpp"
#include "session/orientation_map.hpp"

namespace kreisel::core {
namespace {

std::string options_of(const OrientationMap& map, std::size_t axis) {
  const Vec3 &a = map.axes[axis], &c = map.contacts[axis];
  return fmt::format("--axis {:.4f},{:.4f},{:.4f} --contact {:.3f},{:.3f},{:.3f}", a[0], a[1], a[2], c[0],
                     c[1], c[2]);
}

}  // namespace

std::string other_axes(Session& session, const RunConfig& config, const Vec3& asked, const Control& control) {
  MapRun coarse;
  static_cast<Asked&>(coarse) = config;
  coarse.formulation = MapRun().formulation;
  coarse.solver = MapRun().solver;
  coarse.grid = {};
  coarse.grid.resolution = 48;
  coarse.domain.clear();
  std::erase_if(coarse.settings, [](const auto& setting) { return !setting.first.starts_with("problem."); });
  coarse.body.contact.reset();
  coarse.axes = 500;
  const OrientationMap map = map_orientations(session, map_spec(coarse), control);
  const std::size_t good = map.count_ok(0);
  if (good == 0)
    return fmt::format("none of {} axes through the lowest point will do either", map.axes.size());
  const auto angle = [&](std::size_t a) {
    return std::acos(std::clamp(map.axes[a].normalized().dot(asked.normalized()), -1.0, 1.0));
  };
  std::size_t nearest = map.axes.size();
  for (std::size_t a = 0; a < map.axes.size(); ++a)
    if (map.at(a, 0).verdict.ok && (nearest == map.axes.size() || angle(a) < angle(nearest))) nearest = a;
  return fmt::format("{} of {} other axes will do: the nearest, {:.0f} degrees off, {}; the best {}", good,
                     map.axes.size(), degrees(angle(nearest)), options_of(map, nearest),
                     options_of(map, map.best()->axis));
}

}  // namespace kreisel::core
