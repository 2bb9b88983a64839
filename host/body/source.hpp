// source.hpp - where a body's mesh comes from.
#pragma once

#include <filesystem>
#include <string>

#include "body/body.hpp"
#include "mesh/solid/solid.hpp"

namespace kreisel::core {

/// A mesh with what its origin says of it.
struct Source {
  std::string name;
  std::string format;  ///< in words: a file format, or where else it comes from
  TriangleMesh mesh;
  bool ours = false;  ///< made by the project: sound by its tests
  Vec3 axis = Vec3::UnitZ(), up = Vec3::UnitZ();
  std::optional<Vec3> contact;
  std::optional<double> size;             ///< to be scaled to, mm
  double millimetres = 1;                 ///< one unit of the mesh
  double weld = 0;                        ///< corners this near at open edges are one, in units of the mesh
  Mending mending = {};                   ///< what else is allowed
  std::vector<std::string> repairs = {};  ///< what was passed over and mended, one line each
  std::vector<Piece> pieces = {};         ///< of the solid, largest first; in units of the mesh
};

/// The model of that name, made or fetched, or the mesh file, here or in models_folder(), neither checked nor
/// mended.
/// @throws InputError  neither a name (says the nearest) nor a readable file; fineness < 0; a unit for what
///                     has one; welding of what is whole
[[nodiscard]] Source load_source(const BodySpec& spec);

/// The same with a mesh that bounds a solid: a file's is mended where that is safe, then checked (solid.hpp).
/// @throws InputError  as load_source(), or no solid; or several that do not touch (require_one_piece())
[[nodiscard]] Source load_solid(const BodySpec& spec);

/// The mended surface of its mesh, which it takes, with what is said of the mesh so far.
[[nodiscard]] Surface surface_of(Source& source);

/// The source with the mended surface of its mesh. @throws InputError  that bounds no solid
[[nodiscard]] Source as_solid(Source source, Surface& surface, const std::string& model);

/// Nothing where it is one rigid piece, or where somebody said which pieces are meant.
/// @param solid  as_solid()  @param size, density  mm and g/cm^3, to say what each weighs
/// @throws InputError  it is several that do not touch
void require_one_piece(const Source& solid, const std::string& model, std::optional<double> size,
                       double density);

/// make_body() with the mesh at hand. @param solid  with the mesh of a solid
[[nodiscard]] Body make_body(const BodySpec& spec, Source solid, device::Device& device);
/// The same without a device: integrated on the host.
[[nodiscard]] Body make_body(const BodySpec& spec, Source solid);

/// Where mesh files are looked for that are not where their name says: $KREISEL_MODELS, else `models` in the
/// current folder.
[[nodiscard]] std::filesystem::path models_folder();

/// Every name that a shape has without a file: models() and debian_meshes().
[[nodiscard]] std::vector<std::string> shape_names();

/// Whether the name is that of a mesh file which is neither there, seen from the current folder, nor in
/// models_folder(). False for the name of a model.
[[nodiscard]] bool is_absent_file(const std::string& model);

/// Looks at the names alone: a file may still be missing or broken.
/// @throws InputError  neither the name of a model nor like that of a file, says the nearest; a unit for what
///                     has one
void require_known_source(const BodySpec& spec);

/// Whether its numbers are mm, nobody has said of such a file: what would be smaller than a pea or larger
/// than a table is more likely in another unit.
/// @param solid  load_solid(spec)
/// @throws InputError  its longest side is below 5 or above 1000, of a file that says no unit, with neither
///                     unit nor size given: names what each would give
void require_unit_said(const BodySpec& spec, const Source& solid);

}  // namespace kreisel::core
