#include "mesh/io/read_obj.hpp"

#include <fmt/format.h>

#include <map>

#include "mesh/io/polygons.hpp"
#include "mesh/io/text.hpp"
#include "parse.hpp"
#include "stop.hpp"

namespace kreisel::core {
namespace {

/// The statements of an OBJ file: a backslash at the end of a line continues it on the next, not so in a
/// comment.
class Statements {
 public:
  explicit Statements(const MeshFile& file) : name_(file.name), rest_(text_of(file)) {}

  /// Moves to the next line with content; false at the end of the file. @param line  valid until the next
  /// call
  bool next(std::string_view& line) {
    while (!rest_.empty()) {
      number_ += 1 + continued_;
      continued_ = 0;
      line = cut();
      if (continues(line)) line = join(line);
      std::string_view probe = line;
      if (!next_word(probe).empty()) return true;
    }
    return false;
  }

  /// An error at the current line, the first of those that are continued.
  [[nodiscard]] InputError error(std::string_view what) const {
    return InputError(fmt::format("{}: line {}: {}", name_, number_, what));
  }

 private:
  /// The next line without its comment.
  std::string_view cut() {
    const std::string_view line = cut_line(rest_);
    return line.substr(0, line.find('#'));
  }

  /// Cuts the backslash off.
  static bool continues(std::string_view& line) {
    const std::size_t last = line.find_last_not_of(" \t\v\f");
    if (last == std::string_view::npos || line[last] != '\\') return false;
    line = line.substr(0, last);
    return true;
  }

  std::string_view join(std::string_view line) {
    joined_ = line;
    for (bool more = true; more && !rest_.empty();) {
      line = cut();
      ++continued_;
      more = continues(line);
      (joined_ += ' ') += line;
    }
    return joined_;
  }

  const std::string& name_;
  std::string_view rest_;
  std::string joined_;
  std::size_t number_ = 0, continued_ = 0;
};

class ObjReader {
 public:
  explicit ObjReader(const MeshFile& file) : file_(file), statements_(file) {}

  MeshReading read() {
    for (std::string_view line; statements_.next(line);) {
      stop_here();
      const std::string_view keyword = next_word(line);
      if (keyword == "v")
        add_vertex(line);
      else if (keyword == "f" || keyword == "fo")  // its name before 1995
        add_face(line);
      else if (keyword != "vt" && keyword != "vn")
        ++passed_over_[shown(keyword)];
    }
    require_indices();
    MeshReading reading = triangulated(std::move(mesh_));
    reading.weld = digits_.weld(largest_coordinate(reading.mesh));
    if (!passed_over_.empty()) reading.notes.push_back(what_was_passed_over());
    return reading;
  }

 private:
  /// Behind the coordinates may be a weight or a colour.
  void add_vertex(std::string_view line) {
    Vec3 p;
    for (double& x : p) {
      const std::string_view word = next_word(line);
      const auto value = parse<double>(word);
      if (!value)
        throw statements_.error(fmt::format("coordinate '{}' of vertex {}, expected three finite numbers",
                                            shown(word), mesh_.vertices.size() + 1));
      digits_.see(word, *value);
      x = *value;
    }
    mesh_.vertices.push_back(p);
  }

  /// Each corner is vertex/texture/normal, of which only the vertex is read; below 0 it counts back from the
  /// last vertex so far.
  void add_face(std::string_view line) {
    corners_.clear();
    for (std::string_view word; !(word = next_word(line)).empty();) {
      const auto index = parse<std::int64_t>(word.substr(0, word.find('/')));
      if (!index || *index == 0 || *index > UINT32_MAX)
        throw statements_.error(
            fmt::format("vertex index '{}', expected a whole number, 1 or more", shown(word)));
      const std::int64_t place = *index > 0 ? *index - 1 : *index + std::int64_t(mesh_.vertices.size());
      if (place < 0) throw bad_index(mesh_.faces() + 1, *index);
      corners_.push_back(std::uint32_t(place));
    }
    if (corners_.size() < 3)
      throw statements_.error(fmt::format("face of {} corners, expected 3 or more", corners_.size()));
    mesh_.add(corners_);
  }

  /// A face may come before its vertices.
  void require_indices() const {
    for (std::size_t f = 0; f < mesh_.faces(); ++f)
      for (const std::uint32_t v : mesh_.face(f))
        if (v >= mesh_.vertices.size()) throw bad_index(f + 1, std::int64_t{v} + 1);
  }

  [[nodiscard]] InputError bad_index(std::size_t face, std::int64_t index) const {
    return InputError(fmt::format("{}: face {} has vertex index {}, expected 1 to {}", file_.name, face,
                                  index, mesh_.vertices.size()));
  }

  [[nodiscard]] std::string what_was_passed_over() const {
    constexpr std::size_t most = 12;  // a file of something else has any words
    std::string text = "passed over";
    std::size_t told = 0;
    for (const auto& [keyword, count] : passed_over_) {
      if (told++ == most) return text + " and others";
      text += fmt::format("{} {} of '{}'", told == 1 ? "" : ",", count, keyword);
    }
    return text;
  }

  const MeshFile& file_;
  Statements statements_;
  PolygonMesh mesh_;
  Digits digits_;
  std::vector<std::uint32_t> corners_;
  std::map<std::string, std::size_t> passed_over_;
};

}  // namespace

MeshReading read_obj(const MeshFile& file) { return ObjReader(file).read(); }

}  // namespace kreisel::core
