#include "print/printer/printer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <system_error>

#include "error.hpp"
#include "nearest.hpp"
#include "parse.hpp"

namespace kreisel::core {
namespace {

namespace fs = std::filesystem;

using Section = std::map<std::string, std::string, std::less<>>;

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// [name] and key = value; what is neither is passed over.
std::vector<std::pair<std::string, Section>> sections_of(std::string_view text) {
  std::vector<std::pair<std::string, Section>> sections;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = trimmed(text.substr(0, end));
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
    const std::size_t equals = line.find('=');
    if (line.starts_with('[') && line.ends_with(']'))
      sections.push_back({std::string(line.substr(1, line.size() - 2)), {}});
    else if (!line.empty() && line[0] != '#' && line[0] != ';' && equals != std::string_view::npos &&
             !sections.empty())
      sections.back().second[std::string(trimmed(line.substr(0, equals)))] = trimmed(line.substr(equals + 1));
  }
  return sections;
}

/// @param text  outlives what is returned
std::vector<std::string_view> split(std::string_view text, char at) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t end = text.find(at);
    if (const std::string_view part = trimmed(text.substr(0, end)); !part.empty()) parts.push_back(part);
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

std::optional<Eigen::Vector2d> point_of(std::string_view text) {
  const std::size_t times = text.find('x');
  if (times == std::string_view::npos) return std::nullopt;
  const auto x = parse<double>(trimmed(text.substr(0, times))),
             y = parse<double>(trimmed(text.substr(times + 1)));
  if (!x || !y) return std::nullopt;
  return Eigen::Vector2d(*x, *y);
}

std::string value(const Section& section, std::string_view key) {
  const auto found = section.find(key);
  return found == section.end() ? std::string{} : found->second;
}

/// Of several, by tool, the first.
double first_number(const Section& section, std::string_view key) {
  const std::string text = value(section, key);
  return parse<double>(trimmed(std::string_view(text).substr(0, text.find_first_of(",;")))).value_or(0);
}

std::vector<Printer> ours() {
  std::vector<Printer> all;
  for (const auto& [name, section] : sections_of(newer_printers)) {
    Printer printer{name, {}, {}, first_number(section, "height"), {}, 0, 0, value(section, "source")};
    const Eigen::Vector2d far = point_of(value(section, "bed")).value_or(Eigen::Vector2d::Zero());
    printer.bed = {{0, 0}, {far[0], 0}, far, {0, far[1]}};
    const std::string nozzles = value(section, "nozzles");
    for (const std::string_view nozzle : split(nozzles, ' '))
      printer.nozzles.push_back(parse<double>(nozzle).value_or(0));
    const std::string layers = value(section, "layers");
    if (const auto two = split(layers, ' '); two.size() == 2) {
      printer.least_layer = parse<double>(two[0]).value_or(0);
      printer.most_layer = parse<double>(two[1]).value_or(0);
    }
    all.push_back(std::move(printer));
  }
  return all;
}

/// Its sections may inherit each other's values, as `inherits = *common*; *small*` says.
class Inheritance {
 public:
  explicit Inheritance(const std::vector<std::pair<std::string, Section>>& sections) {
    for (const auto& [name, section] : sections)
      if (name.starts_with("printer:")) by_name_[name.substr(8)] = &section;
  }
  [[nodiscard]] std::string value(const Section& section, std::string_view key, int depth = 0) const {
    constexpr int deepest = 32;  // more only where they go round in a circle
    if (const auto own = section.find(key); own != section.end()) return own->second;
    const auto parents = section.find("inherits");
    if (parents == section.end() || depth == deepest) return {};
    const auto names = split(parents->second, ';');
    for (auto name = names.rbegin(); name != names.rend(); ++name) {  // the last one is the strongest
      const auto parent = by_name_.find(*name);
      if (parent == by_name_.end()) continue;
      if (std::string found = value(*parent->second, key, depth + 1); !found.empty()) return found;
    }
    return {};
  }

 private:
  std::map<std::string, const Section*, std::less<>> by_name_;
};

std::string without_doubled(std::string text, std::string_view what) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += what.size() / 2)
    text.erase(at, what.size() / 2);
  return text;
}

