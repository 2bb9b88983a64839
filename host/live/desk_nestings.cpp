// What the requests of a desk about nesting do. [docs/live.md]
#include <utility>

#include "error.hpp"
#include "geometry/moved.hpp"
#include "live/desk.hpp"
#include "live/question.hpp"
#include "live/surfaces.hpp"

namespace kreisel::core::live {
namespace {

/// In millimetres.
TriangleMesh mesh_of(const Source& source) {
  const double longest = bounding_box(source.mesh).extent().maxCoeff();
  const double scale = source.size ? *source.size / longest : source.millimetres;
  TriangleMesh mesh = source.mesh;
  for (Vec3& v : mesh.vertices) v *= scale;
  return mesh;
}

NestConfig nesting_asked(const nlohmann::json& said, std::string_view kind) {
  NestConfig config = usual_nesting(kind);
  config.outer = "body";  // the one that is open
  set_fields(config, said, nest_fields(kind));
  require_valid(config);
  return config;
}

}  // namespace

/// Puts a shape into the body that is open: itself, or one of the known.
void Desk::into(Request request) {
  const nlohmann::json id = request.id();
  const std::string inner = request.said.contains("inner") ? request.text("inner") : "";
  put(answering_, "into", id, [this, id, inner](const Worker::Turn&) {
    std::shared_ptr<const Opened> opened;
    {
      const std::lock_guard lock(mutex_);
      opened = opened_;
    }
    if (!opened) throw InputError("a nesting without a body; expected \"open\" first");
    const TriangleMesh outside = mesh_of(*opened->solid);
    const TriangleMesh inside = inner.empty() ? outside : mesh_of(*open_named(*setup_, inner, {}).mesh);
    auto made = std::make_shared<Nestings>(outside, inside, send_);
    {
      const std::lock_guard lock(mutex_);
      nestings_ = std::move(made);
    }
    send_(surface({{"name", "body"}}, outside));
    send_(surface({{"name", "inner"}}, inside));
    send_(message({{"do", "into"}, {"id", id}}));
  });
}

std::shared_ptr<Nestings> Desk::nestings() {
  const std::lock_guard lock(mutex_);
  if (!nestings_) throw InputError("a nesting without shapes; expected \"into\" first");
  return nestings_;
}

void Desk::nest(Request request) {
  const NestConfig config = nesting_asked(request.fields("question"), "scale");
  put(answering_, "nest", request.id(),
      [this, id = request.id(), config](const Worker::Turn&) { nestings()->ask(id, config); });
}

void Desk::optimise(Request request) {
  const NestConfig config = nesting_asked(request.fields("question"), "swarm");
  working_.give_up({"optimise"});
  put(working_, "optimise", request.id(), [this, id = request.id(), config](const Worker::Turn& turn) {
    nestings()->optimise(id, config, turn.closed);
  });
}

}  // namespace kreisel::core::live
