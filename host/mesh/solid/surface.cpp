#include "mesh/solid/surface.hpp"

#include "mesh/solid/self_intersections.hpp"

namespace kreisel::core {

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
