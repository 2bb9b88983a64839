// module.cpp - the one file that includes OpenVDB: it takes a minute to compile.
#include "openvdb/module.hpp"

#include <openvdb/openvdb.h>
#include <openvdb/tools/MeshToVolume.h>
#include <openvdb/tools/VolumeToMesh.h>

namespace kreisel::core {
namespace {

/// A mesh as OpenVDB asks for it, in voxels about the middle of its box, where floats are finest.
class InVoxels {
 public:
  InVoxels(const TriangleMesh& mesh, double voxel) : mesh_(mesh), voxel_(voxel) {
    const Box box = bounding_box(mesh);
    centre_ = box.centre();
  }
  [[nodiscard]] std::size_t polygonCount() const { return mesh_.triangles.size(); }
  [[nodiscard]] std::size_t pointCount() const { return mesh_.vertices.size(); }
  [[nodiscard]] std::size_t vertexCount(std::size_t) const { return 3; }
  void getIndexSpacePoint(std::size_t triangle, std::size_t corner, openvdb::Vec3d& point) const {
    const Vec3 p = (mesh_.vertices[mesh_.triangles[triangle][corner]] - centre_) / voxel_;
    point = {p[0], p[1], p[2]};
  }
  [[nodiscard]] Vec3 back(const openvdb::Vec3s& p) const { return voxel_ * Vec3(p[0], p[1], p[2]) + centre_; }

 private:
  const TriangleMesh& mesh_;
  double voxel_;
  Vec3 centre_;
};

}  // namespace
}  // namespace kreisel::core

extern "C" void kreisel_offset(const kreisel::core::TriangleMesh& mesh, double distance, double voxel,
                               kreisel::core::TriangleMesh& result) {
  openvdb::initialize();
  const kreisel::core::InVoxels in_voxels(mesh, voxel);
  // Three voxels beyond the surface asked for, and beyond the mesh: what interpolation looks at, and to
  // spare.
  const auto reach = static_cast<float>(std::abs(distance) / voxel) + 3;
  const auto field = openvdb::tools::meshToVolume<openvdb::FloatGrid>(
      in_voxels, openvdb::math::Transform(), distance > 0 ? reach : 3, distance < 0 ? reach : 3);
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec4I> quads;
  openvdb::tools::volumeToMesh(*field, points, quads, distance / voxel);
  for (const openvdb::Vec3s& p : points) result.vertices.push_back(in_voxels.back(p));
  const auto& at = result.vertices;
  for (const openvdb::Vec4I& q : quads) {  // clockwise seen from outside
    const bool first = (at[q[0]] - at[q[2]]).squaredNorm() < (at[q[1]] - at[q[3]]).squaredNorm();
    if (first) {
      result.triangles.push_back({q[0], q[2], q[1]});
      result.triangles.push_back({q[0], q[3], q[2]});
    } else {
      result.triangles.push_back({q[0], q[3], q[1]});
      result.triangles.push_back({q[1], q[3], q[2]});
    }
  }
}
