#include "session/inspect_print.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <utility>

#include "error.hpp"
#include "problem/problem.hpp"
#include "stop.hpp"

namespace kreisel::core {
namespace {

/// A body of which no more is known than its moments.
Body body_of(const PrintedBody& printed, const Moments& mass, const Vec3& axis, const Vec3& contact) {
  Body body;
  body.name = printed.label;
  body.axis = axis;
  body.contact = contact;
  body.density = body.interior_density = 1e3 * printed.mass / printed.volume;
  const double length = std::cbrt(printed.volume);
  body.frame = {axis_to_z(axis), contact, length};
  const Moments laid = transformed(transformed(mass, Eigen::Matrix3d::Identity(), -contact),
                                   body.frame.rotation, Vec3::Zero());
  body.solid = scaled(laid, 1 / length, length * length * length / printed.mass);
  return body;
}

std::map<std::string, Verdict> verdicts_of(const PrintedBody& printed, const Moments& mass, const Vec3& foot,
                                           const PrintQuestion& question) {
  std::map<std::string, Verdict> verdicts;
  const Vec3 axis = question.axis.value_or(Vec3::UnitZ());
  const Body body = body_of(printed, mass, axis.normalized(), question.contact.value_or(foot));
  for (const ProblemEntry& entry : problems()) {
    const bool asked = entry.name == question.problem;
    if (!entry.by_moments || !(asked || (question.problem.empty() && entry.for_solid))) continue;
    const Settings settings = entry.read(asked ? question.settings : *entry.for_solid);
    verdicts[entry.name] = entry.make(settings, body)->verify_at_rest(body.solid, body.frame.length);
  }
  return verdicts;
}

template <class Wanted>
PrintedBody printed_body(const Print& print, const PrintObject& object, const PrintQuestion& question,
                         const Wanted& wanted) {
  PrintedBody body;
  body.label = object.label;
  body.volume = print.volume(wanted);
  const Moments mass = print.mass(wanted);
  body.mass = mass[S1];
  body.centre = centre_of_mass(mass);
  // About its own centre: far from the bed's origin digits would cancel.
  body.inertia = inertia_about_centre(transformed(mass, Eigen::Matrix3d::Identity(), -body.centre));
  const PrincipalAxes principal(body.inertia);
  body.principal = principal.moments;
  body.axes = principal.axes;
  body.verdicts = verdicts_of(body, mass, object.foot, question);
  return body;
}

/// @throws InputError
void require_by_moments(const PrintQuestion& question) {
  if (question.axis && !(question.axis->norm() > 0)) throw InputError("--axis 0,0,0, expected a direction");
  if (question.problem.empty() || find_problem(question.problem).by_moments) return;
  std::vector<std::string> those;
  for (const ProblemEntry& entry : problems())
    if (entry.by_moments) those.push_back(entry.name);
  throw InputError(fmt::format("--problem {} needs a surface, which G-code has not; expected one of {}",
                               question.problem, fmt::join(those, ", ")));
}

}  // namespace

PrintInspection inspect_print(const std::filesystem::path& file, const FilamentSpec& filament,
                              const PrintQuestion& question, const Control& control) {
  require_by_moments(question);
  const StopScope scope(control.stop);
  control.tell("read");
  PrintInspection seen;
  seen.print = read_gcode(file, filament);
  const Print& print = seen.print;
  const auto of_part = [](const PrintGroup& group) { return group.of_part; };
  seen.part = printed_body(print, {"", print.objects.front().foot}, question, of_part);
  if (print.objects.size() < 2) return seen;
  seen.part.verdicts.clear();  // nobody spins two things as one
  for (const PrintObject& object : print.objects)
    seen.objects.push_back(printed_body(print, object, question, [&](const PrintGroup& group) {
      return group.of_part && group.object == object.label;
    }));
  return seen;
}

}  // namespace kreisel::core
