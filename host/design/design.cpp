#include "design/design.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <set>
#include <utility>

#include "body/mesh_moments.hpp"
#include "body/source.hpp"
#include "error.hpp"
#include "fabricate/cut_part.hpp"
#include "fabricate/lay_flat.hpp"
#include "fabricate/loose_pieces.hpp"
#include "fabricate/wall.hpp"
#include "geometry/moved.hpp"
#include "geometry/rotation.hpp"
#include "mesh/io/text.hpp"
#include "parse.hpp"
#include "session/deformed.hpp"
#include "session/find_pose.hpp"
#include "session/other_poses.hpp"
#include "stop.hpp"

namespace kreisel::core {

namespace {

Figures solid_figures(const SolvedRun& run, const RunResult& r) {
  return figures_of(r.solid, 1e3 * r.mass_unit_grams * r.solid[S1] / r.density, r,
                    run.problem().verify_at_rest(r.solid, r.length_mm));
}

/// @throws InputError  no plane
Plane parse_plane(const std::string& text) {
  const std::size_t last = text.rfind(',');
  const auto normal = last == std::string::npos ? std::nullopt : parse_vector(text.substr(0, last));
  const auto offset = last == std::string::npos ? std::nullopt : parse<double>(text.substr(last + 1));
  if (!normal || !offset || !(normal->norm() > 0))
    throw InputError(
        fmt::format("--cut {}; expected auto, or a plane NX,NY,NZ,D where N . x = D in mm", text));
  return {*normal, *offset};
}

/// @throws InputError  nothing is to be cast
void require_metal(const BodySpec& body) {
  if (std::max(body.interior_density.value_or(body.density), body.void_density) > body.density) return;
  throw InputError(
      "--mould of a part whose shell is its densest material; expected a denser interior "
      "(--interior-density), or "
      "a filling of the voids (--void-density)");
}

/// Whether the printer takes a part that is printed that way up; any, where nobody says which it is.
bool fits(const std::optional<Printer>& printer, const TriangleMesh& mesh, const Vec3& up) {
  if (!printer) return true;
  Eigen::Isometry3d lay = Eigen::Isometry3d::Identity();
  lay.linear() = axis_to_z(up);
  const Box box = bounding_box(moved(mesh, lay));
  const Vec3 bed = printer->box().centre();
  lay.translation() = Vec3(bed[0] - box.centre()[0], bed[1] - box.centre()[1], -box.lo[2]);
  return printer->holds(moved(mesh, lay));
}

/// Ahead of all solving. @throws InputError  the part is too large for the printer, or its wall too thin
void require_printer_takes(const Printer& printer, const DesignSpec& spec, const SolvedRun& run) {
  const RunResult& r = run.result;
  const double wall = r.wall * r.length_mm, lines = 2 * printer.nozzles.front();
  if (wall < lines)
    throw InputError(
        fmt::format("--printer {}: a wall of {:.3g} mm is less than two lines of its nozzle of {:.3g} mm, "
                    "expected {:.3g} mm or more (--wall, --size), or another nozzle (NAME@MM)",
                    printer.name, wall, printer.nozzles.front(), lines));
  // Its pieces may well fit; directions are looked at.
  if (!spec.cut.empty() || run.body().axle || spec.print.find_up) return;
  const Vec3 up = spec.print.up.value_or(r.frame.rotation.row(2).transpose());
  const TriangleMesh& mesh = run.body().mesh;
  if (fits(printer, mesh, up)) return;
  const Vec3 size = bounding_box(moved(mesh, axis_to_z(up))).extent();
  throw InputError(
      fmt::format("--printer {}: the part takes {:.4g} x {:.4g} x {:.4g} mm as it is printed, expected no "
                  "more than {}: a "
                  "smaller --size, another --print-up, or --cut",
                  printer.name, size[0], size[1], size[2], printer.size_text()));
}

/// @throws InputError  the wall is thinner than what can be printed
void require_printable(const RunResult& run, double accuracy) {
  const double wall = run.wall * run.length_mm;
  if (wall < accuracy)
    throw InputError(
        fmt::format("a wall of {:.3g} mm is thinner than the printer's accuracy of {:.3g} mm; expected a "
                    "thicker --wall, a larger --size or a finer --printer-accuracy",
                    wall, accuracy));
}

/// Drills and cuts the part, always in the same places.
class Finishing {
 public:
  explicit Finishing(const DesignSpec& spec)
      : automatic_(spec.cut == "auto"),
        lay_flat_(spec.lay_flat),
        drain_(spec.drain_radius),
        pegs_{spec.peg_radius} {
    if (!automatic_ && !spec.cut.empty()) planes_.push_back(parse_plane(spec.cut));
    for (const auto& [wanted, option] :
         {std::pair{pegs_.radius > 0, "--pegs"}, std::pair{lay_flat_, "--lay-flat"}})
      if (wanted && spec.cut.empty())
        throw InputError(fmt::format("{} without a cut; expected --cut, too", option));
  }

