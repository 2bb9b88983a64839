// design.hpp - a mesh in, a printable part out.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "design/figures.hpp"
#include "design/infilled.hpp"
#include "design/moulds.hpp"
#include "design/printed.hpp"
#include "design/supports.hpp"
#include "design/weighed.hpp"
#include "fabricate/drain.hpp"
#include "fabricate/thickness.hpp"
#include "session/make_part.hpp"

namespace kreisel::core {

struct DesignSpec {
  RunConfig config;            ///< with part = written
  std::filesystem::path file;  ///< where the part goes; empty: nowhere
  /// mm, the least that can be printed: no wall may be thinner, and voids of less than a cube of five times
  /// as much stay filled.
  double printer_accuracy = 0.4;
  /// How far the surface of voids may be off for fewer triangles, mm; nothing: a tenth of the accuracy; 0:
  /// every triangle stays.
  std::optional<double> tolerance;
  /// Where the part is cut: "auto", by the planes that open all voids; or "NX,NY,NZ,D", where normal . x = D,
  /// model coordinates in mm. Empty: it stays whole.
  std::string cut;
  double peg_radius = 0;    ///< of pins that align the halves of a cut, mm; 0: none
  double drain_radius = 0;  ///< of a hole into every void, mm; 0: none
  bool mould = false;       ///< moulds are written for solids that are denser than the shell
  bool lay_flat = false;    ///< pieces of cuts are written beside each other, each on its cut
  PrintSpec print;
  /// Of what was made first by all of this, g: the density is set right by it, and the part solved again.
  std::optional<double> measured_mass;
  std::filesystem::path gcode;  ///< where that goes; empty: nowhere
};

/// The configuration with what finishes the part, by the names of options: what reproduces it.
[[nodiscard]] std::map<std::string, std::string> describe(const DesignSpec& spec);

/// A part that was made, with the solid it was made of beside it.
struct Design {
  std::map<std::string, std::string> config;  ///< describe()
  RunResult run;
  PartMeshes part;             ///< model coordinates, mm; no cavity where the problem is infeasible
  Figures before, after;       ///< the solid; the part, from the files as read again
  Residual residual{};         ///< of the part
  double wall = 0;             ///< least of the part, mm; infinite without a cavity
  ThinPlace thinnest{0};       ///< of its material, walls and webs between voids
  double printer_accuracy;     ///< as asked, mm
  std::vector<Plane> cuts;     ///< by which it was cut
  std::vector<double> pieces;  ///< mm^3, that lie loose then, the largest first
  std::vector<Drain> drains;   ///< holes into voids
  double drain_radius = 0;     ///< as asked, mm; 0: none
  std::vector<WrittenMould> moulds;
  std::optional<InfillUse> infill;     ///< in place of voids
  std::optional<PrintedPart> printed;  ///< where a slicer was asked for
  std::optional<Supports> supports;    ///< that it would take everywhere
  std::optional<FoundUp> found_up;     ///< where it was asked for
  std::optional<Weighed> weighed;      ///< where somebody weighed the first one
  std::optional<SurvivedErrors>
      survives;                  ///< of the print, or else of the part, where it does what was asked
  std::vector<Residual> rounds;  ///< of each print that was tried
  bool print_balanced = false;   ///< what was asked is asked of the print, not of the mesh
  std::string pose;              ///< how it was found, where it was left open
  std::string other_axes;        ///< where it does not do it as it was posed: in which poses it can
  std::vector<std::filesystem::path> files;

  /// The verdict on what was asked: of the part's files, or of its print.
  [[nodiscard]] const Verdict& verdict() const {
    return print_balanced ? printed->figures.verdict : run.verified.verdict;
  }
  [[nodiscard]] bool does() const { return feasible() && verdict().ok; }
  [[nodiscard]] bool feasible() const { return run.outcome.termination != Termination::infeasible; }
};

/// One run, its part written and measured. Where the problem is infeasible nothing is written.
/// @throws InputError   as run(); a wall below the printer's accuracy
/// @throws Interrupted  nothing is written
[[nodiscard]] Design make_design(Session& session, const DesignSpec& spec, const Control& control = {});

/// As JSON, by the field names of docs/output.md.
[[nodiscard]] std::string to_json(const Design& design);

}  // namespace kreisel::core
