#include "nest/decide/feasibility.hpp"

#include <fmt/format.h>

#include <array>

#include "nest/decide/envelope.hpp"
#include "nest/decide/exact.hpp"
#include "nest/decide/hybrid.hpp"
#include "nest/decide/peel.hpp"
#include "nest/decide/scatter.hpp"
#include "unknown_name.hpp"

namespace kreisel::core::nest {
namespace {

struct Entry {
  std::string_view name;
  std::unique_ptr<Feasibility> (*make)(device::Device&, const Nesting&, int resolution);
};

template <class Way>
std::unique_ptr<Feasibility> make_on(device::Device& device, const Nesting& nesting, int resolution) {
  return std::make_unique<Way>(device, nesting, resolution);
}

template <class Way>
std::unique_ptr<Feasibility> make_plain(device::Device&, const Nesting& nesting, int) {
  return std::make_unique<Way>(nesting);
}

/// By triangles where the device runs many items at once and holds every pixel of both views, else by bands.
std::unique_ptr<Feasibility> make_envelope(device::Device& device, const Nesting& nesting, int resolution) {
  if (device.info().gpu && Scatter::bytes(resolution) < 0.5 * double(device.info().memory_bytes))
    return std::make_unique<Scatter>(device, nesting, resolution);
  return std::make_unique<Envelope>(device, nesting, resolution);
}

constexpr std::array ways{Entry{"peel", make_on<Peel>}, Entry{"envelope", make_envelope},
                          Entry{"exact", make_plain<Exact>}, Entry{"hybrid", make_plain<Hybrid>}};

static_assert(int(Fault::none) == NEST_GOOD && int(Fault::outside) == NEST_OUTSIDE &&
              int(Fault::swept) == NEST_SWEPT && int(Fault::uncovered) == NEST_UNCOVERED &&
              int(Fault::sticks_out) == NEST_STICKS_OUT);

const char* in_words(Fault fault) {
  switch (fault) {
    case Fault::outside:
      return "the inner shape lies outside the outer one";
    case Fault::swept:
      return "the outer shape would run through the inner one";
    case Fault::uncovered:
      return "the inner shape sticks out, nothing of the outer one lies beyond";
    case Fault::sticks_out:
      return "the inner shape sticks out, the outer one beyond is seen from outside";
    default:
      return "valid";
  }
}

}  // namespace

std::string to_string(const Verdict& verdict, const Nesting& nesting) {
  if (verdict.valid()) return in_words(verdict.fault);
  const Vec3 at = nesting.to_file(verdict.point);
  const std::string pixel = verdict.x < 0 ? "" : fmt::format(", pixel {},{}", verdict.x, verdict.y);
  return fmt::format("invalid: {} at {:.6g} (half {}{})", in_words(verdict.fault), fmt::join(at, ","),
                     verdict.half == 0 ? "plus" : "minus", pixel);
}

std::vector<Verdict> Feasibility::check(std::span<const Placement> placements) {
  std::vector<Verdict> verdicts;
  for (const Placement& placement : placements) verdicts.push_back(check(placement));
  return verdicts;
}

namespace {

const Entry& find_way(std::string_view name) {
  for (const Entry& way : ways)
    if (way.name == name) return way;
  throw unknown_name("feasibility test", name, names_of(ways));
}

}  // namespace

std::vector<std::string> feasibility_tests() {
  const auto names = names_of(ways);
  return {names.begin(), names.end()};
}

void require_test(std::string_view name) { (void)find_way(name); }

std::unique_ptr<Feasibility> make_feasibility(std::string_view name, device::Device& device,
                                              const Nesting& nesting, int resolution) {
  return find_way(name).make(device, nesting, resolution);
}

}  // namespace kreisel::core::nest