  [[nodiscard]] bool wanted() const { return automatic_ || !planes_.empty() || drain_ > 0; }
  [[nodiscard]] const std::vector<Plane>& planes() const { return planes_; }
  [[nodiscard]] const std::vector<Drain>& drains() const { return drains_; }

  std::vector<MaterialPart> operator()(const Body& body, const std::vector<MaterialPart>& parts,
                                       const Control& control) {
    if (parts.size() > 1 && drain_ > 0)
      throw InputError("--drain of a part of several materials; expected one of a single material");
    MaterialPart part = parts.front();
    if (part.surfaces.size() < 2) return parts;  // nothing to open
    if (automatic_ && planes_.empty())
      std::ranges::copy(find_voids(part.surfaces, cut_directions(body)).cuts, std::back_inserter(planes_));
    if (drain_ > 0) {
      if (drains_.empty())
        drains_ = drains_of(part.surfaces[0], part.surfaces[1], drain_, body.frame.rotation.row(2), control);
      part.surfaces = {drained(part.surfaces[0], part.surfaces[1], drains_, drain_)};
    }
    std::vector<MaterialPart> pieces = {part};
    if (!planes_.empty()) pieces = cut_part(part, planes_, pegs_);
    pieces.insert(pieces.end(), parts.begin() + 1, parts.end());
    if (lay_flat_ && !planes_.empty()) lay_flat(pieces);
    return pieces;
  }

 private:
  bool automatic_, lay_flat_;
  double drain_;
  Pegs pegs_;
  std::vector<Plane> planes_;
  std::vector<Drain> drains_;
};

}  // namespace

std::map<std::string, std::string> describe(const DesignSpec& spec) {
  std::map<std::string, std::string> fields = describe(spec.config);
  fields["printer-accuracy"] = fmt::format("{}", spec.printer_accuracy);
  if (spec.tolerance) fields["tolerance"] = fmt::format("{}", *spec.tolerance);
  if (!spec.cut.empty()) fields["cut"] = spec.cut;
  if (spec.peg_radius > 0) fields["pegs"] = fmt::format("{}", spec.peg_radius);
  if (spec.drain_radius > 0) fields["drain"] = fmt::format("{}", spec.drain_radius);
  if (spec.lay_flat) fields["lay-flat"] = "true";
  if (spec.mould) fields["mould"] = "true";
  if (spec.print.wanted()) fields["slicer"] = spec.print.slicing.slicer;
  if (!spec.print.slicing.profile.empty()) fields["profile"] = spec.print.slicing.profile.string();
  if (spec.measured_mass) fields["measured-mass"] = fmt::format("{}", *spec.measured_mass);
  if (spec.print.find_up) fields["print-up"] = "auto";
  if (const auto& printer = spec.print.slicing.printer)
    fields["printer"] = fmt::format("{}@{}", printer->name, printer->nozzles.front());
  if (spec.print.up) fields["print-up"] = fmt::format("{}", fmt::join(*spec.print.up, ","));
  if (spec.print.balance) fields["balance"] = "print";
  if (spec.print.slicing.infill) {
    fields["infill"] = to_string(*spec.print.slicing.infill);
    fields.erase("void-density");  // it follows
    if (spec.print.slicing.dialect == threemf::Dialect::orca) fields["project"] = "orca";
  }
  return fields;
}

namespace {

/// What is written beside a name, and is not there to stay until the whole part is measured.
class Unfinished {
 public:
  explicit Unfinished(const std::filesystem::path& file) : file_(file), before_(here()) {}
  ~Unfinished() {
    if (kept_) return;
    std::error_code ignored;
    for (const std::filesystem::path& path : here())
      if (!before_.contains(path)) std::filesystem::remove(path, ignored);
  }
  Unfinished(const Unfinished&) = delete;
  Unfinished& operator=(const Unfinished&) = delete;
  void keep() { kept_ = true; }

