// spin_check.hpp - does a finished body spin? Spectrum and motion at a speed, and over a range of them.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "physics/motion.hpp"
#include "physics/steady_spin.hpp"

namespace kreisel::core {

/// Degrees: a body that has no steady spin within this of its axis, or whose motion strays by more, does not
/// spin about it. Small tilts swing up to a few times as far and come back; what falls goes on.
inline constexpr double near_axis = 10, fallen = 60;

struct SpinCheckOptions {
  Contact contact = Contact::gliding;
  double rpm = 0;                     ///< > 0
  double tilt_degrees = 1;            ///< at the start; > 0, below near_axis
  double seconds = 10;                ///< > 0
  std::vector<double> scan_rpm = {};  ///< speeds > 0, each by spectrum and motion
  std::function<bool()> stop = {};    ///< ends motions early

  /// What is wrong, with what was expected.
  [[nodiscard]] std::optional<std::string> invalid() const;
};

/// One speed.
struct SpinAtSpeed {
  double rpm = 0;
  std::optional<SteadySpin> steady;  ///< within near_axis; growth in 1/s
  double largest_tilt = 0;           ///< of the motion, degrees
  std::optional<double> fell_at;     ///< seconds

  [[nodiscard]] bool stable() const { return steady && steady->stable(); }
  [[nodiscard]] bool stays() const { return largest_tilt <= near_axis; }
};

struct SpinCheck {
  /// stable_speeds() of each of `contacts`, revolutions per minute.
  std::array<std::vector<SpeedRange>, contacts.size()> stable_rpm;
  SpinAtSpeed at_speed;
  Motion motion;                  ///< at that speed; seconds and degrees
  std::vector<SpinAtSpeed> scan;  ///< one for each of options.scan_rpm
};

/// @param s          about the tip, z along the axis; body units
/// @param length_mm  one body length
/// @throws InputError   options that are invalid()
[[nodiscard]] SpinCheck check_spin(const Moments& s, double length_mm, const SpinCheckOptions& options);

/// stable_speeds() in revolutions per minute.
[[nodiscard]] std::vector<SpeedRange> stable_rpm(const Moments& s, double length_mm, Contact contact);

/// "480.2 to 510.0, above 612.4 rpm", "at any speed", or "at no speed".
[[nodiscard]] std::string describe(const std::vector<SpeedRange>& rpm);

}  // namespace kreisel::core
