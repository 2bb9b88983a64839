// levels.hpp - how high beads are where the slicer does not say: from one level of the nozzle to the next.
#pragma once

#include <cmath>
#include <optional>

namespace kreisel::core {

class Levels {
 public:
  static constexpr double same = 1e-4;  ///< mm; what is nearer is one level

  /// Something is laid at this height above the bed, mm. @return  whether that is another level than the last
  bool go_to(double z) {
    if (level_ && std::abs(z - *level_) < same) return false;
    if (!level_ || z < first_) first_ = z;  // lower than what a machine primes in the air
    if (!level_ || z <= first_ + same)      // on the bed, also of the next object
      height_ = z > same ? z : usual;
    else if (z > *level_)
      height_ = z - *level_;
    level_ = z;
    return true;
  }
  /// Of what is laid there, mm.
  [[nodiscard]] double height() const { return height_; }

 private:
  static constexpr double usual = 0.2;  // where nothing tells it
  std::optional<double> level_;
  double first_ = 0, height_ = usual;
};

}  // namespace kreisel::core
