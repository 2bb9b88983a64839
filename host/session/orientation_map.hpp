// orientation_map.hpp - one body, one domain, every orientation: where it can spin, or float. [docs/map.md]
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "session/map_run.hpp"
#include "session/session.hpp"
#include "session/sweep.hpp"
#include "solve/solver.hpp"

namespace kreisel::core {

/// What is asked.
struct MapSpec {
  MapRun config;           ///< body (its axis and up lay the rays of the one domain), problem, grid, wall
  std::vector<Vec3> axes;  ///< model coordinates, any length but zero; z of the problem's frame
  std::vector<std::string> drafts;  ///< a case each: values of MapCases::setting
  Through through = Through::lowest;
};

/// With the directions it asks for; at the cases of its problem where it names none.
[[nodiscard]] MapSpec map_spec(const MapRun& map);

/// The map. Answers of axis a and case c stand at a * cases.size() + c.
struct OrientationMap {
  MapRun config;
  Through through = Through::lowest;
  Provenance provenance;
  std::string body_name;
  double length_mm = 1, mass_unit_grams = 1;
  Frame frame;  ///< of the domain
  Grid grid;
  double wall = 0;     ///< body units
  std::string domain;  ///< exact or columns
  std::size_t rays = 0;

  std::vector<std::string> cases;    ///< values of MapCases::setting; else one, without a name
  std::vector<Vec3> axes, contacts;  ///< of those answered, model coordinates (mm), in the order given
  std::vector<MapAnswer> answers;
  std::size_t asked = 0;  ///< axes; more than were answered when the user stopped it
  double setup_seconds = 0, sweep_seconds = 0;

  [[nodiscard]] const MapAnswer& at(std::size_t axis, std::size_t at_case) const {
    return answers[axis * cases.size() + at_case];
  }
  [[nodiscard]] std::size_t count(std::size_t at_case, MapAnswer::Status status) const;
  [[nodiscard]] std::size_t count_ok(std::size_t at_case) const;

  struct Place {
    std::size_t axis, at_case;
  };
  /// The best of those whose verdict is good, else of the feasible ones, by Problem::pose_loss(): to spin, of
  /// least objective; to float, of largest metacentric height. Nothing when none is.
  [[nodiscard]] std::optional<Place> best() const;

  /// The line that makes, writes and verifies the part of one place: `bench --axis ... --contact ...`.
  [[nodiscard]] std::string command(Place place) const;
};

/// Solves every axis and case over the one domain, each by itself: the answers depend on no order.
///
/// On Ctrl-C it ends early and keeps what is done, spread evenly over the axes.
/// @throws InputError   bad configuration or mesh, a problem that is not mapped, no axes
/// @throws Interrupted  before the sweep began
[[nodiscard]] OrientationMap map_orientations(Session& session, const MapSpec& spec,
                                              const Control& control = {});

}  // namespace kreisel::core
