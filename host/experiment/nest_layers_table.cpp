#include "experiment/nest_table.hpp"
#include "experiment/nest_table_parts.hpp"

namespace kreisel::core {
namespace {

Sheet layers_sheet() {
  return Sheet({{"label", "", ""},
                {"layer", "", "layer"},
                {"longest_mm", "inner shape", "mm"},
                {"ratio", "inner shape", "of the outer"},
                {"scale", "inner shape", "scale"},
                {"certified_scale", "inner shape", "certified"},
                {"thickness_mm", "wall", "mm"},
                {"evaluations", "search", "placements"},
                {"seconds", "search", "s"},
                {"device", "", ""},
                {"commit", "", ""}});
}

}  // namespace

Tables nest_layers_tables(const std::vector<RecordedRun>& runs, const std::optional<Published>&) {
  Tables tables;
  for (const RecordedRun& run : runs) {
    Sheet sheet = layers_sheet();
    std::string notes = note_of_nesting(run);
    std::string heading = run.run.label.empty() ? shapes_text(run.run.nesting()) : run.run.label;
    if (has_nesting(run)) {
      double seconds = 0;
      for (std::size_t k = 0; k < run.nest->layers.size(); ++k) {
        const LayerSummary& layer = run.nest->layers[k];
        seconds += layer.seconds;
        sheet.add({run.run.label, fmt::format("{}", k + 1), Cell::of(layer.longest, "{:.1f}"),
                   Cell::of(layer.ratio, "{:.4f}"), Cell::of(layer.scale, "{:.5g}"),
                   Cell::of(layer.certified_scale, "{:.5g}"), Cell::of(layer.thickness, "{:.2f}"),
                   fmt::format("{:.0f}", layer.evaluations), Cell::of(layer.seconds, "{:.1f}"),
                   run.nest->device, run.nest->commit});
      }
      notes += fmt::format("{}; {:.0f} s\n", run.nest->text, seconds);
    }
    tables.blocks.push_back({std::move(heading), std::move(sheet), std::move(notes)});
  }
  tables.legend =
      "of the outer: longest side over that of the shape outside; scale: of the inner shape's mesh; "
      "certified: the largest "
      "near it that the exact test\nconfirms, to 1e-4; wall: the thinnest that is left when the inner shape, "
      "thicker by "
      "the printer's accuracy, is carved out\n" +
      provenance_of_nestings(runs);
  return tables;
}

Tables nest_landscape_tables(const std::vector<RecordedRun>& runs, const std::optional<Published>&) {
  Sheet sheet({{"label", "", "label", true},
               {"shapes", "", "shapes", true},
               {"centroids", "", "centroids"},
               {"rotations", "", "rotations"},
               {"placements", "", "placements"},
               {"descents", "", "searched out"},
               {"seconds", "seconds", "this map"},
               {"full_seconds", "seconds", "256^2 x 256^2"},
               {"scale", "best", "scale"},
               {"certified_scale", "best", "certified"},
               {"degrees", "best", "degrees"},
               {"device", "", ""},
               {"commit", "", ""}});
  std::string notes;
  for (const RecordedRun& run : runs) {
    notes += note_of_nesting(run);
    if (!has_nesting(run) || !run.nest->landscape) continue;
    const LandscapeSummary& map = *run.nest->landscape;
    const double placements = map.inside * map.rotations, centroids = double(map.nx) * map.ny;
    constexpr double full = 256.0 * 256.0;
    sheet.add({run.run.label, run.nest->shapes, fmt::format("{} x {}", map.nx, map.ny),
               fmt::format("{}", map.rotations), fmt::format("{:.3g}", placements),
               fmt::format("{:.0f}", map.descents), Cell::of(map.seconds, "{:.2f}"),
               Cell::of(map.seconds * (full / centroids) * (full / map.rotations), "{:.0f}"),
               Cell::of(map.scale, "{:.4f}"), Cell::of(run.nest->certified_scale, "{:.4f}"),
               Cell::of(map.degrees, "{:.2f}"), run.nest->device, run.nest->commit});
  }
  return {{{"", std::move(sheet), notes}},
          "placements: centroids inside the outer outline times rotations, all decided; searched out: those "
          "that could have "
          "been the best of their centroid;\n256^2 x 256^2: seconds for that many centroids and rotations, "
          "in proportion; "
          "certified: by the exact test on solids of those outlines\n" +
              provenance_of_nestings(runs)};
}

}  // namespace kreisel::core
