// picture.hpp - the surfaces of one body that a tab is sent: its skin, and the surface at the wall's depth.
#pragma once

#include <memory>
#include <mutex>

#include "geometry/triangle_mesh.hpp"
#include "live/message.hpp"
#include "live/worker.hpp"

namespace kreisel::core::live {

/// Sends what of a picture has changed. Skins go at once, ahead of what is drawn on them; surfaces at a depth
/// take longer to make than an answer, so they follow from a thread of their own, the latest only.
class Picture {
 public:
  explicit Picture(Send send);

  /// @param mesh  mm
  void show_body(const TriangleMesh& mesh);
  /// Of the body that was shown last.
  /// @param wall    mm
  /// @param moving  a hand moves: a coarser one will do
  void show_offset(double wall, bool moving);

 private:
  Send send_;
  std::shared_ptr<const TriangleMesh> body_;  ///< that the tab has
  double wall_ = -1;                          ///< of the surface that the tab has, or will have
  bool coarse_ = false;                       ///< likewise
  std::mutex sending_;                        ///< so that no surface of the body before follows the next
  Worker drawing_{Worker::Pace::patient};     ///< the last, so that it ends first
};

}  // namespace kreisel::core::live
