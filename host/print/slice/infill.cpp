#include "print/slice/infill.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "error.hpp"
#include "parse.hpp"

namespace kreisel::core {
namespace {

using threemf::Dialect;

struct Pattern {
  std::string_view name;
  std::string_view orca;  ///< empty: the same
};

/// Those that are as dense everywhere as they are anywhere.
constexpr Pattern patterns[] = {{"gyroid", ""},
                                {"grid", ""},
                                {"rectilinear", "zig-zag"},  // newer ones read it as rectilinear
                                {"alignedrectilinear", ""},
                                {"line", ""},
                                {"triangles", ""},
                                {"stars", "tri-hexagon"},
                                {"cubic", ""},
                                {"honeycomb", ""},
                                {"3dhoneycomb", ""},
                                {"concentric", ""},
                                {"hilbertcurve", ""},
                                {"archimedeanchords", ""},
                                {"octagramspiral", ""}};

constexpr std::string_view uneven[] = {"adaptivecubic", "supportcubic", "lightning"};

const Pattern* find_pattern(std::string_view name) {
  const auto* const found = std::ranges::find(patterns, name, &Pattern::name);
  return found == std::end(patterns) ? nullptr : found;
}

std::string names() {
  std::string all;
  for (const Pattern& pattern : patterns) all += fmt::format("{}{}", all.empty() ? "" : ", ", pattern.name);
  return all;
}

using Settings = std::vector<std::pair<std::string, std::string>>;

Settings full(Dialect dialect) {
  if (dialect == Dialect::prusa) return {{"fill_density", "100%"}, {"fill_pattern", "rectilinear"}};
  return {{"sparse_infill_density", "100%"}, {"sparse_infill_pattern", "zig-zag"}};
}

/// Beads of the pattern alone: neither walls nor closed layers, however small it gets.
Settings sparse(const Infill& infill, Dialect dialect) {
  const std::string share = fmt::format("{}%", infill.percent);
  if (dialect == Dialect::prusa)
    return {{"fill_density", share},   {"fill_pattern", infill.pattern}, {"perimeters", "0"},
            {"top_solid_layers", "0"}, {"bottom_solid_layers", "0"},     {"solid_infill_below_area", "0"}};
  const Pattern* const pattern = find_pattern(infill.pattern);
  return {{"sparse_infill_density", share},
          {"sparse_infill_pattern",
           pattern && !pattern->orca.empty() ? std::string(pattern->orca) : infill.pattern},
          {"wall_loops", "0"},
          {"top_shell_layers", "0"},
          {"bottom_shell_layers", "0"},
          {"minimum_sparse_infill_area", "0"}};
}

}  // namespace

Infill parse_infill(std::string_view text) {
  Infill infill;
  const std::size_t colon = text.find(':');
  const auto percent = parse_with_unit(text.substr(0, colon), "%");
  if (!percent || !(*percent > 0) || !(*percent < 100))
    throw InputError(
        fmt::format("--infill {}, expected more than 0 % and less than 100 %, and a pattern if you like: 15% "
                    "or 15%:grid{}",
                    text, percent && *percent == 0 ? " (0 % is a void: without --infill)" : ""));
  infill.percent = *percent;
  if (colon == std::string_view::npos) return infill;
  infill.pattern = text.substr(colon + 1);
  if (std::ranges::find(uneven, infill.pattern) != std::end(uneven))
    throw InputError(
        fmt::format("--infill {}: {} is denser in some places than in others, expected one of {}", text,
                    infill.pattern, names()));
  if (!find_pattern(infill.pattern))
    throw InputError(
        fmt::format("--infill {}: no pattern {}, expected one of {}", text, infill.pattern, names()));
  return infill;
}

std::string to_string(const Infill& infill) { return fmt::format("{}%:{}", infill.percent, infill.pattern); }

Dialect parse_dialect(std::string_view text) {
  if (text == "prusa") return Dialect::prusa;
  if (text == "orca") return Dialect::orca;
  throw InputError(
      fmt::format("--project {}, expected prusa (PrusaSlicer) or orca (OrcaSlicer, Bambu Studio)", text));
}

threemf::Project project_of(const Filled& part, const Infill& infill, Dialect dialect,
                            const Eigen::Isometry3d& to_bed) {
  threemf::Project project{"part", {{"full", part.outer, false, full(dialect)}}, part.place, to_bed};
  if (!part.sparse.triangles.empty())
    project.volumes.push_back({"sparse", part.sparse, true, sparse(infill, dialect)});
  return project;
}

}  // namespace kreisel::core
