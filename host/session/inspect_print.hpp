// inspect_print.hpp - what is to be known of a print by its G-code.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "body/body.hpp"
#include "control.hpp"
#include "kreisel/verdict.hpp"
#include "print/gcode/read.hpp"
#include "settings/settings.hpp"

namespace kreisel::core {

/// What is printed as one body. Coordinates of the bed: mm, g.
struct PrintedBody {
  std::string label;  ///< of the object; empty: all of the part
  double volume = 0, mass = 0;
  Vec3 centre;                                       ///< of mass
  Eigen::Matrix3d inertia;                           ///< about the centre of mass, g mm^2
  Vec3 principal;                                    ///< its moments, ascending
  Eigen::Matrix3d axes;                              ///< columns, in that order
  std::map<std::string, kreisel::Verdict> verdicts;  ///< what problems say of it; of one body alone
};

struct PrintInspection {
  Print print;
  PrintedBody part;                  ///< all objects as one rigid body
  std::vector<PrintedBody> objects;  ///< where there are several: each as a body of its own
};

/// What shall be judged.
struct PrintQuestion {
  std::string problem;                ///< empty: all that can judge a solid by its moments
  SettingTexts settings;              ///< of that problem
  std::optional<Vec3> axis, contact;  ///< of the bed; default +z, through the middle of the lowest layer
};

/// @throws InputError   as read_gcode(); a problem that needs a surface, or that there is not
/// @throws Interrupted
[[nodiscard]] PrintInspection inspect_print(const std::filesystem::path& file, const FilamentSpec& filament,
                                            const PrintQuestion& question, const Control& control = {});

}  // namespace kreisel::core
