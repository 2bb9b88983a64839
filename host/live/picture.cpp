#include "live/picture.hpp"

#include <utility>

#include "live/surfaces.hpp"
#include "offset/offset_surface.hpp"

namespace kreisel::core::live {
namespace {

constexpr double fine_voxels = 96, coarse_voxels = 40;  // along the longest side

}  // namespace

Picture::Picture(Send send) : send_(std::move(send)) {}

void Picture::show_body(const TriangleMesh& mesh) {
  if (body_ && body_->vertices == mesh.vertices && body_->triangles == mesh.triangles) return;
  body_ = std::make_shared<const TriangleMesh>(mesh);
  wall_ = -1;
  const std::lock_guard lock(sending_);
  drawing_.stop();
  send_(surface({{"name", "body"}}, mesh));
}

void Picture::show_offset(double wall, bool moving) {
  if (wall == wall_ && (moving || !coarse_)) return;
  wall_ = wall;
  coarse_ = moving;
  drawing_.put("offset", [this, wall, moving, body = body_](const Worker::Turn& turn) {
    const double longest = bounding_box(*body).extent().maxCoeff();
    const TriangleMesh offset =
        offset_surface(*body, -wall, longest / (moving ? coarse_voxels : fine_voxels));
    const std::lock_guard lock(sending_);
    if (turn.closed.stop_requested()) return;
    send_(surface({{"name", "offset"}, {"wall_mm", wall}, {"coarse", moving}}, offset));
  });
}

}  // namespace kreisel::core::live