std::string in_small_letters(std::string_view text) {
  std::string low(text);
  std::ranges::transform(low, low.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
  return low;
}

void add_folder(std::vector<Printer>& all, const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (entry.path().extension() == ".ini") files.push_back(entry.path());
  std::ranges::sort(files);
  for (const fs::path& file : files) {
    std::ifstream in(file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    for (Printer& printer :
         printers_of_slicer(text, fmt::format("PrusaSlicer, {}", file.filename().string())))
      if (std::ranges::find(all, printer.name, &Printer::name) == all.end())
        all.push_back(std::move(printer));
  }
}

}  // namespace

bool Printer::holds(const TriangleMesh& laid) const {
  constexpr double slack = 1e-6;
  return std::ranges::all_of(laid.vertices, [&](const Vec3& v) {
    if (v[2] > height + slack) return false;
    int left = 0, right = 0;
    for (std::size_t i = 0; i < bed.size(); ++i) {
      const Eigen::Vector2d side = bed[(i + 1) % bed.size()] - bed[i], to = v.head<2>() - bed[i];
      const double turn = side[0] * to[1] - side[1] * to[0], least = slack * side.norm();
      left += turn > least;
      right += turn < -least;
    }
    return left == 0 || right == 0;
  });
}

Box Printer::box() const {
  Box box;
  for (const Eigen::Vector2d& corner : bed) {
    box.add(Vec3(corner[0], corner[1], 0));
    box.add(Vec3(corner[0], corner[1], height));
  }
  return box;
}

std::string Printer::size_text() const {
  const Vec3 size = box().extent();
  return fmt::format("{:.4g} x {:.4g} x {:.4g} mm", size[0], size[1], size[2]);
}

std::string Printer::bed_text() const {
  std::string text;
  for (const Eigen::Vector2d& corner : bed)
    text += fmt::format("{}{}x{}", text.empty() ? "" : ",", corner[0], corner[1]);
  return text;
}

std::vector<Printer> printers_of_slicer(std::string_view text, const std::string& source) {
  const auto sections = sections_of(text);
  const Inheritance inherited(sections);
  std::map<std::string, std::string> names;  // of models
  std::map<std::string, double> usual;       // nozzle of each: what its variants begin with
  for (const auto& [name, section] : sections)
    if (name.starts_with("printer_model:"))
      if (const std::string full = value(section, "name"); !full.empty()) {
        names[name.substr(14)] = without_doubled(full, "&&");
        usual[name.substr(14)] = first_number(section, "variants");
      }
  std::vector<Printer> all;
  for (const auto& [name, section] : sections) {
    if (!name.starts_with("printer:") || name.starts_with("printer:*")) continue;
    const auto of = [&](std::string_view key) { return inherited.value(section, key); };
    const std::string model = of("printer_model");
    if (!names.contains(model) || of("printer_technology") == "SLA") continue;
    Section own;
    for (const char* key : {"nozzle_diameter", "max_print_height", "min_layer_height", "max_layer_height"})
      own[key] = of(key);
    const double nozzle = first_number(own, "nozzle_diameter");
    if (const auto known = std::ranges::find(all, names[model], &Printer::name); known != all.end()) {
      if (!(nozzle > 0) || std::ranges::find(known->nozzles, nozzle) != known->nozzles.end()) continue;
      known->nozzles.push_back(nozzle);
      if (nozzle != usual[model]) continue;
      std::ranges::rotate(known->nozzles, known->nozzles.end() - 1);
      known->least_layer = first_number(own, "min_layer_height");
      known->most_layer = first_number(own, "max_layer_height");
      continue;
    }
    Printer printer{names[model],
                    {model},
                    {},
                    first_number(own, "max_print_height"),
                    {nozzle},
                    first_number(own, "min_layer_height"),
                    first_number(own, "max_layer_height"),
                    source};
    const std::string bed = of("bed_shape");
    for (const std::string_view corner : split(bed, ','))
      if (const auto point = point_of(corner)) printer.bed.push_back(*point);
    if (printer.bed.size() < 3 || !(printer.height > 0) || !(nozzle > 0)) continue;
    all.push_back(std::move(printer));
  }
  return all;
}

const std::vector<Printer>& printers() {
  static const std::vector<Printer> all = [] {
    std::vector<Printer> found = ours();
    // What the user has installed is newer than what came with the slicer.
    const char* const config = std::getenv("XDG_CONFIG_HOME");
    const char* const home = std::getenv("HOME");
    if (config && *config)
      add_folder(found, fs::path(config) / "PrusaSlicer" / "vendor");
    else if (home)
      add_folder(found, fs::path(home) / ".config" / "PrusaSlicer" / "vendor");
    add_folder(found, "/usr/share/PrusaSlicer/profiles");
    return found;
  }();
  return all;
}

namespace {

const Printer& by_name(std::string_view name) {
  const std::string wanted = in_small_letters(name);
  std::vector<std::string> names;
  std::vector<const Printer*> partly;
  for (const Printer& printer : printers()) {
    std::vector<std::string> own = printer.also;
    own.push_back(printer.name);
    bool part = false;
    for (const std::string& one : own) {
      const std::string low = in_small_letters(one);
      if (low == wanted) return printer;
      part = part || (!wanted.empty() && low.find(wanted) != std::string::npos);
      names.push_back(low);
    }
    if (part) partly.push_back(&printer);
  }
  if (partly.size() == 1) return *partly.front();
  std::string some;
  for (std::size_t i = 0; i < std::min<std::size_t>(partly.size(), 4); ++i)
    some += fmt::format("{}{}", some.empty() ? "" : ", ", partly[i]->name);
  const std::string meant = nearest(wanted, names);
  throw InputError(fmt::format(
      "--printer {}: {}, expected one of those that `design --printer list` lists", name,
      !some.empty()   ? fmt::format("several go by it ({}{})", some, partly.size() > 4 ? ", ..." : "")
      : meant.empty() ? std::string("unknown")
                      : fmt::format("unknown (did you mean {}?)", meant)));
}

}  // namespace

Printer find_printer(std::string_view name) {
  const std::size_t at = name.rfind('@');
  Printer printer = by_name(name.substr(0, at));
  if (at == std::string_view::npos) return printer;
  const auto nozzle = parse<double>(name.substr(at + 1));
  const auto has = nozzle ? std::ranges::find(printer.nozzles, *nozzle) : printer.nozzles.end();
  if (has == printer.nozzles.end())
    throw InputError(
        fmt::format("--printer {}: no such nozzle, expected {}", name, fmt::join(printer.nozzles, ", ")));
  if (has != printer.nozzles.begin()) {
    std::iter_swap(printer.nozzles.begin(), has);
    printer.least_layer = printer.most_layer = 0;  // were the usual one's
  }
  return printer;
}

}  // namespace kreisel::core
