#include "design/page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdint>
#include <fstream>
#include <iterator>
#include <string_view>
#include <vector>

#include "design/packed_mesh.hpp"
#include "error.hpp"
#include "geometry/single_precision.hpp"

namespace kreisel::core {
namespace {

/// The fields of a mesh. @param origin  what places are about
std::string geometry(const TriangleMesh& mesh, const Vec3& origin) {
  const PackedMesh small = packed(mesh);
  std::vector<std::uint8_t> bytes = small.links;
  bytes.insert(bytes.end(), small.places.begin(), small.places.end());
  return fmt::format(R"("corners": {}, "triangles": {}, "low": [{}], "step": {}, "packed": "{}")",
                     small.corners, small.triangles, fmt::join(Vec3(small.low - origin), ", "), small.step,
                     compressed_text(bytes.data(), bytes.size()));
}

/// @param skin    the page can hide it
/// @param before  the same triangles as they were before a deformation; nothing: there was none
std::string surface(const TriangleMesh& mesh, const Vec3& origin, std::string_view colour, bool skin = false,
                    const TriangleMesh* before = nullptr) {
  const std::string was = before ? fmt::format(R"(, "before": {{{}}})", geometry(*before, origin)) : "";
  return fmt::format(R"({{"colour": "{}", "skin": {}, {}{}}})", colour, skin, geometry(mesh, origin), was);
}

void replace(std::string& text, std::string_view mark, const std::string& with) {
  const std::size_t at = text.find(mark);
  text.replace(at, mark.size(), with);
}

/// Text inside a script must not end it.
std::string within_script(const std::string& text) {
  std::string safe;
  safe.reserve(text.size());
  for (const char c : text) {
    if (c == '/' && safe.ends_with('<')) safe += '\\';
    safe += c;
  }
  return safe;
}

std::string page(const std::string& bodies, const Vec3& origin, const std::string& report,
                 const std::string& three) {
  std::string text = page_template;
  replace(text, "@BODIES@", bodies);
  replace(text, "@ORIGIN@", fmt::format("[{}]", fmt::join(origin, ", ")));
  replace(text, "@REPORT@", within_script(report));
  replace(text, "@THREE@", compressed_text(three.data(), three.size()));
  return text;
}

}  // namespace

std::string page_of(const Design& design, const std::string& three) {
  const Vec3 origin = place_of(bounding_box(design.part.outer));
  // Packed by the same triangles, corners have the same numbers.
  const auto& deformed = design.run.deformation;
  const bool moved =
      deformed && deformed->largest_mm > 0 && deformed->before.triangles == design.part.outer.triangles;
  const std::string surfaces =
      surface(design.part.outer, origin, "#b9c4ce", true, moved ? &deformed->before : nullptr) + ", " +
      surface(design.part.cavity, origin, "#7fc0b6");
  return page(fmt::format(R"([{{"cap": "#e9c46a", "surfaces": [{}]}}])", surfaces), origin, to_json(design),
              three);
}

std::string page_of(const Nested& nested, const std::string& three) {
  constexpr std::string_view colours[] = {"#b9c4ce", "#7fc0b6", "#d8a48f", "#a9b665", "#b7a3d0"},
                             caps[] = {"#e9c46a", "#2a9d8f", "#e76f51", "#6a994e", "#7b5ea7"};
  std::string bodies;
  Box box;
  for (const NestedPart& part : nested.parts)
    for (const Vec3& v : part.mesh.vertices) box.add(v);
  const Vec3 origin = place_of(box);
  for (const NestedPart& part : nested.parts) {
    const std::size_t k = part.layer % std::size(colours);
    const Vec3 apart = nested.apart(part);
    bodies += fmt::format(R"({}{{"cap": "{}", "apart": [{}, {}, {}], "surfaces": [{}]}})",
                          bodies.empty() ? "" : ", ", caps[k], apart[0], apart[1], apart[2],
                          surface(part.mesh, origin, colours[k]));
  }
  return page("[" + bodies + "]", origin, to_json(nested), three);
}

std::string installed_three() {
  constexpr const char* path = "/usr/share/javascript/three/three.min.js";
  std::ifstream in(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  if (text.empty())
    throw InputError(
        fmt::format("--html: {}: no such file; expected three.js there (apt install libjs-three)", path));
  return text;
}

}  // namespace kreisel::core
