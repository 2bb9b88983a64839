// module.cpp - the one file that includes OpenVDB. It calls what OpenVDB's library has, for to instantiate
// that anew takes a minute.
#include "openvdb/module.hpp"

#include <openvdb/openvdb.h>
#include <openvdb/tools/MeshToVolume.h>
#include <openvdb/tools/VolumeToMesh.h>

namespace kreisel::core {
namespace {

/// A mesh as OpenVDB's library takes it, in voxels about the middle of its box, where floats are finest.
class InVoxels {
 public:
  InVoxels(const TriangleMesh& mesh, double voxel) : voxel_(voxel) {
    const Box box = bounding_box(mesh);
    centre_ = box.centre();
    points_.reserve(mesh.vertices.size());
    for (const Vec3& v : mesh.vertices) {
      const Eigen::Vector3f p = ((v - centre_) / voxel).cast<float>();
      points_.emplace_back(p[0], p[1], p[2]);
    }
    triangles_.reserve(mesh.triangles.size());
    for (const auto& [i, j, k] : mesh.triangles) triangles_.emplace_back(i, j, k);
  }
  [[nodiscard]] const std::vector<openvdb::Vec3s>& points() const { return points_; }
  [[nodiscard]] const std::vector<openvdb::Vec3I>& triangles() const { return triangles_; }
  [[nodiscard]] Vec3 back(const openvdb::Vec3s& p) const { return voxel_ * Vec3(p[0], p[1], p[2]) + centre_; }

 private:
  double voxel_;
  Vec3 centre_;
  std::vector<openvdb::Vec3s> points_;
  std::vector<openvdb::Vec3I> triangles_;
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
  const openvdb::tools::QuadAndTriangleDataAdapter<openvdb::Vec3s, openvdb::Vec3I> adapter(
      in_voxels.points(), in_voxels.triangles());
  openvdb::util::NullInterrupter never;
  const auto field = openvdb::tools::meshToVolume<openvdb::FloatGrid>(
      never, adapter, openvdb::math::Transform(), distance > 0 ? reach : 3, distance < 0 ? reach : 3);
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
