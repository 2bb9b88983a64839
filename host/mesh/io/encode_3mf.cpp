#include <cmath>
#include <optional>

#include "geometry/single_precision.hpp"
#include "mesh/io/encode.hpp"
#include "mesh/io/lib3mf_handle.hpp"

namespace kreisel::core {
namespace {

/// The library writes coordinates with fixed digits and refuses larger ones when it reads.
constexpr double largest_coordinate = 1e9;

void require(LIB3MFRESULT result, const Lib3mfHandle& object, const std::string& name) {
  require_3mf(result, object.get(), name, "a mesh that 3MF can hold");
}

/// The library writes transforms with six significant digits.
double in_six_digits(double x) {
  const double unit = std::pow(10, std::floor(std::log10(std::abs(x))) - 5);
  return x == 0 ? 0 : std::round(x / unit) * unit;
}

/// To a place from about it; nothing where they are the same.
std::optional<NMR::MODELTRANSFORM> transform_to(const Vec3& place) {
  if (place.isZero(0)) return std::nullopt;
  NMR::MODELTRANSFORM transform{};
  for (int k = 0; k < 3; ++k) {
    transform.m_fFields[k][k] = 1;
    transform.m_fFields[k][3] = static_cast<float>(place[k]);
  }
  return transform;
}

void add_object(const Lib3mfHandle& model, const MeshObject& object, const TriangleMesh& mesh,
                const Vec3& place, const std::string& name) {
  std::vector<NMR::MODELMESHVERTEX> vertices;
  std::vector<NMR::MODELMESHTRIANGLE> triangles;
  for (const Vec3& v : mesh.vertices) {
    const Eigen::Vector3f at = (v - place).cast<float>();
    vertices.push_back({{at.x(), at.y(), at.z()}});
  }
  for (const auto& [a, b, c] : mesh.triangles) triangles.push_back({{a, b, c}});
  Lib3mfHandle added, item;
  require(NMR::lib3mf_model_addmeshobject(model.get(), added.out()), model, name);
  if (!object.name.empty())
    require(NMR::lib3mf_object_setnameutf8(added.get(), object.name.c_str()), added, name);
  require(NMR::lib3mf_meshobject_setgeometry(added.get(), vertices.data(), DWORD(vertices.size()),
                                             triangles.data(), DWORD(triangles.size())),
          added, name);
  std::optional<NMR::MODELTRANSFORM> transform = transform_to(place);
  require(
      NMR::lib3mf_model_addbuilditem(model.get(), added.get(), transform ? &*transform : nullptr, item.out()),
      model, name);
}

}  // namespace

std::string encode_3mf(const std::vector<TriangleMesh>& parts, const std::string& name) {
  return encode_3mf_objects({{"", parts}}, name);
}

std::string encode_3mf_objects(const std::vector<MeshObject>& objects, const std::string& name) {
  Lib3mfHandle model, writer;
  require(NMR::lib3mf_createmodel(model.out()), model, name);
  require(NMR::lib3mf_model_setunit(model.get(), NMR::MODELUNIT_MILLIMETER), model, name);
  std::vector<TriangleMesh> meshes;
  Box box;
  for (const MeshObject& object : objects) {
    const TriangleMesh& mesh = meshes.emplace_back(joined(object.parts, name));
    require_coordinates_within(largest_coordinate, "coordinates within 1e9 mm in a 3MF file", mesh, name);
    for (const Vec3& v : mesh.vertices) box.add(v);
  }
  const Vec3 place = place_of(box).unaryExpr(&in_six_digits);
  for (std::size_t i = 0; i < objects.size(); ++i) add_object(model, objects[i], meshes[i], place, name);
  require(NMR::lib3mf_model_querywriter(model.get(), "3mf", writer.out()), model, name);
  ULONG64 size = 0;
  require(NMR::lib3mf_writer_getstreamsize(writer.get(), &size), writer, name);
  std::string bytes(size, '\0');
  require(NMR::lib3mf_writer_writetobuffer(writer.get(), reinterpret_cast<BYTE*>(bytes.data()), size), writer,
          name);
  return bytes;
}

}  // namespace kreisel::core
