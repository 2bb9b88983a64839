#include "live/part_fields.hpp"

#include "mesh/io/format.hpp"
#include "settings/field_text.hpp"

namespace kreisel::core::live {

using namespace field_text;

const Fields<PartSpec>& part_fields() {
  using P = PartSpec&;
  using ConstP = const PartSpec&;
  using S = std::string_view;
  static const Fields<PartSpec> all = grouped<PartSpec>(
      "the part",
      {chosen_from<PartSpec>(
           [] {
             std::vector<std::string> names;
             for (const MeshFormat& format : mesh_formats()) names.emplace_back(format.extension.substr(1));
             return names;
           },
           {"format", "", "of the files",
            [](P p, S, S v) { p.format = mesh_format("part." + std::string(v)).extension.substr(1); },
            [](ConstP p) { return p.format; }}),
       {"printer-accuracy", "mm", "a wall thinner than this is refused",
        [](P p, S k, S v) { p.printer_accuracy = positive(k, v); },
        [](ConstP p) { return number_text(p.printer_accuracy); }},
       {"tolerance", "mm", "how far the surface of voids may be off for fewer triangles",
        [](P p, S k, S v) { p.tolerance = not_negative(k, v); },
        [](ConstP p) { return number_text(p.tolerance); }},
       {"cut", "NX,NY,NZ,D", "where it is cut: auto (by the planes that open its voids), or a plane",
        [](P p, S, S v) { p.cut = v; }, [](ConstP p) { return p.cut; }},
       {"pegs", "mm", "radius of two pins that align the halves of a cut",
        [](P p, S k, S v) { p.peg_radius = positive(k, v); },
        [](ConstP p) { return number_text(p.peg_radius); }},
       {"drain", "mm", "radius of a hole from every void to the outside",
        [](P p, S k, S v) { p.drain_radius = positive(k, v); },
        [](ConstP p) { return number_text(p.drain_radius); }},
       one_of<PartSpec>(
           "lay-flat", "pieces of a cut beside each other, each on its cut", {"no", "yes"},
           [](auto& p) -> auto& { return p.lay_flat; })});
  return all;
}

}  // namespace kreisel::core::live
