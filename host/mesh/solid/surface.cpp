#include "mesh/solid/surface.hpp"

#include "mesh/solid/self_intersections.hpp"

namespace kreisel::core {

Surface::Surface(TriangleMesh mesh, double weld, RepairReport so_far)
    : repairs_(std::move(so_far)), mesh_(std::move(mesh)) {
  std::optional<Topology> topology;
  if (!mesh_.triangles.empty()) as_read_ = inspect(mesh_, topology.emplace(mesh_));
  if (!topology || !as_read_.spotless()) {
    topology.reset();  // a large mesh fills the memory
    mesh_ = repaired(std::move(mesh_), repairs_, weld);
    return;
  }
  // Most meshes: what has been found out holds for the mended one, too.
  shells_ = kreisel::core::shells(mesh_, *topology);
  if (turn_outward(mesh_, *shells_, repairs_)) {
    shells_.reset();
  } else {
    report_ = as_read_;
  }
}

const MeshReport& Surface::report() {
  if (!report_) report_ = inspect(mesh_);
  return *report_;
}

const Surface::Pairs& Surface::crossings() {
  if (!crossings_) crossings_ = self_intersections(mesh_);
  return *crossings_;
}

const std::vector<Shell>& Surface::shells() {
  if (!shells_) shells_ = kreisel::core::shells(mesh_);
  return *shells_;
}

const Surface::Nesting& Surface::enclosing() {
  if (!enclosing_) enclosing_ = enclosing_shells(mesh_, shells());
  return *enclosing_;
}

}  // namespace kreisel::core
