#include "run/nest_run.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "error.hpp"
#include "nest/decide/exact.hpp"
#include "nest/decide/scale_search.hpp"
#include "run/nest_parts.hpp"
#include "statistics.hpp"
#include "stopwatch.hpp"

namespace kreisel::core {
namespace {

using Ending = NestResult::Ending;

constexpr double seconds_between_checkpoints = 30;

nest::Nesting nesting_of(std::vector<TriangleMesh> shapes) {
  TriangleMesh inner = shapes.back();
  return {std::move(shapes.front()), std::move(inner)};
}

nest::Placement placement_of(const NestTurn& turn, const NestPlace& place, const nest::Nesting& nesting) {
  nest::Placement placement = unplaced(turn);
  placement.pose.centroid = nesting.to_units(place.centroid.value_or(nesting.outer_centroid()));
  const Vec3 through = place.through ? nesting.to_units(*place.through) : placement.pose.centroid;
  placement.cut.offset = placement.cut.normal.dot(through);
  nest::require_valid(placement);
  return placement;
}

nest::OptimiseSpec spec_of(const NestSwarm& config, const nest::Nesting& nesting,
                           const nest::Placement& given) {
  nest::OptimiseSpec spec = search_of(config, config);
  spec.freedom.given = given;
  for (const nest::KeepOut& ball : config.keep_outs)
    spec.keep_outs.push_back({nesting.to_units(ball.centre), ball.radius / nesting.unit()});
  return spec;
}

/// A run in the making.
class OneNesting {
 public:
  OneNesting(const NestConfig& config, const NestHooks& hooks) : config_(config), hooks_(hooks) {}

  NestResult operator()() {
    require_valid(config_);
    result_.config = config_;
    step("reading");
    const Stopwatch setup;
    device::Device device(config_.device);
    result_.provenance = make_provenance(device);
    const std::vector<TriangleMesh> shapes = hooks_.shapes.empty() ? shapes_of_run(config_) : hooks_.shapes;
    const nest::Nesting nesting = nesting_of(shapes);
    result_.outer_triangles = nesting.outer().triangles.size();
    result_.inner_triangles = nesting.inner().triangles.size();
    if (config_.keep_shapes) result_.shapes = shapes;
    std::visit([&](const auto& kind) { answer(kind, nesting, device, setup); }, config_.kind);
    return std::move(result_);
  }

 private:
  void answer(const NestAccuracy& asked, const nest::Nesting& nesting, device::Device& device,
              const Stopwatch& setup) {
    step("comparing");
    result_.setup_seconds = setup.seconds();
    const Stopwatch search;
    result_.accuracy =
        nest::compare(device, nesting, asked.accuracy, {64, 128, 256, 512}, asked.seed, hooks_.control.stop);
    result_.search_seconds = search.seconds();
    if (hooks_.control.stopped()) result_.ending = Ending::interrupted;
    result_.evaluations = static_cast<std::uint64_t>(result_.accuracy->placements);
    result_.text =
        fmt::format("{} of {} placements nest", result_.accuracy->nested, result_.accuracy->placements);
  }

  void answer(const NestTest& asked, const nest::Nesting& nesting, device::Device& device,
              const Stopwatch& setup) {
    nest::Placement placement = placement_of(asked, asked, nesting);
    placement.pose.scale = *asked.scale;
    nest::require_valid(placement);
    test(asked, nesting, device, placement, setup);
    describe(nesting, placement);
    if (!result_.valid) return;
    certify_at(nesting, placement);
    time(asked, asked.timings, nesting, device, placement);
  }

  void answer(const NestScale& asked, const nest::Nesting& nesting, device::Device& device,
              const Stopwatch& setup) {
    nest::Placement placement = placement_of(asked, asked, nesting);
    search_scale(asked, nesting, device, placement, setup);
    describe(nesting, placement);
    if (!result_.valid) return;
    certify_below(asked, nesting, placement);
    time(asked, asked.timings, nesting, device, placement);
  }

