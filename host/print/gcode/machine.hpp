// machine.hpp - the printer as far as G-code moves it: where the nozzle is, and how much filament is out.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "kreisel/mesh.hpp"

namespace kreisel::core {

using kreisel::Vec3;

/// What a move lays down.
struct Laid {
  Vec3 from, to;        ///< mm, of the bed
  double filament = 0;  ///< that comes out for good, mm; in volumetric mode mm^3
  bool stands = true;   ///< the nozzle does not leave its place in the plane
  double angle = 0;     ///< of an arc, counter-clockwise, radians; 0: straight
  Vec3 centre = Vec3::Zero();
};

/// Follows positions, units, absolute and relative ones, retraction, tools.
///
/// E is relative where M83 or G91 says so: G90 does not take back M83, as firmwares that differ in this are
/// told by their slicers. What was retracted by one tool is first paid back by the same. Retraction by G10
/// and G11 moves no E.
class Machine {
 public:
  static constexpr int most_tools = 64;

  /// One command without its comment. @return  nothing laid down: filament is 0
  /// @throws InputError  what is wrong with it, without file and line
  Laid run(std::string_view command);

  [[nodiscard]] int tool() const { return tool_; }
  /// E is in mm^3, by M200.
  [[nodiscard]] bool volumetric() const { return volumetric_; }

 private:
  struct Words;
  Laid move(int code, const Words& words);
  void turn(Laid& laid, int code, const Words& words) const;
  void set_position(const Words& words);
  double extruded(double value);

  Vec3 at_ = Vec3::Zero(), shift_ = Vec3::Zero();  ///< at_ = what G-code calls it + shift_
  double e_ = 0, unit_ = 1;
  bool relative_ = false, e_relative_ = false, flat_ = true, volumetric_ = false;
  int tool_ = 0;
  std::vector<double> retracted_ = {0};  ///< by each tool
};

}  // namespace kreisel::core
