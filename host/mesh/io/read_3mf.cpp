#include "mesh/io/read_3mf.hpp"

#include <Common/NMR_ErrorConst.h>

#include <Eigen/Geometry>

#include "mesh/io/encode.hpp"
#include "mesh/io/lib3mf_handle.hpp"

namespace kreisel::core {
namespace {

using Transform = Eigen::Transform<double, 3, Eigen::AffineCompact>;

/// More than any printer takes; components that multiply each other reach any number from a small file.
constexpr std::size_t most_triangles = 100'000'000;

double millimetres(DWORD unit, const std::string& name) {
  switch (unit) {
    case NMR::MODELUNIT_MICROMETER:
      return 1e-3;
    case NMR::MODELUNIT_MILLIMETER:
      return 1;
    case NMR::MODELUNIT_CENTIMETER:
      return 10;
    case NMR::MODELUNIT_INCH:
      return 25.4;
    case NMR::MODELUNIT_FOOT:
      return 304.8;
    case NMR::MODELUNIT_METER:
      return 1000;
    default:
      throw InputError(fmt::format("{}: 3MF unit number {}, expected micron to meter", name, unit));
  }
}

Transform to_eigen(const NMR::MODELTRANSFORM& t) {
  Transform result;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j) result.matrix()(i, j) = t.m_fFields[i][j];
  return result;
}

/// Attributes that slicers add, metadata, identifiers and thumbnails.
bool without_bearing(DWORD warning) {
  constexpr DWORD codes[] = {NMR_ERROR_NAMESPACE_INVALID_ATTRIBUTE,
                             NMR_ERROR_INVALIDMETADATACOUNT,
                             NMR_ERROR_DUPLICATEMETADATA,
                             NMR_ERROR_INVALIDMETADATA,
                             NMR_ERROR_METADATA_COULDNOTGETNAMESPACE,
                             NMR_ERROR_UNKNOWNMETADATA,
                             NMR_ERROR_DUPLICATEUUID,
                             NMR_ERROR_UUID_NOT_UNIQUE,
                             NMR_ERROR_MISSINGUUID,
                             NMR_ERROR_OPCCOULDNOTGETTHUMBNAILSTREAM,
                             NMR_ERROR_DUPLICATEOBJECTTHUMBNAIL,
                             NMR_ERROR_DUPLICATETHUMBNAIL};
  return std::find(std::begin(codes), std::end(codes), warning) != std::end(codes);
}

class Reader {
 public:
  explicit Reader(const MeshFile& file) : name_(file.name) {
    require(NMR::lib3mf_createmodel(model_.out()), nullptr);
    Lib3mfHandle reader;
    require(NMR::lib3mf_model_queryreader(model_.get(), "3mf", reader.out()), model_.get());
    // The library's signature lacks a const.
    auto* bytes = reinterpret_cast<BYTE*>(const_cast<char*>(file.bytes.data()));
    require(NMR::lib3mf_reader_readfrombuffer(reader.get(), bytes, file.bytes.size()), reader.get());
    refuse_warnings(reader);
  }

  /// A mesh for each build item.
  std::vector<TriangleMesh> meshes() {
    std::vector<TriangleMesh> all;
    DWORD unit = 0;
    require(NMR::lib3mf_model_getunit(model_.get(), &unit), model_.get());
    const Transform to_millimetres(Eigen::UniformScaling<double>(millimetres(unit, name_)));
    Lib3mfHandle items;
    require(NMR::lib3mf_model_getbuilditems(model_.get(), items.out()), model_.get());
    for (BOOL more = 0;;) {
      require(NMR::lib3mf_builditemiterator_movenext(items.get(), &more), items.get());
      if (!more) return all;
      Lib3mfHandle item, object;
      require(NMR::lib3mf_builditemiterator_getcurrent(items.get(), item.out()), items.get());
      require(NMR::lib3mf_builditem_getobjectresource(item.get(), object.out()), item.get());
      BOOL has = 0;
      NMR::MODELTRANSFORM t{};
      require(NMR::lib3mf_builditem_hasobjecttransform(item.get(), &has), item.get());
      if (has) require(NMR::lib3mf_builditem_getobjecttransform(item.get(), &t), item.get());
      mesh_ = {};
      add_object(object, has ? to_millimetres * to_eigen(t) : to_millimetres);
      all.push_back(std::move(mesh_));
    }
  }

 private:
  void require(LIB3MFRESULT result, NMR::PLib3MFBase* object) const {
    require_3mf(result, object, name_, "a whole 3MF package");
  }

