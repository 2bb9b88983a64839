#include "problem/yoyo.hpp"

#include <fmt/format.h>

#include <cmath>

#include "body/support_polygon.hpp"
#include "error.hpp"
#include "parse.hpp"

namespace kreisel::core {
namespace {

/// A centre of mass outside the body's shadow along any of three axes is out of reach; so is one outside the
/// hull as such, which the solver finds out.
void require_within(const Body& body) {
  for (int along = 0; along < 3; ++along) {
    std::vector<Vec2> shadow;
    for (const Vec3& v : body.local.vertices) shadow.emplace_back(v[(along + 1) % 3], v[(along + 2) % 3]);
    if (hull_of(std::move(shadow)).inside(Vec2::Zero()) <= 0)
      throw InputError(
          fmt::format("the axle's centre {:.4g} lies outside the body; expected a point within it "
                      "(--contact, model coordinates in mm), where its centre of mass can be",
                      fmt::join(body.contact, ",")));
  }
}

}  // namespace

Fields<YoyoOptions> yoyo_fields() { return {inertia_weight_field<YoyoOptions>(), form_field<YoyoOptions>()}; }

std::unique_ptr<Problem> make_yoyo(const Settings& settings, const Body& body) {
  require_within(body);
  return std::make_unique<Yoyo>(settings_as<YoyoOptions>(settings));
}

}  // namespace kreisel::core
