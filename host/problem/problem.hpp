// problem.hpp - which problems there are, by name.
#pragma once

#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "body/body.hpp"
#include "kreisel/problem.hpp"
#include "registry.hpp"
#include "settings/settings.hpp"

namespace kreisel::core {

using kreisel::Convexity;
using kreisel::Filling;
using kreisel::Goal;
using kreisel::LinearConstraints;
using kreisel::Nonlinear;
using kreisel::Poses;
using kreisel::Problem;
using kreisel::Ratio;
using kreisel::Traits;
using kreisel::Verdict;
using kreisel::Water;

/// Largest violation of the problem's constraints, body units; of nonlinear rows where they are in the
/// moments alone.
[[nodiscard]] double violation(const Problem& problem, const Moments& s);

/// What a finished part of a problem does when it is set in motion.
enum class Moves { nothing, spins, topples, heels };

/// How all orientations of a body are mapped.
struct MapCases {
  std::string setting = {};              ///< that tells the cases apart; empty: there is one case
  std::vector<std::string> values = {};  ///< of it, where nobody names others
  std::string usual = {};                ///< the one that a problem has by itself
};

/// By how much a solid misses what was asked; NaN where nothing of the kind was.
struct Misses {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();
  double centre_of_mass_mm = none;
  double axis_degrees = none;  ///< between the axis and the nearest principal one
  double excess_mass = none;   ///< above the displaced fluid's, as a share of that
};

/// What `design` makes of a problem.
struct Made {
  std::string help = {};       ///< what a maker gets; empty: the problem's summary
  SettingTexts settings = {};  ///< where a maker is better served by others than a researcher
  /// Fields of how the body lies and is shaped that count; nothing: the direction that the problem goes by.
  std::optional<std::vector<std::string_view>> shape = {};
};

/// One line of `bench list` and the way to make the problem.
struct ProblemEntry {
  std::string name, summary;
  /// @param body  what is to spin, stand or float; not kept
  std::function<std::unique_ptr<Problem>(const Settings& settings, const Body& body)> make;
  /// The settings with which a solid is judged as it is; nothing when the problem asks for more than a solid
  /// has.
  std::optional<SettingTexts> for_solid = {};
  /// Needs no more of a body than its frame and its moments: can judge what nobody has a surface of.
  bool by_moments = false;
  bool upright = false;                   ///< goes by the body's up direction, not by its spin axis
  SettingTable settings = {};             ///< that `make` reads
  std::vector<std::string> weights = {};  ///< those of them that say what f is
  bool centred = false;  ///< the body frame's origin is its centre of mass where no point is given
  /// Which way the rays of a domain had best run, model coordinates, where the problem leaves that open and
  /// its settings tell; nothing: along the body's own axis. Such rays serve no other question.
  std::function<std::optional<Vec3>(const Settings& settings, const Body& body)> rays = {};
  Made made = {};
  std::string verb = {};  ///< what the body is to do; empty: as the problem is called
  Moves moves = Moves::nothing;
  std::optional<MapCases> map = {};  ///< nothing: orientations are not mapped
  /// From a verdict's values on a solid; nothing: nobody can say.
  std::function<Misses(const std::map<std::string, double>& values, const Settings& settings)> misses = {};
  Poses poses = Poses::none;  ///< what `auto` may choose
  std::string chosen = {};    ///< the setting that takes `auto`
  /// The settings that `auto` in it stands for, in any order; nothing: `make` takes them as they
  /// are.
  std::function<std::vector<Settings>(const Settings& settings, const Body& body)> choices = {};

  /// @throws InputError  an unknown setting, or a value that does not fit
  [[nodiscard]] Settings read(const SettingTexts& given) const {
    return settings.read(given, "problem", name);
  }

  /// What f weighs by as long as nothing else is said.
  [[nodiscard]] SettingTexts usual_weights() const;

  /// A body as this problem poses it.
  [[nodiscard]] BodySpec posed(BodySpec spec) const {
    spec.stands_upright = upright;
    spec.centred = centred;
    return spec;
  }
};

/// Those that there are, and such as were added.
[[nodiscard]] Registry<ProblemEntry>& problems();

/// @throws InputError  unknown problem (names those there are)
[[nodiscard]] const ProblemEntry& find_problem(std::string_view name);

/// @throws InputError  unknown problem, unknown or unfit setting, or a body the problem makes no sense for
[[nodiscard]] std::unique_ptr<Problem> make_problem(std::string_view name, const SettingTexts& settings,
                                                    const Body& body);

}  // namespace kreisel::core