  void answer(const NestSwarm& asked, const nest::Nesting& nesting, device::Device& device,
              const Stopwatch& setup) {
    nest::Placement placement = placement_of(asked, asked, nesting);
    search_placements(asked, nesting, device, placement, setup);
    describe(nesting, placement);
    if (!result_.valid) return;
    certify_below(asked, nesting, placement);
    const auto sampled = nest::make_feasibility("envelope", device, nesting, asked.resolution);
    result_.sampled_scale = nest::largest_near(*sampled, placement, asked.tolerance).scale;
    if (result_.ending == Ending::whole) time(asked, asked.timings, nesting, device, placement);
  }

  /// These have a way of their own: run_layers(), run_landscape().
  void answer(const NestLayers&, const nest::Nesting&, device::Device&, const Stopwatch&) {}
  void answer(const NestOutlines&, const nest::Nesting&, device::Device&, const Stopwatch&) {}

  void step(const std::string& what) const { hooks_.control.tell(what); }

  void test(const NestDecision& by, const nest::Nesting& nesting, device::Device& device,
            const nest::Placement& placement, const Stopwatch& setup) {
    const auto test = nest::make_feasibility(by.variant, device, nesting, by.resolution);
    result_.setup_seconds = setup.seconds();
    step("testing");
    const Stopwatch search;
    const nest::Verdict verdict = test->check(placement);
    result_.search_seconds = search.seconds();
    result_.placed = true;
    result_.valid = verdict.valid();
    result_.text = nest::to_string(verdict, nesting);
  }

  void search_scale(const NestDecision& by, const nest::Nesting& nesting, device::Device& device,
                    nest::Placement& placement, const Stopwatch& setup) {
    const auto search = nest::make_search(by.variant, device, nesting, by.resolution);
    result_.setup_seconds = setup.seconds();
    step("searching the scale");
    const nest::SearchLimits limits = limits_of(by, nesting);
    const Stopwatch searching;
    const nest::FoundScale found = search->search(placement, limits);
    result_.search_seconds = searching.seconds();
    result_.evaluations = static_cast<std::uint64_t>(found.tests);
    result_.placed = result_.valid = found.scale > 0;
    if (result_.valid) placement.pose.scale = found.scale;
    result_.text = result_.valid ? "valid" : fmt::format("invalid at every scale up to {:.6g}", limits.upper);
  }

  void search_placements(const NestSwarm& asked, const nest::Nesting& nesting, device::Device& device,
                         nest::Placement& placement, const Stopwatch& setup) {
    nest::OptimiseSpec spec = spec_of(asked, nesting, placement);
    if (hooks_.exchange && asked.exchange > 0)
      spec.guest = [&](const nest::SearchState& state) {
        if (state.swarm.iteration % asked.exchange != 0) return std::vector<double>();
        return hooks_.exchange({config_, state, result_.trace_seconds});
      };
    if (hooks_.resume) result_.trace_seconds = hooks_.resume->seconds;
    const double before = result_.trace_seconds.empty() ? 0 : result_.trace_seconds.back();
    result_.setup_seconds = setup.seconds();
    bool stopped = false;
    const Stopwatch search;
    double kept = 0;
    const nest::OptimiseResult found = hooks_.optimise(
        nesting, device, spec,
        [&](const nest::SearchState& state) {
          // One that is resumed begins with what it has.
          if (result_.trace_seconds.size() < state.trace.size())
            result_.trace_seconds.push_back(before + search.seconds());
          step(progress_of(asked.search.swarm.iterations, state));
          if (hooks_.keep && search.seconds() > kept + seconds_between_checkpoints) {
            kept = search.seconds();
            hooks_.keep({config_, state, result_.trace_seconds});
          }
          if (hooks_.on_iteration && !hooks_.on_iteration(state)) return false;
          return !(stopped = hooks_.control.stopped());
        },
        hooks_.resume ? &hooks_.resume->state : nullptr);
    if (hooks_.keep) hooks_.keep({config_, found.state, result_.trace_seconds});
    if (found.ended_early) result_.ending = stopped ? Ending::interrupted : Ending::out_of_time;
    result_.setup_seconds += found.setup_seconds;
    result_.search_seconds = before + found.search_seconds;
    result_.evaluations = found.state.evaluations();
    result_.trace = found.state.trace;
    result_.placed = result_.valid = found.best.has_value();
    if (result_.valid) placement = *found.best;
    result_.text = result_.valid ? "valid" : "nothing that nests was found";
  }

