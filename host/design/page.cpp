#include "design/page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <bit>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <string_view>

#include "error.hpp"
#include "geometry/single_precision.hpp"

namespace kreisel::core {
namespace {

std::string base64(const std::vector<std::uint32_t>& words) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const std::size_t bytes = 4 * words.size();
  const auto byte = [&](std::size_t i) { return i < bytes ? words[i / 4] >> (8 * (i % 4)) & 255u : 0u; };
  std::string text;
  text.reserve((bytes + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes; i += 3) {
    const std::uint32_t three = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    for (int k = 0; k < 4; ++k)
      text += i + static_cast<std::size_t>(k) > bytes ? '=' : digits[three >> (18 - 6 * k) & 63u];
  }
  return text;
}

/// Little-endian floats and indices. @param origin  what positions are about  @param skin  the page can hide
/// it
std::string surface(const TriangleMesh& mesh, const Vec3& origin, std::string_view colour,
                    bool skin = false) {
  std::vector<std::uint32_t> positions, indices;
  positions.reserve(3 * mesh.vertices.size());
  for (const Vec3& v : mesh.vertices)
    for (const float x : (v - origin).cast<float>()) positions.push_back(std::bit_cast<std::uint32_t>(x));
  indices.reserve(3 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) indices.insert(indices.end(), t.begin(), t.end());
  return fmt::format(R"({{"colour": "{}", "skin": {}, "positions": "{}", "indices": "{}"}})", colour, skin,
                     base64(positions), base64(indices));
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
  replace(text, "@THREE@", three);
  return text;
}

}  // namespace

std::string page_of(const Design& design, const std::string& three) {
  const Vec3 origin = place_of(bounding_box(design.part.outer));
  const std::string surfaces = surface(design.part.outer, origin, "#b9c4ce", true) + ", " +
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