 private:
  /// The file, and those whose names go on from it: other materials, halves, moulds.
  [[nodiscard]] std::set<std::filesystem::path> here() const {
    std::set<std::filesystem::path> found;
    if (file_.empty()) return found;
    const std::filesystem::path folder = file_.has_parent_path() ? file_.parent_path() : ".";
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(folder, ignored))
      if (entry.is_regular_file(ignored) && entry.path().extension() == file_.extension() &&
          entry.path().stem().string().starts_with(file_.stem().string()))
        found.insert(entry.path());
    return found;
  }

  std::filesystem::path file_;
  std::set<std::filesystem::path> before_;
  bool kept_ = false;
};

/// Ahead of the work. @throws InputError  what does not go together with infill
void require_infill_alone(const DesignSpec& spec) {
  const BodySpec& body = spec.config.body;
  for (const auto& [wanted, option] :
       {std::pair{body.void_density > 0, "--void-density"},
        std::pair{body.interior_density.has_value(), "--interior-density"},
        std::pair{!spec.cut.empty(), "--cut"}, std::pair{spec.drain_radius > 0, "--drain"},
        std::pair{spec.mould, "--mould"}})
    if (wanted)
      throw InputError(fmt::format("--infill with {}, expected one of them: infill leaves no void", option));
  if (!spec.file.empty() && lower_case(spec.file.extension().string()) != ".3mf")
    throw InputError(fmt::format("--infill to {}, expected a .3mf file: no other says where infill is sparse",
                                 spec.file.string()));
}

/// Where it is infeasible, what would help is left to be found.
Design make_asked(Session& session, const DesignSpec& spec, const Control& control) {
  Finishing finishing(spec);
  std::optional<Printing> printing;  // ahead of the work: its slicer may not be there
  if (spec.print.wanted()) printing.emplace(spec.print);
  const std::optional<Infill>& infill = spec.print.slicing.infill;
  if (infill) require_infill_alone(spec);
  if (spec.print.find_up && (!spec.cut.empty() || spec.config.body.axle.radius))
    throw InputError("--print-up auto of a part in pieces, expected one in a piece: each stands on its cut");
  if (spec.mould) require_metal(spec.config.body);
  if (spec.mould && spec.file.empty())
    throw InputError("a mould of a part that is not written; expected a file for it");
  RunConfig config = spec.config;
  config.wall.to_corners = true;  // a voxel whose centre keeps the wall would stick out into it
  PartOptions options;
  options.least_void = std::pow(5 * spec.printer_accuracy, 3);
  options.tolerance = spec.tolerance.value_or(spec.printer_accuracy / 10);
  const std::optional<Printer>& printer = spec.print.slicing.printer;
  const auto require_taken = [&](const SolvedRun& one) {
    require_printable(one.result, spec.printer_accuracy);
    if (printer) require_printer_takes(*printer, spec, one);
  };
  std::optional<InfillUse> use;
  if (infill) require_taken(SolvedRun(session, config, control));
  if (infill)
    use = use_infill(session, config, measure_infill(spec.print.slicing, control), *infill, options, control);
  SolvedRun run(session, config, control);
  require_taken(run);
  const Body& body = run.body();
  if (printing && (!body.one_material() || (body.void_density > 0 && !infill)))
    throw InputError("--slicer of a part of several materials, expected one of a single material");
  if (spec.print.balance && !run.exact())
    throw InputError(
        fmt::format("--balance print of {}, expected --formulation quadric", config.formulation));
  run.solve(control);
  if (run.result.config.certify > 0) run.certify(control);
  std::optional<FoundUp> found_up;
  if (spec.print.find_up && run.result.outcome.termination != Termination::infeasible) {
    const PartMeshes ahead = make_part(run, "", options);
    found_up = find_up(
        printing->slicer(), ahead.outer, infill ? TriangleMesh{} : ahead.cavity, printing->up_of(run.result),
        [&](const Vec3& up) { return fits(printer, ahead.outer, up); }, control);
    PrintSpec turned = spec.print;
    turned.up = found_up->up;
    printing.emplace(turned);
  }
  Design design{};
  DesignSpec used = spec;
  used.config = run.result.config;  // with the solver and the wall that were taken
  design.config = describe(used);
  design.printer_accuracy = spec.printer_accuracy;
  design.part.outer = run.body().mesh;
  Unfinished written(spec.file);
  if (run.result.outcome.termination != Termination::infeasible) {
    const StopScope scope(control.stop);
    control.tell("mesh, write, verify");
    std::vector<MaterialPart> cast;
    if (finishing.wanted() || spec.mould)
      options.finish = [&](const std::vector<MaterialPart>& parts) {
        if (spec.mould) cast = cast_of(parts, run.body().density, options.least_void);
        return finishing.wanted() ? finishing(run.body(), parts, control) : parts;
      };
    std::vector<PrintedPart> printed;
    if (printing && spec.print.balance)
      options.printed = [&](const std::vector<MaterialPart>& parts) {
        const PrintedPart& one = printed.emplace_back((*printing)(run, parts, control));
        return PrintedMoments{one.moments, one.balances()};
      };
    if (infill)
      options.written = [&](const std::string& file, const std::vector<MaterialPart>& parts) {
        return write_infilled(file, printing->pieces(run, parts), printing->slicer(),
                              spec.print.slicing.dialect, run);
      };
    design.part = make_part(run, spec.file.string(), options);
    if (use) {
      use->volume = std::abs(reference::mesh_moments(design.part.cavity).value[S1]);
      use->surface = area_of(design.part.cavity);
      design.infill = use;
    }
    if (printing && printed.empty()) printed.push_back((*printing)(run, design.part.solids, control));
    for (const PrintedPart& one : printed) design.rounds.push_back(one.residual);
    if (printing) design.printed = std::move(printed[design.part.round]);
    design.print_balanced = spec.print.balance;
    design.found_up = std::move(found_up);
    if (printing && !infill)
      design.supports =
          measure_supports(printing->slicer(), printing->pieces(run, design.part.solids), control);
    design.survives =
        survived_errors(run, design.printed ? design.printed->moments : run.result.verified.moments);
    if (!cast.empty()) control.tell("mould");
    if (!cast.empty()) design.moulds = write_moulds(spec.file, cast);
    design.cuts = finishing.planes();
    if (!design.cuts.empty()) design.pieces = loose_pieces(design.part.solids);
    design.drains = finishing.drains();
    design.drain_radius = spec.drain_radius;
    control.tell("measure the walls");
    design.wall = least_wall(design.part.outer, design.part.cavity);
    design.thinnest = thinnest_material(design.part.outer, design.part.cavity, spec.printer_accuracy);
  }
  if (design.printed && !spec.gcode.empty())
    for (const PrintedPiece& piece : design.printed->pieces)
      write_gcode(piece.sliced, file_of_piece(spec.gcode, piece.name));
  written.keep();
  design.run = std::move(run.result);
  const RunResult& r = design.run;
  design.before = solid_figures(run, r);
  if (!design.feasible()) return design;

  double volume = 0;
  for (const WrittenMaterial& material : r.verified.materials) {
    // What is sparse is of the same material, at less of it.
    volume += 1e3 * material.grams / (design.infill ? r.density : material.density);
    if (std::ranges::find(design.files, material.file) == design.files.end() && !material.file.empty())
      design.files.push_back(material.file);
  }
  design.after = figures_of(r.verified.moments, volume, r, r.verified.verdict);
  design.residual = residual_of(design.after, r.config);
  return design;
}

/// The least change of shape that would help, as an option; empty where none was found, or this body's shape
/// cannot change.
std::string least_deformation(const SolvedRun& run, RunConfig config, const Control& control) {
  config.deform.wanted = true;
  try {
    const DeformationReport found = deformed(run.stages(), config, control).report;
    if (found.reached == Reached::nothing) return "";
    return fmt::format("--deform least, by at most {:.3g} mm ({:.2g} % of the longest side){}",
                       found.largest_mm, found.largest_percent,
                       found.reached == Reached::constraints ? ", with which it balances, but no more" : "");
  } catch (const InputError&) {
    return "";
  }
}

/// The question as it stands, and what would help where no interior does it.
Design make_posed(Session& session, const DesignSpec& spec, const Control& control) {
  Design design = make_asked(session, spec, control);
  if (design.does()) return design;
  RunConfig config = spec.config;
  config.deform = {};
  if (!design.feasible()) {
    config.body.void_density = design.run.config.body.void_density;  // of infill, which is measured
    config.wall.to_corners = true;
    SolvedRun run(session, config, control);
    run.result.outcome.termination = Termination::infeasible;
    run.look_for_remedies(control);
    design.run.remedies = run.result.remedies;
    if (!spec.config.deform.wanted && run.exact())
      if (const std::string shape = least_deformation(run, config, control); !shape.empty())
        design.run.remedies += (design.run.remedies.empty() ? "" : "; or ") + shape;
  }
  design.other_axes = other_poses(session, config, design.run.axis, control);
  return design;
}

/// Whether half the wall lets some pose do.
std::string thinner_wall(Session& session, const DesignSpec& spec, const Control& control) {
  RunConfig thin = spec.config;
  if (thin.wall.unit == Wall::cells)
    return "another --wall, more cells, or a denser interior (--interior-density)";
  thin.wall.value /= 2;
  control.tell("try a thinner wall");
  if (find_poses(session, thin, control).good.empty())
    return "nothing that was tried: all poses, with half the wall, too";
  return fmt::format("--wall {}, with which some pose will do", to_string(thin.wall));
}

/// Nothing of what was left open will do.
Design make_none(Session& session, const DesignSpec& spec, const FoundPoses& found, const Control& control) {
  DesignSpec usual = spec;
  usual.config = in_usual_pose(spec.config);
  usual.config.body.stem = {};  // it may be what cannot be had
  SolvedRun run(session, usual.config, control);
  Design design{};
  design.config = describe(spec);
  design.printer_accuracy = spec.printer_accuracy;
  design.part.outer = run.body().mesh;
  run.result.outcome.termination = Termination::infeasible;
  run.result.outcome.message = "no pose will do";
  run.result.infeasibility = found.text();
  run.result.remedies = thinner_wall(session, spec, control);
  design.run = std::move(run.result);
  const RunResult& r = design.run;
  design.before = solid_figures(run, r);
  return design;
}

/// First of all: in another unit, what else is wrong may be right.
void require_unit_said(Session& session, const RunConfig& config, const Control& control) {
  const StopScope scope(control.stop);
  control.tell("read the mesh");
  require_unit_said(config.body, *session.solid(config));
}

/// The question, with a pose where that is left open.
Design make_found(Session& session, const DesignSpec& spec, const Control& control) {
  if (!leaves_open(spec.config)) return make_posed(session, spec, control);
  // The search's domain is coarse: the best there may miss by a little on the part's own, the next does not.
  constexpr std::size_t most_parts = 4;
  std::optional<DesignSpec> first;  // that makes a part, though one that does not do it
  std::string pose_of_first;
  std::optional<RunConfig> open = spec.config;
  if (spec.print.slicing.infill) {
    require_infill_alone(spec);
    open->body.void_density = measure_infill(spec.print.slicing, control).bulk * open->body.density;
  }
  FoundPoses all;
  while (open) {
    FoundPoses found = find_poses(session, *open, control);
    std::ranges::move(found.tried, std::back_inserter(all.tried));
    for (std::size_t i = 0; i < std::min(found.good.size(), most_parts); ++i) {
      DesignSpec one = spec;
      one.config = posed(spec.config, found.good[i]);
      Design design = make_asked(session, one, control);
      design.pose = all.text();
      if (design.does()) return design;
      if (design.feasible() && !first) {
        first = std::move(one);
        pose_of_first = design.pose;
      }
    }
    open = std::move(found.onward);
  }
  if (first) {  // again, as its files were replaced by the next one's
    Design design = make_asked(session, *first, control);
    design.pose = pose_of_first;
    return design;
  }
  return make_none(session, spec, all, control);
}

}  // namespace

Design make_design(Session& session, const DesignSpec& spec, const Control& control) {
  require_unit_said(session, spec.config, control);
  if (!spec.measured_mass) return make_found(session, spec, control);
  require_one_density(spec.config.body);
  DesignSpec first = spec;
  first.file.clear();
  first.gcode.clear();
  first.mould = false;
  Design design = make_found(session, first, control);
  if (!design.feasible()) return design;
  const double expected = design.printed ? design.printed->figures.mass : design.after.mass;
  const Weighed weighed = weighed_as(*spec.measured_mass, expected, spec.config.body.density);
  DesignSpec again = spec;
  again.config.body.density = weighed.density;
  design = make_found(session, again, control);
  design.weighed = weighed;
  return design;
}

}  // namespace kreisel::core
