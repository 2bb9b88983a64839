#include "physics/spin_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "error.hpp"
#include "parallel.hpp"
#include "physics/units.hpp"

namespace kreisel::core {
namespace {

SpinAtSpeed at_speed(const RigidBody& body, double length_mm, double rpm, const Motion& motion) {
  const double second = seconds_per_unit(length_mm);
  SpinAtSpeed answer{rpm, steady_spin(body, rpm / rpm_per_unit(length_mm), radians(near_axis)),
                     degrees(motion.largest_tilt), motion.fell_at};
  if (answer.steady) answer.steady->growth /= second;
  if (answer.fell_at) *answer.fell_at *= second;
  return answer;
}

Motion motion_at(const RigidBody& body, double length_mm, double rpm, const SpinCheckOptions& options,
                 int samples) {
  const MotionOptions motion{options.seconds / seconds_per_unit(length_mm), samples, radians(fallen),
                             options.stop};
  const auto start = options.contact == Contact::free ? free_start : tilted_start;
  return simulate(body, start(body, rpm / rpm_per_unit(length_mm), radians(options.tilt_degrees)), motion);
}

}  // namespace

std::optional<std::string> SpinCheckOptions::invalid() const {
  if (!(rpm > 0) || !std::isfinite(rpm)) return fmt::format("a speed of {} rpm; expected more than 0", rpm);
  if (!(tilt_degrees > 0 && tilt_degrees < near_axis))
    return fmt::format("a tilt of {} degrees; expected more than 0 and less than {}", tilt_degrees,
                       near_axis);
  if (!(seconds > 0) || !std::isfinite(seconds))
    return fmt::format("{} seconds; expected more than 0", seconds);
  for (const double speed : scan_rpm)
    if (!(speed > 0) || !std::isfinite(speed))
      return fmt::format("a speed of {} rpm in the scan; expected more than 0", speed);
  return std::nullopt;
}

SpinCheck check_spin(const Moments& s, double length_mm, const SpinCheckOptions& options) {
  if (const auto wrong = options.invalid()) throw InputError(*wrong);
  const RigidBody body = make_rigid_body(s, options.contact);
  constexpr int samples = 1000;
  SpinCheck check;
  for (std::size_t i = 0; i < contacts.size(); ++i)
    check.stable_rpm[i] = stable_rpm(s, length_mm, contacts[i].first);
  check.motion = motion_at(body, length_mm, options.rpm, options, samples);
  check.at_speed = at_speed(body, length_mm, options.rpm, check.motion);
  for (double& time : check.motion.times) time *= seconds_per_unit(length_mm);
  for (double& tilt : check.motion.tilts) tilt = degrees(tilt);
  check.scan.resize(options.scan_rpm.size());
  parallel_for(check.scan.size(), [&](std::size_t i) {
    const double rpm = options.scan_rpm[i];
    check.scan[i] = at_speed(body, length_mm, rpm, motion_at(body, length_mm, rpm, options, 1));
  });
  return check;
}

std::vector<SpeedRange> stable_rpm(const Moments& s, double length_mm, Contact contact) {
  std::vector<SpeedRange> ranges = stable_speeds(make_rigid_body(s, contact));
  for (SpeedRange& range : ranges) {
    range.low *= rpm_per_unit(length_mm);
    range.high *= rpm_per_unit(length_mm);
  }
  return ranges;
}

std::string describe(const std::vector<SpeedRange>& rpm) {
  if (!rpm.empty() && rpm[0].low == 0 && std::isinf(rpm[0].high)) return "at any speed";
  std::vector<std::string> parts;
  for (const SpeedRange& range : rpm)
    parts.push_back(std::isinf(range.high) ? fmt::format("above {:.1f}", range.low)
                                           : fmt::format("{:.1f} to {:.1f}", range.low, range.high));
  return parts.empty() ? "at no speed" : fmt::format("{} rpm", fmt::join(parts, ", "));
}

}  // namespace kreisel::core
