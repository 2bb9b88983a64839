#include "table/columns.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "problem/spinning.hpp"
#include "run/limits.hpp"
#include "statistics.hpp"
#include "table/experiment_run.hpp"

namespace kreisel::core {
namespace {

using nlohmann::json;

json field(const RecordedRun& run, const std::string& name) {
  const std::string text = run.field(name);
  return text.empty() ? json() : json(text);
}

/// The grid as asked, of the record where only the longest side was.
json grid(const RecordedRun& run) {
  const json asked = field(run, "resolution"), made = run.at("grid");
  if (asked.is_null() || asked.get<std::string>().find('x') != std::string::npos || !made.is_array())
    return asked;
  return fmt::format("{}", fmt::join(made.get<std::vector<int>>(), "x"));
}

json model(const RecordedRun& run) {
  const json named = field(run, "model");
  return named.is_null() ? named : json(std::filesystem::path(named.get<std::string>()).stem().string());
}

/// "ipopt, ipopt.hessian_approximation=exact": solver and settings.
json settings(const RecordedRun& run) {
  std::string text;
  const auto fields = run.fields();
  if (const auto solver = fields.find("solver"); solver != fields.end()) text = solver->second;
  for (const auto& [name, value] : fields)
    if (name.find('.') != std::string::npos) text += fmt::format(", {}={}", name, value);
  return text;
}

/// What tells bodies and weights apart: how it lies and is parted, and its problem's settings.
json body_settings(const RecordedRun& run) {
  std::vector<std::string> parts;
  for (const auto& [name, value] : run.fields()) {
    const bool of_body = name == "axis" || name == "contact" || name == "axle";
    if (of_body || name.starts_with("problem."))
      parts.push_back(fmt::format("{}={}", of_body ? name : name.substr(8), value));
  }
  return parts.empty() ? "defaults" : fmt::format("{}", fmt::join(parts, ", "));
}

std::vector<double> solves(const RecordedRun& run) {
  std::vector<double> seconds;
  for (const json& sample : run.at("samples"))
    if (sample.contains("solve")) seconds.push_back(sample.at("solve").get<double>());
  return seconds;
}

json half_iqr(const RecordedRun& run) {
  if (!run.has_result()) return nullptr;
  const std::vector<double> all = solves(run);
  return all.empty() ? 0.0 : half_interquartile_range(all);
}

/// "34.74 ± 0.12": the median solve and its spread; no spread for a single sample.
std::string seconds_text(const RecordedRun& run) {
  const auto median = run.number("seconds.solve");
  if (!median) return "-";
  const int digits = *median < 0.01 ? 5 : *median < 1 ? 3 : *median < 100 ? 2 : 1;
  const std::vector<double> all = solves(run);
  if (all.size() < 2) return fmt::format("{:.{}f}", *median, digits);
  return fmt::format("{:.{}f} ± {:.{}f}", *median, digits, half_interquartile_range(all), digits);
}

/// Marked where the solve did not end well; what was ended at a limit has that limit in its place.
std::string marked_text(const RecordedRun& run) {
  if (!run.record || run.is_optimal()) return seconds_text(run);
  const bool limit = is_limit(limits_of(run.run), run.record->error);
  return (limit ? run.record->error : seconds_text(run)) + " !";
}

json seconds(const RecordedRun& run) { return run.at("seconds.solve"); }

/// Null where nothing was proved, or where there is no interior at all.
json gap(const RecordedRun& run) {
  const auto gap = run.number("gap");
  return gap ? json(100 * *gap) : json();
}

json evaluations(const RecordedRun& run) {
  const auto f = run.number("evaluations.objective"), hessian = run.number("evaluations.hessian");
  return f && hessian ? json(*f + *hessian) : json();
}

/// The state of the solid or the written part in its body's frame; empty without a part.
struct State {
  SpinState state;
  Moments moments;
  double length;
};

template <class Of>
json of_state(const RecordedRun& run, const char* moments, const Of& of) {
  const json found = run.at(moments), written = run.at("verified.moments_body");
  const auto length = run.number("frame.length");
  if (!length || !found.is_array() || !written.is_array() || !(written.at(0).get<double>() > 0))
    return nullptr;
  State s{{}, Moments::Zero(), *length};
  for (std::size_t i = 0; i < moment_names.size(); ++i)
    s.moments[static_cast<Eigen::Index>(i)] = found.at(i).get<double>();
  s.state = spin_state(s.moments);
  return of(s);
}

/// Only what stands on its tip has a least speed, not what spins about its own centre.
json rpm(const State& s) {
  constexpr double centred = 1e-6;  // of a length; constraints are met to 1e-9
  return s.state.height > centred ? json(omega_min_rpm(s.moments, s.length)) : json();
}

constexpr const char *of_solid = "solid_moments_body", *of_part = "verified.moments_body";

/// "stable", "unstable" or "no steady spin", and how far the motion strays, of a simulated body.
json spectrum(const RecordedRun& run, const std::string& body) {
  const json stable = run.at(body + ".spin.stable");
  if (!stable.is_boolean()) return nullptr;
  if (stable.get<bool>()) return "stable";
  return run.at(body + ".spin.growth_per_s").is_null() ? "no steady spin" : "unstable";
}
json strays(const RecordedRun& run, const std::string& body) {
  if (const auto fell = run.number(body + ".spin.fell_at_s")) return fmt::format("falls in {:.2f} s", *fell);
  const auto tilt = run.number(body + ".spin.largest_tilt_degrees");
  return tilt ? json(fmt::format("{:.2f}", *tilt)) : json();
}

using R = const RecordedRun&;

std::vector<Column> solve_columns() {
  return {
      {"model", "model", "", true, {}, model},
      {"grid", "grid", "", true, {}, grid},
      {"settings", "settings", "", true, {}, settings},
      {"body_settings", "settings", "", true, {}, body_settings},
      {"run", "run", "", true, {}, [](R r) { return json(run_text(r.run)); }},
      {"converged", "converged", "", true, {}, [](R r) { return json(r.is_converged()); }},
      {"termination", "termination", "", true, {}, [](R r) { return json(r.termination()); }},
      {"error", "error", "", true, {}, [](R r) { return r.record ? json(r.record->error) : json(); }},
      {"seconds", "seconds", "s", false, {}, seconds, seconds_text},
      {"marked_seconds", "seconds", "s", false, {}, seconds, marked_text},
      {"seconds_half_iqr", "half IQR", "s", false, {}, half_iqr},
      {"samples",
       "samples",
       "",
       false,
       {},
       [](R r) { return r.has_result() ? json(solves(r).size()) : json(); }},
      {"setup_seconds", "set-up", "s", false, ".2f", [](R r) { return r.at("seconds.setup"); }},
      {"objective", "f", "", false, ".6g", [](R r) { return r.at("objective"); }},
      {"violation", "violation", "", false, ".1e", [](R r) { return r.at("constraint_violation"); }},
      {"verified", "verified", "", true, {}, [](R r) { return r.at("verified.ok"); }},
      {"evaluations_of_f", "passes", "", false, {}, evaluations},
      {"gap_percent", "gap %", "%", false, ".2g", gap},
      {"gap", "gap %", "%", false, ".2g", gap},
      {"voids_mm3", "mm^3", "mm^3", false, ".5g",
       [](R r) {
         const json voids = r.at("voids");
         double sum = 0;
         for (const json& v : voids) sum += v.get<double>();
         return voids.is_array() ? json(sum) : json();
       }},
      {"void_pieces",
       "voids",
       "",
       false,
       {},
       [](R r) { return r.at("voids").is_array() ? json(r.at("voids").size()) : json(); }},
      {"void_islands",
       "islands",
       "",
       false,
       {},
       [](R r) { return r.at("islands").is_array() ? json(r.at("islands").size()) : json(); }},
      {"void_cuts",
       "cuts",
       "",
       false,
       {},
       [](R r) { return r.at("cuts").is_array() ? json(r.at("cuts").size()) : json(); }},
      {"rounds",
       "rounds",
       "",
       false,
       {},
       [](R r) { return r.has_result() ? json(r.at("refinements").size()) : json(); }},
      {"along_voids",
       "along",
       "",
       false,
       {},
       [](R r) {
         const json rounds = r.at("refinements");
         return !r.has_result() ? json() : rounds.empty() ? json(0) : rounds.back().at("along_voids");
       }},
  };
}

std::vector<Column> body_columns() {
  return {
      {"solid.off_axis_mm", "off, mm", "mm", false, ".2f",
       [](R r) { return of_state(r, of_solid, [](const State& s) { return s.state.off_axis * s.length; }); }},
      {"solid.tilt_degrees", "tilt", "degrees", false, ".2f",
       [](R r) { return of_state(r, of_solid, [](const State& s) { return s.state.tilt_degrees; }); }},
      {"solid.height_mm", "height", "mm", false, ".2f",
       [](R r) { return of_state(r, of_solid, [](const State& s) { return s.state.height * s.length; }); }},
      {"solid.moment_ratio", "I/I2", "", false, ".3f",
       [](R r) { return of_state(r, of_solid, [](const State& s) { return s.state.moment_ratio; }); }},
      {"solid.rpm", "rpm", "rpm", false, ".0f", [](R r) { return of_state(r, of_solid, rpm); }},
      {"part.height_mm", "height", "mm", false, ".2f",
       [](R r) { return of_state(r, of_part, [](const State& s) { return s.state.height * s.length; }); }},
      {"part.moment_ratio", "I/I2", "", false, ".3f",
       [](R r) { return of_state(r, of_part, [](const State& s) { return s.state.moment_ratio; }); }},
      {"part.rpm", "rpm", "rpm", false, ".0f", [](R r) { return of_state(r, of_part, rpm); }},
      {"solid.spectrum", "spectrum", "", true, {}, [](R r) { return spectrum(r, "solid"); }},
      {"part.spectrum", "spectrum", "", true, {}, [](R r) { return spectrum(r, "part"); }},
      {"solid.strays", "strays, deg", "degrees", true, {}, [](R r) { return strays(r, "solid"); }},
      {"part.strays", "strays, deg", "degrees", true, {}, [](R r) { return strays(r, "part"); }},
  };
}

}  // namespace

const std::vector<Column>& columns() {
  static const std::vector<Column> all = [] {
    std::vector<Column> joined = solve_columns();
    std::ranges::copy(body_columns(), std::back_inserter(joined));
    return joined;
  }();
  return all;
}

const Column* find_column(std::string_view name) {
  const auto found = std::ranges::find(columns(), name, &Column::name);
  return found == columns().end() ? nullptr : &*found;
}

json value_of(const RecordedRun& run, std::string_view name) {
  constexpr std::string_view asked = "asked.";
  if (name.starts_with(asked)) return field(run, std::string(name.substr(asked.size())));
  if (const Column* column = find_column(name)) return column->value(run);
  json found = run.at(name);
  return found.is_null() ? field(run, std::string(name)) : found;
}

Cell cell_of(const json& value, const std::string& format, const std::string& join) {
  if (value.is_null()) return Cell::none();
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_array()) {
    std::vector<std::string> texts, data;
    for (const json& item : value) {
      const Cell one = cell_of(item, format, join);
      texts.push_back(one.text);
      data.push_back(one.data);
    }
    return {fmt::format("{}", fmt::join(texts, join)), fmt::format("{}", fmt::join(data, " "))};
  }
  if (!value.is_number()) return Cell::none();
  if (format.empty() && value.is_number_integer()) return fmt::format("{}", value.get<long long>());
  return Cell::of(value.get<double>(), fmt::runtime("{:" + (format.empty() ? ".6g" : format) + "}"));
}

}  // namespace kreisel::core