  /// The library goes on after most faults, with a default or without the part; only what has no bearing on
  /// shape is let through.
  void refuse_warnings(const Lib3mfHandle& reader) const {
    DWORD count = 0;
    require(NMR::lib3mf_reader_getwarningcount(reader.get(), &count), reader.get());
    for (DWORD i = 0; i < count; ++i) {
      DWORD code = 0;
      char text[512] = {};
      ULONG needed = 0;
      require(NMR::lib3mf_reader_getwarningutf8(reader.get(), i, &code, text, sizeof text, &needed),
              reader.get());
      if (!without_bearing(code))
        throw InputError(
            fmt::format("{}: 3MF: {} (error {:#x}), expected a valid package", name_, text, code));
    }
  }

  void add_object(const Lib3mfHandle& object, const Transform& transform) {
    DWORD type = 0;
    require(NMR::lib3mf_object_gettype(object.get(), &type), object.get());
    if (type == NMR::MODELOBJECTTYPE_SUPPORT || type == NMR::MODELOBJECTTYPE_SOLIDSUPPORT) return;
    BOOL is_mesh = 0;
    require(NMR::lib3mf_object_ismeshobject(object.get(), &is_mesh), object.get());
    is_mesh ? add_mesh(object, transform) : add_components(object, transform);
  }

  void add_components(const Lib3mfHandle& object, const Transform& transform) {
    DWORD count = 0;
    require(NMR::lib3mf_componentsobject_getcomponentcount(object.get(), &count), object.get());
    for (DWORD i = 0; i < count; ++i) {
      Lib3mfHandle component, part;
      require(NMR::lib3mf_componentsobject_getcomponent(object.get(), i, component.out()), object.get());
      require(NMR::lib3mf_component_getobjectresource(component.get(), part.out()), component.get());
      BOOL has = 0;
      NMR::MODELTRANSFORM t{};
      require(NMR::lib3mf_component_hastransform(component.get(), &has), component.get());
      if (has) require(NMR::lib3mf_component_gettransform(component.get(), &t), component.get());
      add_object(part, has ? transform * to_eigen(t) : transform);
    }
  }

  void add_mesh(const Lib3mfHandle& object, const Transform& transform) {
    DWORD vertices = 0, triangles = 0;
    require(NMR::lib3mf_meshobject_getvertexcount(object.get(), &vertices), object.get());
    require(NMR::lib3mf_meshobject_gettrianglecount(object.get(), &triangles), object.get());
    if ((read_ += triangles) > most_triangles)
      throw InputError(fmt::format("{}: 3MF: components add up to more than {} triangles, expected fewer",
                                   name_, most_triangles));
    std::vector<NMR::MODELMESHVERTEX> points(vertices);
    std::vector<NMR::MODELMESHTRIANGLE> faces(triangles);
    if (vertices)
      require(NMR::lib3mf_meshobject_getvertices(object.get(), points.data(), vertices, nullptr),
              object.get());
    if (triangles)
      require(NMR::lib3mf_meshobject_gettriangleindices(object.get(), faces.data(), triangles, nullptr),
              object.get());
    const auto offset = std::uint32_t(mesh_.vertices.size());
    for (const NMR::MODELMESHVERTEX& v : points) {
      const Vec3 p = transform * Vec3(v.m_fPosition[0], v.m_fPosition[1], v.m_fPosition[2]);
      if (!p.allFinite())
        throw InputError(fmt::format("{}: vertex {} is ({}, {}, {}), expected finite coordinates", name_,
                                     mesh_.vertices.size() - offset + 1, p.x(), p.y(), p.z()));
      mesh_.vertices.push_back(p);
    }
    const bool mirrors = transform.linear().determinant() < 0;
    for (const NMR::MODELMESHTRIANGLE& t : faces) {
      for (const DWORD index : t.m_nIndices)
        if (index >= vertices)
          throw InputError(
              fmt::format("{}: vertex index {}, expected 0 to {}", name_, index, std::int64_t(vertices) - 1));
      const std::uint32_t a = offset + t.m_nIndices[0], b = offset + t.m_nIndices[1],
                          c = offset + t.m_nIndices[2];
      mesh_.triangles.push_back(mirrors ? Triangle{a, c, b} : Triangle{a, b, c});
    }
  }

  std::string name_;
  Lib3mfHandle model_;
  TriangleMesh mesh_;     ///< of the build item under way
  std::size_t read_ = 0;  ///< triangles of all of them
};

}  // namespace

TriangleMesh read_3mf(const MeshFile& file) { return joined(read_3mf_objects(file), file.name); }

std::vector<TriangleMesh> read_3mf_objects(const MeshFile& file) {
  if (!file.bytes.starts_with("PK"))
    throw InputError(fmt::format("{}: no ZIP archive, expected a 3MF package", file.name));
  return Reader(file).meshes();
}

}  // namespace kreisel::core
