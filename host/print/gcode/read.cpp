#include "print/gcode/read.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <utility>

#include "error.hpp"
#include "parse.hpp"
#include "print/gcode/levels.hpp"
#include "print/gcode/lines.hpp"
#include "print/gcode/machine.hpp"
#include "print/gcode/remark.hpp"
#include "print/gcode/tally.hpp"
#include "stop.hpp"

namespace kreisel::core {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_line = std::size_t{1} << 20;

/// "1.75,2.85", as far as it is one.
std::vector<double> numbers_of(std::string_view list) {
  std::vector<double> numbers;
  while (numbers.size() < Machine::most_tools) {
    const std::size_t comma = list.find(',');
    const auto number = parse<double>(trimmed(list.substr(0, comma)));
    if (!number) break;
    numbers.push_back(*number);
    if (comma == std::string_view::npos) break;
    list.remove_prefix(comma + 1);
  }
  return numbers;
}

/// For a message: no control characters, and not too long.
std::string shown(std::string_view text) {
  std::string out;
  for (const char c : text.substr(0, 24)) out += c >= ' ' && c <= '~' ? c : '?';
  return out;
}

}  // namespace

class GcodeReader::Impl {
 public:
  explicit Impl(std::string name) : name_(std::move(name)) {}

  void feed(std::string_view block) {
    bytes_ += block.size();
    if (lines_.feed(block, [this](std::string_view text) { line(text); }) > longest_line) {
      ++count_;
      refuse(fmt::format("longer than {} bytes, expected G-code", longest_line));
    }
  }

  Print finish(const FilamentSpec& spec) {
    require_whole();
    Print print;
    print.slicer = slicer_;
    print.bytes = bytes_;
    print.lines = count_;
    for (std::size_t tool = 0; tool < tools_; ++tool) print.filaments.push_back(filament_of(tool, spec));
    tally_.add_to(print, all_volumetric_);
    print.used_mm = used_mm_;
    if (!(print.part_volume() > 0))
      throw InputError(
          fmt::format("{}: prints nothing of a part, expected moves that extrude (G1 with E)", name_));
    if (!print.part_mass().allFinite())
      throw InputError(fmt::format("{}: moments beyond all numbers, expected a print", name_));
    return print;
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw InputError(fmt::format("{}: line {}: {}", name_, count_, what));
  }

  void line(std::string_view text) try {
    ++count_;
    std::string_view comment;
    if (const void* const semicolon = std::memchr(text.data(), ';', text.size())) {
      const auto at = std::size_t(static_cast<const char*>(semicolon) - text.data());
      comment = text.substr(at + 1);
      text = text.substr(0, at);
    }
    if (count_ == 1) require_text(text);
    if (text.empty() || text == "\r") {
      if (!comment.empty()) remark(comment);
      return;
    }
    if (text[0] == 'M' || text[0] == 'E') label(text);
    const Laid laid = machine_.run(text);
    if (laid.filament > 0) lay(laid, comment);
  } catch (const InputError& error) {
    refuse(error.what());
  }

  static void require_text(std::string_view text) {
    if (text.starts_with("GCDE"))
      throw InputError("binary G-code, expected text (of PrusaSlicer: without its setting binary_gcode)");
    if (text.find('\0') != std::string_view::npos) throw InputError("binary data, expected G-code");
  }

  void lay(const Laid& laid, std::string_view comment) {
    if (!types_said_ && !comment.empty() && is_type(trimmed(comment))) tally_.set_type(trimmed(comment));
    // What climbs as it goes, as a vase does, or falls where the nozzle stands, is on no level of its own.
    const bool level = !laid.stands && std::abs(laid.to[2] - laid.from[2]) < Levels::same;
    if (level && levels_.go_to(laid.to[2]) && !layers_said_) tally_.begin_layer();
    const double height = height_ > 0 ? height_ : levels_.height();
    tally_.set_source({machine_.tool(), machine_.volumetric()});
    tools_ = std::max(tools_, std::size_t(machine_.tool()) + 1);
    Beads& beads = tally_.along(laid.from, laid.to);
    // Thicker than the filament itself is no bead, but what comes out as the nozzle all but stands.
    constexpr double usual_area = 2.4;  // mm^2
    const Vec3 way = laid.to - laid.from;
    if (laid.angle != 0)
      beads.add_arc(laid.from, laid.to, laid.centre, laid.angle, laid.filament, height);
    else if (laid.filament * laid.filament >= usual_area * usual_area * (way[0] * way[0] + way[1] * way[1]))
      beads.add_blob(0.5 * (laid.from + laid.to), laid.filament, height);
    else
      beads.add_line(laid.from, laid.to, laid.filament, height);
  }

