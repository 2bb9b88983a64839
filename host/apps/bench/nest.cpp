#include <fmt/format.h>

#include <Eigen/Geometry>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/bench/commands.hpp"
#include "apps/bench/nest_mesh.hpp"
#include "apps/shared/outputs.hpp"
#include "apps/shared/step_line.hpp"
#include "error.hpp"
#include "file/write_text.hpp"
#include "nest/exact.hpp"
#include "nest/optimise.hpp"
#include "nest/scale_search.hpp"
#include "parse.hpp"
#include "run/build_info.hpp"
#include "solve/interrupt.hpp"

namespace kreisel::bench {
namespace {

using nlohmann::json;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Vec3 vector_of(const std::string& text, const char* option) {
  const auto v = parse_vector(text);
  if (!v) throw InputError(fmt::format("{} {}; expected x,y,z", option, text));
  return *v;
}

Vec3 direction_of(const std::string& text, const char* option) {
  const Vec3 v = vector_of(text, option);
  if (!(v.norm() > 0))
    throw InputError(fmt::format("{} {}; expected a vector that is not zero", option, text));
  return v.normalized();
}

/// Axis times angle in degrees. @param text  empty: none
Eigen::Matrix3d rotation_of(const std::string& text) {
  if (text.empty()) return Eigen::Matrix3d::Identity();
  const Vec3 v = vector_of(text, "--rotation");
  const double degrees = v.norm();
  if (!(degrees > 0)) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(degrees * std::acos(-1) / 180, v / degrees).toRotationMatrix();
}

nest::Placement placement_of(const NestOptions& options, const nest::Nesting& nesting) {
  nest::Placement placement;
  placement.pose.rotation = rotation_of(options.rotation);
  placement.pose.scale = options.scale.value_or(1);
  placement.pose.centroid = nesting.to_units(
      options.centroid.empty() ? nesting.outer_centroid() : vector_of(options.centroid, "--centroid"));
  const Vec3 normal = options.plane.empty() ? Vec3(Vec3::UnitZ()) : direction_of(options.plane, "--plane");
  const Vec3 through = options.through.empty() ? placement.pose.centroid
                                               : nesting.to_units(vector_of(options.through, "--through"));
  placement.cut = nest::Cut::through(through, normal);
  if (!options.removal.empty()) {
    placement.cut.plus = direction_of(options.removal.front(), "--removal");
    placement.cut.minus = direction_of(options.removal.back(), "--removal");
  }
  return placement;
}

json to_json(const Vec3& v) { return {v[0], v[1], v[2]}; }

/// What was asked and found, in the outer file's coordinates.
struct NestRun {
  const NestOptions* options;
  nest::Placement placement;
  bool valid = false;
  std::string text;
  std::uint64_t evaluations = 1;
  std::optional<double> certified;
  std::vector<nest::SwarmStep> trace;  ///< of a swarm
  bool stopped = false;                ///< by the user
  double setup = 0, search = 0, certify = 0;
};

json to_json(const NestRun& run, const nest::Nesting& nesting, const device::Device& device) {
  const nest::Cut& cut = run.placement.cut;
  json out;
  out["outer"] = run.options->outer;
  out["inner"] = run.options->inner;
  out["variant"] = run.options->variant;
  out["resolution"] = run.options->resolution;
  const bool swarm = !run.options->free.empty();
  out["seed"] = swarm ? json(run.options->seed) : json();
  out["free"] = run.options->free;
  out["swarm"] = swarm ? json(run.options->swarm) : json();
  if (swarm)
    for (const nest::SwarmStep& step : run.trace)
      out["trace"].push_back({step.iteration, step.evaluations, step.best});
  out["evaluations"] = run.evaluations;
  out["valid"] = run.valid;
  out["text"] = run.text;
  const bool placed = run.options->scale || run.valid;
  out["scale"] = placed ? json(run.placement.pose.scale) : json(nullptr);
  out["certified_scale"] = run.certified ? json(*run.certified) : json(nullptr);
  out["transform"] = nullptr;
  if (placed) {
    out["transform"] = json::array();
    const auto t = nesting.transform(run.placement.pose);
    for (int row = 0; row < 3; ++row)
      out["transform"].push_back({t(row, 0), t(row, 1), t(row, 2), t(row, 3)});
  }
  out["plane"] = {{"point", to_json(nesting.to_file(cut.offset * cut.normal))},
                  {"normal", to_json(cut.normal)}};
  out["removal"] = {{"plus", to_json(cut.plus)}, {"minus", to_json(cut.minus)}};
  out["seconds"] = {{"setup", run.setup},
                    {"search", run.search},
                    {"certify", run.certify},
                    {"total", run.setup + run.search + run.certify}};
  out["termination"] = run.stopped ? "interrupted" : run.valid ? "valid" : "infeasible";
  out["triangles"] = nesting.outer().triangles.size() + nesting.inner().triangles.size();
  out["device"] = device.info().name;
  out["commit"] = build_info::commit;
  return out;
}

void print(const NestRun& run, const nest::Nesting& nesting) {
  const NestOptions& options = *run.options;
  fmt::print("{} in {}: {} by {}\n", options.inner, options.outer,
             !options.free.empty() ? options.swarm + " swarm over " + options.free
             : options.scale       ? "feasibility"
                                   : "scale search",
             options.variant);
  fmt::print("  triangles  {} + {}\n", nesting.outer().triangles.size(), nesting.inner().triangles.size());
  if (options.scale || run.valid) fmt::print("  scale      {:.6g}\n", run.placement.pose.scale);
  fmt::print("  answer     {}\n", run.text);
  if (run.valid)
    fmt::print("  certified  {}\n",
               run.certified ? fmt::format("valid on the triangles themselves at {:.6g}", *run.certified)
                             : "no: the exact test says invalid, what was sampled missed a contact");
  fmt::print(
      "  time       {:.3f} ms test or search ({} evaluations), {:.3f} s set-up, {:.3f} s certification\n",
      1e3 * run.search, run.evaluations, run.setup, run.certify);
}

/// The largest nesting over all that is free.
void find_largest(NestRun& run, const nest::Nesting& nesting, device::Device& device) {
  const NestOptions& options = *run.options;
  nest::OptimiseSpec spec;
  spec.freedom.set_free(options.free);
  spec.freedom.given = run.placement;
  spec.freedom.up = direction_of(options.up, "--up");
  spec.variant = options.swarm;
  spec.test = options.variant;
  spec.resolution = options.resolution;
  spec.tolerance = options.tolerance;
  spec.search.swarm.particles = options.particles;
  spec.search.swarm.iterations = options.iterations;
  spec.search.swarm.seed = options.seed;
  const StepLine line;
  const auto start = std::chrono::steady_clock::now();
  const nest::OptimiseResult result =
      nest::optimise(nesting, device, spec, [&](const nest::SearchState& state) {
        const double share =
            std::max<double>(1, static_cast<double>(state.trace.size())) / std::max(1, options.iterations);
        line.show(fmt::format("iteration {} of {}, scale {:.4f}, about {:.0f} s left", state.trace.size(),
                              options.iterations, state.scale,
                              std::max(0.0, seconds_since(start) * (1 / share - 1))));
        return !interrupted();
      });
  run.stopped = result.ended_early;
  run.setup += result.setup_seconds;
  run.search = result.search_seconds;
  run.evaluations = result.state.evaluations();
  run.trace = result.state.trace;
  run.valid = result.best.has_value();
  if (run.valid) run.placement = *result.best;
  run.text = run.valid ? "valid" : "nothing that nests was found";
}

}  // namespace

int nest_shapes(const NestOptions& given) {
  NestOptions options = given;
  if (options.inner.empty()) options.inner = options.outer;
  require_writable(options.json_file, "--json");
  auto start = std::chrono::steady_clock::now();
  device::Device device(options.device);
  NestRun run;
  run.options = &options;
  TriangleMesh outer = nest_mesh(options.outer);
  TriangleMesh inner = options.inner == options.outer ? outer : nest_mesh(options.inner);
  const nest::Nesting nesting(std::move(outer), std::move(inner));
  run.placement = placement_of(options, nesting);
  nest::require_valid(run.placement);
  if (!options.free.empty()) {
    run.setup = seconds_since(start);
    find_largest(run, nesting, device);
  } else if (options.scale) {
    const auto test = nest::make_feasibility(options.variant, device, nesting, options.resolution);
    run.setup = seconds_since(start);
    start = std::chrono::steady_clock::now();
    const nest::Verdict verdict = test->check(run.placement);
    run.valid = verdict.valid();
    run.text = nest::to_string(verdict, nesting);
  } else {
    const auto search = nest::make_search(options.variant, device, nesting, options.resolution);
    run.setup = seconds_since(start);
    start = std::chrono::steady_clock::now();
    nest::SearchLimits limits;
    limits.upper = options.upper.value_or(nesting.largest_scale());
    limits.tolerance = options.tolerance;
    const nest::FoundScale found = search->search(run.placement, limits);
    run.valid = found.scale > 0;
    run.evaluations = static_cast<std::uint64_t>(found.tests);
    if (run.valid) run.placement.pose.scale = found.scale;
    run.text = run.valid ? "valid" : fmt::format("invalid at every scale up to {:.6g}", limits.upper);
  }
  if (options.free.empty()) run.search = seconds_since(start);
  if (run.valid) {
    start = std::chrono::steady_clock::now();
    nest::Exact exact(nesting);
    if (!options.free.empty()) {
      const nest::CertifiedScale certified = nest::certify_scale(exact, run.placement, options.tolerance);
      if (certified.scale > 0) run.certified = certified.scale;
    } else if (exact.check(run.placement).valid()) {
      run.certified = run.placement.pose.scale;
    }
    run.certify = seconds_since(start);
  }
  const std::string text = to_json(run, nesting, device).dump(2) + "\n";
  if (options.json_file == "-") {
    fmt::print("{}", text);
  } else {
    if (!options.json_file.empty()) write_text(options.json_file, text);
    print(run, nesting);
  }
  return run.stopped ? was_interrupted : run.valid ? done : infeasible;
}

}  // namespace kreisel::bench
