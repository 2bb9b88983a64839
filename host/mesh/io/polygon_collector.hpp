// polygon_collector.hpp - takes polygons from OpenMesh's readers as they come.
#pragma once

#include <OpenMesh/Core/IO/importer/BaseImporter.hh>
#include <vector>

namespace kreisel::core {

/// Stands where OpenMesh expects a half-edge mesh. That mesh refuses faces it cannot connect and so drops or
/// duplicates parts of broken input; here every polygon stays as it was read. Attributes are ignored, and so
/// are coordinates: OpenMesh's readers know them in float only.
class PolygonCollector final : public OpenMesh::IO::BaseImporter {
 public:
  using Polygon = VHandles;

  [[nodiscard]] const std::vector<Polygon>& polygons() const { return polygons_; }

  OpenMesh::VertexHandle add_vertex() override { return OpenMesh::VertexHandle(int(vertices_++)); }
  OpenMesh::VertexHandle add_vertex(const OpenMesh::Vec3f&) override { return add_vertex(); }
  OpenMesh::VertexHandle add_vertex(const OpenMesh::Vec3d&) override { return add_vertex(); }
  OpenMesh::FaceHandle add_face(const VHandles& corners) override {
    polygons_.push_back(corners);
    return OpenMesh::FaceHandle(int(polygons_.size()) - 1);
  }
  std::size_t n_vertices() const override { return vertices_; }
  std::size_t n_faces() const override { return polygons_.size(); }
  std::size_t n_edges() const override { return 0; }

  // The rest of the interface, in which nothing is of interest.
  OpenMesh::HalfedgeHandle add_edge(OpenMesh::VertexHandle, OpenMesh::VertexHandle) override {
    return OpenMesh::HalfedgeHandle();
  }
  OpenMesh::FaceHandle add_face(OpenMesh::HalfedgeHandle) override { return OpenMesh::FaceHandle(); }
  void add_face_texcoords(OpenMesh::FaceHandle, OpenMesh::VertexHandle,
                          const std::vector<OpenMesh::Vec2f>&) override {}
  void add_face_texcoords(OpenMesh::FaceHandle, OpenMesh::VertexHandle,
                          const std::vector<OpenMesh::Vec3f>&) override {}
  void set_face_texindex(OpenMesh::FaceHandle, int) override {}
  void set_point(OpenMesh::VertexHandle, const OpenMesh::Vec3f&) override {}
  void set_halfedge(OpenMesh::VertexHandle, OpenMesh::HalfedgeHandle) override {}
  void set_next(OpenMesh::HalfedgeHandle, OpenMesh::HalfedgeHandle) override {}
  void set_face(OpenMesh::HalfedgeHandle, OpenMesh::FaceHandle) override {}
  void request_face_texcoords2D() override {}
  void add_texture_information(int, std::string) override {}
  void set_texcoord(OpenMesh::VertexHandle, const OpenMesh::Vec2f&) override {}
  void set_texcoord(OpenMesh::VertexHandle, const OpenMesh::Vec3f&) override {}
  void set_texcoord(OpenMesh::HalfedgeHandle, const OpenMesh::Vec2f&) override {}
  void set_texcoord(OpenMesh::HalfedgeHandle, const OpenMesh::Vec3f&) override {}
  void set_normal(OpenMesh::VertexHandle, const OpenMesh::Vec3f&) override {}
  void set_normal(OpenMesh::VertexHandle, const OpenMesh::Vec3d&) override {}
  void set_normal(OpenMesh::FaceHandle, const OpenMesh::Vec3f&) override {}
  void set_normal(OpenMesh::FaceHandle, const OpenMesh::Vec3d&) override {}
  void set_color(OpenMesh::VertexHandle, const OpenMesh::Vec3uc&) override {}
  void set_color(OpenMesh::VertexHandle, const OpenMesh::Vec4uc&) override {}
  void set_color(OpenMesh::VertexHandle, const OpenMesh::Vec3f&) override {}
  void set_color(OpenMesh::VertexHandle, const OpenMesh::Vec4f&) override {}
  void set_color(OpenMesh::EdgeHandle, const OpenMesh::Vec3uc&) override {}
  void set_color(OpenMesh::EdgeHandle, const OpenMesh::Vec4uc&) override {}
  void set_color(OpenMesh::EdgeHandle, const OpenMesh::Vec3f&) override {}
  void set_color(OpenMesh::EdgeHandle, const OpenMesh::Vec4f&) override {}
  void set_color(OpenMesh::FaceHandle, const OpenMesh::Vec3uc&) override {}
  void set_color(OpenMesh::FaceHandle, const OpenMesh::Vec4uc&) override {}
  void set_color(OpenMesh::FaceHandle, const OpenMesh::Vec3f&) override {}
  void set_color(OpenMesh::FaceHandle, const OpenMesh::Vec4f&) override {}
  void set_status(OpenMesh::VertexHandle, const OpenMesh::Attributes::StatusInfo&) override {}
  void set_status(OpenMesh::HalfedgeHandle, const OpenMesh::Attributes::StatusInfo&) override {}
  void set_status(OpenMesh::EdgeHandle, const OpenMesh::Attributes::StatusInfo&) override {}
  void set_status(OpenMesh::FaceHandle, const OpenMesh::Attributes::StatusInfo&) override {}

 private:
  std::size_t vertices_ = 0;
  std::vector<Polygon> polygons_;
};

}  // namespace kreisel::core