  void remark(std::string_view comment) {
    const auto said = remark_of(comment);
    if (!said) return;
    const std::string_view value = said->value;
    switch (said->says) {
      case Says::slicer_that_ends:
        ends_said_ = true;
        [[fallthrough]];
      case Says::slicer:
        if (slicer_.empty()) slicer_ = shown(value);
        break;
      case Says::type:
        types_said_ = true;
        tally_.set_type(value);
        break;
      case Says::height:
        height_ = parse<double>(value).value_or(0);
        if (!(height_ > 0 && height_ < 100))
          throw InputError(fmt::format("height '{}', expected mm above 0", shown(value)));
        break;
      case Says::layer:
        layers_said_ = true;
        tally_.begin_layer();
        if (const auto number = parse<int>(value)) {
          last_layer_ = *number;
          raft_ = *number < 0;
          tally_.set_beside(raft_ || purge_);
        }
        break;
      case Says::layer_count:
        layer_count_ = parse<int>(value);
        break;
      case Says::object:
        tally_.set_object(value);
        break;
      case Says::object_ends:
        tally_.set_object({});
        break;
      case Says::purge:
      case Says::purge_ends:
        purge_ = said->says == Says::purge;
        tally_.set_beside(raft_ || purge_);
        break;
      case Says::diameters:
        diameters_ = numbers_of(value);
        break;
      case Says::densities:
        densities_ = numbers_of(value);
        break;
      case Says::volumetric:
        all_volumetric_ = value == "1";
        break;
      case Says::filament_used: {  // Slic3r: "865.9mm (6.1cm3)", a line for each tool
        double sum = used_mm_.value_or(0);
        for (const double mm : numbers_of(value.substr(0, value.find("mm")))) sum += mm;
        used_mm_ = sum;
        ended_ = true;
        break;
      }
      case Says::moves_begin:
        ends_said_ = true;
        break;
      case Says::moves_end:
        ended_ = true;
        break;
    }
  }

  /// Labels that are commands: M486 S0, M486 S-1; EXCLUDE_OBJECT_START NAME=a, EXCLUDE_OBJECT_END.
  void label(std::string_view text) {
    text = trimmed(text);
    constexpr std::string_view number = "M486 S", starts = "EXCLUDE_OBJECT_START",
                               name = "NAME=", ends = "EXCLUDE_OBJECT_END";
    if (text.starts_with(number)) {
      const std::string_view which = text.substr(number.size());
      tally_.set_object(which.starts_with('-') ? std::string_view{} : which);
    } else if (text.starts_with(starts)) {
      const std::size_t at = text.find(name);
      tally_.set_object(at == std::string_view::npos ? "unnamed" : text.substr(at + name.size()));
    } else if (text.starts_with(ends)) {
      tally_.set_object({});
    }
  }

  /// @throws InputError  the file ends before its slicer would have
  void require_whole() {
    if (bytes_ == 0) throw InputError(fmt::format("{}: empty file, expected G-code", name_));
    constexpr const char* cut_off = "expected all of it: it was cut off";
    if (const std::string last = lines_.take_rest(); !last.empty()) {
      line(last);
      if (!trimmed(last).starts_with(';')) refuse(fmt::format("the file ends within this line, {}", cut_off));
    }
    if (ends_said_ && !ended_)
      refuse(fmt::format("the file ends before what its slicer writes last, {}", cut_off));
    if (layer_count_ && last_layer_.value_or(-1) + 1 < *layer_count_)
      refuse(fmt::format("the file ends before the last of {} layers, {}", *layer_count_, cut_off));
  }

  [[nodiscard]] Filament filament_of(std::size_t tool, const FilamentSpec& spec) const {
    Filament filament;
    const auto take = [tool](const std::vector<double>& said, const std::optional<double>& wanted,
                             double& value, bool& assumed) {
      // One number is that of all tools; 0 stands for none.
      const double of_file = said.empty() ? 0 : said[std::min(tool, said.size() - 1)];
      if (!wanted && !(of_file > 0)) return;
      value = wanted.value_or(of_file);
      assumed = false;
    };
    take(diameters_, spec.diameter, filament.diameter, filament.diameter_assumed);
    take(densities_, spec.density, filament.density, filament.density_assumed);
    return filament;
  }

  std::string name_, slicer_;
  Lines lines_;
  std::size_t bytes_ = 0, count_ = 0, tools_ = 1;
  Machine machine_;
  Levels levels_;
  Tally tally_;
  double height_ = 0;  ///< as the slicer says it, mm; 0: it does not
  bool types_said_ = false, layers_said_ = false, raft_ = false, purge_ = false;
  std::vector<double> diameters_, densities_;
  bool all_volumetric_ = false, ends_said_ = false, ended_ = false;
  std::optional<int> layer_count_, last_layer_;
  std::optional<double> used_mm_;
};

GcodeReader::GcodeReader(std::string name) : impl_(std::make_unique<Impl>(std::move(name))) {}
GcodeReader::~GcodeReader() = default;
void GcodeReader::feed(std::string_view block) { impl_->feed(block); }
Print GcodeReader::finish(const FilamentSpec& spec) { return impl_->finish(spec); }

bool is_gcode(const fs::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
  constexpr std::array<std::string_view, 4> known = {".gcode", ".gco", ".g", ".nc"};
  return std::ranges::find(known, extension) != known.end();
}

Print read_gcode(const fs::path& file, const FilamentSpec& spec) {
  const auto refuse = [&](int error) {
    throw InputError(
        fmt::format("{}: {}, expected a readable file of G-code", file.string(), std::strerror(error)));
  };
  std::FILE* const opened = std::fopen(file.c_str(), "rb");
  if (!opened) refuse(errno);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> in(opened, std::fclose);
  GcodeReader reader(file.string());
  std::vector<char> block(std::size_t{1} << 18);
  while (const std::size_t n = std::fread(block.data(), 1, block.size(), in.get())) {
    stop_here();
    reader.feed({block.data(), n});
  }
  if (std::ferror(in.get())) refuse(errno);
  return reader.finish(spec);
}

}  // namespace kreisel::core
