#include "session/remedies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "domain/exact.hpp"
#include "error.hpp"
#include "formulation/quadric.hpp"
#include "solve/solver.hpp"

namespace kreisel::core {
namespace {

constexpr double tungsten = 19.3, foam = 0.02;  // g/cm^3: denser is not to be had, nor much lighter

/// What may be of another density.
struct Material {
  double Body::*density;
  const char *name, *option;
  double least;  ///< g/cm^3
};

/// To the three digits that are printed, by std::floor or std::ceil, so that what is said to fit does.
double cut(double value, double (*to_whole)(double)) {
  const double unit = std::pow(10.0, std::floor(std::log10(std::max(value, 1e-300))) - 2);
  return unit * to_whole(value / unit);
}

using Fits = std::function<bool(double)>;

/// The value nearest to `bad`, to a percent, for which it fits; nothing when it does not even for `good`.
std::optional<double> nearest_that_fits(double bad, double good, const Fits& fits, const Control& control) {
  if (!fits(good)) return std::nullopt;
  while (std::abs(bad - good) > 0.01 * std::max(std::abs(bad), std::abs(good))) {
    control.stop_if_asked();
    const double middle = (bad + good) / 2;
    (fits(middle) ? good : bad) = middle;
  }
  return good;
}

class Trials {
 public:
  Trials(const RunConfig& config, const Body& body, const Problem& problem, device::Device& device,
         const Control& control)
      : body_(body),
        lines_(solid_lines(body, config.grid)),
        problem_(problem),
        device_(device),
        control_(control) {}

  /// Is there a filling that meets the constraints?
  [[nodiscard]] bool feasible(Formulation& quadric, const MassModel& mass) const {
    const Task task{problem_, quadric, mass, device_, control_.stop};
    const Termination ending = solve(default_solver("quadric"), task, {}).termination;
    return ending == Termination::optimal || ending == Termination::acceptable;
  }
  /// The exact domain of a wall in millimetres; nothing where no interior is left.
  [[nodiscard]] std::optional<ExactColumns> domain(double wall_mm) const {
    try {
      return make_exact(body_, lines_, {wall_mm, Wall::millimetres});
    } catch (const InputError&) {
      return std::nullopt;
    }
  }
  [[nodiscard]] bool fits_with_wall(double wall_mm) const {
    const auto exact = domain(wall_mm);
    return exact && feasible(*make_quadric(rays_of(*exact), device_), hollowed(body_, exact->interior));
  }

 private:
  const Body& body_;
  SolidLines lines_;
  const Problem& problem_;
  device::Device& device_;
  const Control& control_;
};

}  // namespace

std::vector<Remedy> remedies(const RunConfig& config, const Body& body, const Problem& problem,
                             device::Device& device, const Control& control) {
  const Trials trials(config, body, problem, device, control);
  std::vector<Remedy> help;
  const auto digits = [](double value) { return fmt::format("{:.3g}", value); };

  const double wall =
      in_body_units(config.wall, body, make_grid(bounding_box(body.local), config.grid)) * body.frame.length;
  // Whole cells may leave too little, and a solver may see an infeasibility that is its own.
  if (trials.fits_with_wall(wall))
    return {{"--formulation quadric, which meets them with the same wall on the exact domain",
             {{"formulation", "quadric"}}}};
  control.tell("try thinner walls");
  constexpr double thinnest = 0.02;  // of the wall asked for; nobody prints less
  if (const auto mm = nearest_that_fits(
          wall, thinnest * wall, [&](double w) { return trials.fits_with_wall(w); }, control))
    help.push_back({fmt::format("a wall of {:.3g} mm or less (now {:.3g})", *mm, wall),
                    {{"wall", digits(cut(*mm, std::floor))}}});

  const auto exact = trials.domain(wall);
  if (!exact && help.empty()) help.push_back({"there is no interior", {}});
  if (!exact) return help;
  const std::unique_ptr<Formulation> quadric = make_quadric(rays_of(*exact), device);
  const auto fits_with = [&](double Body::*density, double value) {
    Body other = body;
    other.*density = value;
    return trials.feasible(*quadric, hollowed(other, exact->interior));
  };
  // A wider range of densities reaches all that a narrower one does.
  const Material voids{&Body::void_density, "voids", "void", 0},
      interior{&Body::interior_density, "an interior", "interior", foam};
  const Material &light = body.heavy_voids() ? interior : voids,
                 &heavy = body.heavy_voids() ? voids : interior;
  if (body.*light.density > light.least) {
    control.tell(fmt::format("try {} of less density", light.name));
    const auto density = nearest_that_fits(
        body.*light.density, light.least, [&](double d) { return fits_with(light.density, d); }, control);
    if (density)
      help.push_back({fmt::format("{} of {:.3g} g/cm^3 or less (now {:.3g}; --{}-density)", light.name,
                                  cut(*density, std::floor), body.*light.density, light.option),
                      {{fmt::format("{}-density", light.option), digits(cut(*density, std::floor))}}});
  }
  control.tell(fmt::format("try {} of more density", heavy.name));
  const auto density = nearest_that_fits(
      body.*heavy.density, tungsten, [&](double d) { return fits_with(heavy.density, d); }, control);
  if (density)
    help.push_back({fmt::format("{} of {:.3g} g/cm^3 or more (now {:.3g}; --{}-density)", heavy.name,
                                cut(*density, std::ceil), body.*heavy.density, heavy.option),
                    {{fmt::format("{}-density", heavy.option), digits(cut(*density, std::ceil))}}});
  if (!body.heavy_voids()) {
    control.tell("try heavy fillings");
    const auto filling = nearest_that_fits(
        body.interior_density, tungsten, [&](double d) { return fits_with(&Body::void_density, d); },
        control);
    if (filling)
      help.push_back(
          {fmt::format("in place of voids, parts of the interior of {:.3g} g/cm^3 or more (the rest "
                       "{:.3g}; --void-density)",
                       cut(*filling, std::ceil), body.interior_density),
           {{"void-density", digits(cut(*filling, std::ceil))}}});
  }
  if (help.empty())
    help.push_back(
        {fmt::format(
             "nothing that was tried (walls down to {:.2g} mm, voids, interiors of up to {:.3g} g/cm^3): "
             "another axis, point or base is needed",
             thinnest * wall, tungsten),
         {}});
  return help;
}

std::string what_would_help(const RunConfig& config, const Body& body, const Problem& problem,
                            device::Device& device, const Control& control) {
  std::string sentence;
  for (const Remedy& remedy : remedies(config, body, problem, device, control))
    sentence += (sentence.empty() ? "" : "; or ") + remedy.text;
  return sentence;
}

}  // namespace kreisel::core
