#include "live/make.hpp"

#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <utility>
#include <vector>

#include "design/page.hpp"
#include "error.hpp"
#include "live/pages.hpp"

namespace kreisel::core::live {
namespace {

/// That nobody else can look into, removed with all that is in it.
class PrivateFolder {
 public:
  PrivateFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "kreisel-live-XXXXXX").string();
    if (!::mkdtemp(name.data())) throw InputError(fmt::format("{}: no folder can be made there", name));
    path_ = name;
  }
  ~PrivateFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Its files by their names, in their order.
  [[nodiscard]] std::vector<std::filesystem::path> files() const {
    std::vector<std::filesystem::path> all;
    for (const auto& entry : std::filesystem::directory_iterator(path_))
      if (entry.is_regular_file()) all.push_back(entry.path());
    std::ranges::sort(all);
    return all;
  }

 private:
  std::filesystem::path path_;
};

std::string contents(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

void make(const nlohmann::json& id, Session& session, PartSpec spec, const Send& send, std::stop_token stop) {
  const auto told = [&](const char* what) { return nlohmann::json{{"do", what}, {"id", id}}; };
  const PrivateFolder folder;
  spec.config.part = Part::written;
  spec.file =
      folder.path() / fmt::format("{}-{}.{}", model_text(spec.config), spec.config.problem, spec.format);
  if (spec.print.wanted()) spec.gcode = std::filesystem::path(spec.file).replace_extension(".gcode");
  const Control control{std::move(stop), [&](const std::string& step) {
                          nlohmann::json said = told("step");
                          said["text"] = step;
                          send(message(said, "step"));
                        }};
  Design design = make_design(session, spec, control);
  for (auto& file : design.files) file = file.filename();  // where they lay is nobody's business
  const auto send_file = [&](const std::string& name, std::string_view bytes) {
    nlohmann::json said = told("file");
    said["name"] = name;
    send(with_bytes(said, bytes));
  };
  for (const auto& file : folder.files()) send_file(file.filename().string(), contents(file));
  if (const PageFile* three = find_page("three.min.js"); three && design.feasible())
    send_file(spec.file.stem().string() + ".html", page_of(design, std::string(three->text)));
  nlohmann::json made = told("made");
  made["ok"] = design.does();
  made["report"] = nlohmann::json::parse(to_json(design));
  made["text"] = design.feasible() ? design.after.verdict.text : design.run.infeasibility;
  send(message(made));
}

}  // namespace kreisel::core::live
