#include "mesh/encode.hpp"
#include "mesh/lib3mf_handle.hpp"

namespace kreisel {
namespace {

/// The library writes coordinates with fixed digits and refuses larger ones when it reads.
constexpr double largest_coordinate = 1e9;

}  // namespace

std::string encode_3mf(const std::vector<TriangleMesh>& parts, const std::string& name) {
  const TriangleMesh mesh = joined(parts, name);
  require_coordinates_within(largest_coordinate, "coordinates within 1e9 mm in a 3MF file", mesh, name);
  std::vector<NMR::MODELMESHVERTEX> vertices;
  std::vector<NMR::MODELMESHTRIANGLE> triangles;
  for (const Vec3& v : mesh.vertices)
    vertices.push_back({{static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())}});
  for (const auto& [a, b, c] : mesh.triangles) triangles.push_back({{a, b, c}});

  const auto require = [&](LIB3MFRESULT result, const Lib3mfHandle& object) {
    require_3mf(result, object.get(), name, "a mesh that 3MF can hold");
  };
  Lib3mfHandle model, object, item, writer;
  require(NMR::lib3mf_createmodel(model.out()), model);
  require(NMR::lib3mf_model_setunit(model.get(), NMR::MODELUNIT_MILLIMETER), model);
  require(NMR::lib3mf_model_addmeshobject(model.get(), object.out()), model);
  require(NMR::lib3mf_meshobject_setgeometry(object.get(), vertices.data(), DWORD(vertices.size()),
                                             triangles.data(), DWORD(triangles.size())),
          object);
  require(NMR::lib3mf_model_addbuilditem(model.get(), object.get(), nullptr, item.out()), model);
  require(NMR::lib3mf_model_querywriter(model.get(), "3mf", writer.out()), model);
  ULONG64 size = 0;
  require(NMR::lib3mf_writer_getstreamsize(writer.get(), &size), writer);
  std::string bytes(size, '\0');
  require(NMR::lib3mf_writer_writetobuffer(writer.get(), reinterpret_cast<BYTE*>(bytes.data()), size),
          writer);
  return bytes;
}

}  // namespace kreisel
