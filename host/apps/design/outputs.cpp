#include "apps/design/outputs.hpp"

#include <fmt/format.h>

#include <utility>

#include "apps/shared/outputs.hpp"
#include "error.hpp"
#include "file/replace_file.hpp"
#include "file/write_text.hpp"
#include "mesh/io/format.hpp"

namespace kreisel::core::apps {

void DesignOutputs::add(CLI::App& app, const std::string& what) {
  app.option_defaults()->group("Output");
  app.add_option("-o,--output", part, what + ": .stl, .3mf (with units), .obj, .ply or .off, mm")
      ->type_name("FILE")
      ->required();
  app.add_option("--json", json, "write a report as JSON; - writes it to standard output")->type_name("FILE");
  app.add_option("--html", html, "write a page for a browser: a view, a cut to move, and the numbers")
      ->type_name("FILE");
  app.add_flag("--force", force, "overwrite files that exist");
  app.option_defaults()->group("Options");
}

void DesignOutputs::require_writable() const {
  (void)mesh_format(part);
  apps::require_replaceable(part, "--output");
  for (const auto& [file, option] : {std::pair{part, "--output"}, std::pair{json, "--json"},
                                     std::pair{html, "--html"}, std::pair{gcode, "--gcode"}}) {
    apps::require_writable(file, option);
    if (!file.empty() && file != "-" && !is_written_in_place(file)) require_new(file, option, force);
  }
}

bool DesignOutputs::write_report(const std::string& text) const {
  if (json == "-") {
    fmt::print("{}", text);  // alone on standard output, for a pipe
    return false;
  }
  if (!json.empty()) write_text(json, text);
  return true;
}

void require_new(const std::filesystem::path& file, const char* option, bool force) {
  if (!force && std::filesystem::exists(file))
    throw InputError(fmt::format("{} {} exists; expected a new name, or --force", option, file.string()));
}

}  // namespace kreisel::core::apps