  /// With the time left, by the swarm's iterations; how many a climb takes is not known.
  [[nodiscard]] std::string progress_of(int all, const nest::SearchState& state) const {
    const auto done = static_cast<double>(state.trace.size());
    if (state.phase == nest::SearchState::climbing || done > all)
      return fmt::format("refining, scale {:.4f}", state.scale);
    const double so_far = result_.trace_seconds.empty() ? 0 : result_.trace_seconds.back();
    return fmt::format("iteration {} of {}, scale {:.4f}, about {:.0f} s left", state.trace.size(), all,
                       state.scale, so_far * (all / done - 1));
  }

  [[nodiscard]] static nest::SearchLimits limits_of(const NestDecision& by, const nest::Nesting& nesting) {
    nest::SearchLimits limits;
    limits.upper = by.upper.value_or(nesting.largest_scale());
    limits.tolerance = by.tolerance;
    return limits;
  }

  void describe(const nest::Nesting& nesting, const nest::Placement& placement) {
    const nest::Cut& cut = placement.cut;
    result_.scale = placement.pose.scale;
    result_.transform = nesting.transform(placement.pose);
    result_.plane_point = nesting.to_file(cut.offset * cut.normal);
    result_.plane_normal = cut.normal;
    result_.plus = cut.plus;
    result_.minus = cut.minus;
  }

  /// The scale that was asked about, no other.
  void certify_at(const nest::Nesting& nesting, const nest::Placement& placement) {
    step("certifying");
    const Stopwatch certify;
    nest::CertifiedScale certified;
    certified.verdict = nest::Exact(nesting).check(placement);
    certified.confirmed = certified.verdict.valid();
    certified.scale = certified.confirmed ? placement.pose.scale : 0;
    certified.tests = 1;
    result_.certified = certified;
    result_.certify_seconds = certify.seconds();
  }

  void certify_below(const NestDecision& by, const nest::Nesting& nesting, const nest::Placement& placement) {
    step("certifying");
    const Stopwatch certify;
    result_.certified = nest::certify_scale(nesting, placement, by.tolerance);
    result_.certify_seconds = certify.seconds();
  }

  void time(const NestDecision& by, int timings, const nest::Nesting& nesting, device::Device& device,
            const nest::Placement& placement) {
    for (const char* variant : {"peel", "envelope", "exact", "hybrid"}) {
      if (timings == 0 || hooks_.control.stopped()) return;
      step(fmt::format("timing {}", variant));
      const auto test = nest::make_feasibility(variant, device, nesting, by.resolution);
      const auto search = nest::make_search(variant, device, nesting, by.resolution);
      nest::Placement smaller = placement;
      smaller.pose.scale *= 0.98;
      NestTiming timing{variant, 0, 0, 0};
      timing.test_ms = median_ms(timings, [&] { (void)test->check(smaller); });
      timing.search_ms =
          median_ms(timings, [&] { timing.scale = search->search(placement, limits_of(by, nesting)).scale; });
      result_.timings.push_back(timing);
    }
  }

  /// After one more, which warms up.
  template <class Work>
  [[nodiscard]] static double median_ms(int timings, const Work& work) {
    std::vector<double> ms;
    for (int i = 0; i <= timings; ++i) {
      const Stopwatch watch;
      work();
      if (i > 0) ms.push_back(1e3 * watch.seconds());
    }
    return median(std::move(ms));
  }

  const NestConfig& config_;
  const NestHooks& hooks_;
  NestResult result_;
};

}  // namespace

std::string_view termination_of(const NestResult& result) {
  if (result.ending == Ending::interrupted) return "interrupted";
  if (result.accuracy || result.landscape) return "complete";
  if (!result.valid) return "infeasible";
  return result.ending == Ending::out_of_time ? "out of time" : "valid";
}

NestResult run_nest(const NestConfig& config, const NestHooks& hooks) {
  if ((hooks.keep || hooks.resume) && !std::holds_alternative<NestSwarm>(config.kind))
    throw InputError(
        fmt::format("a checkpoint of {}; expected a search over placements, by --free without --layers",
                    entry_of(config).what));
  if (std::holds_alternative<NestLayers>(config.kind)) return run_layers(config, hooks);
  if (std::holds_alternative<NestOutlines>(config.kind)) return run_landscape(config, hooks);
  return OneNesting(config, hooks)();
}

}  // namespace kreisel::core
