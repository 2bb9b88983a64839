// gcode_test.cpp - G-code against closed forms, each dialect, and what is no G-code.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "print/gcode/beads.hpp"
#include "print/gcode/read.hpp"
#include "refusal.hpp"

namespace kreisel::core {
namespace THIS_FILE {

constexpr double pi = std::numbers::pi;
const double area = pi / 4 * 1.75 * 1.75;  // of the usual filament

/// Both within some round-offs of the largest of their kind.
void expect_equal(const Moments& got, const Moments& want, double relative = 1e-12) {
  for (int k = 0; k < 10; ++k) {
    const double scale = k == S1   ? want[S1]
                         : k <= SZ ? want.segment<3>(SX).cwiseAbs().maxCoeff()
                                   : want.tail<6>().cwiseAbs().maxCoeff();
    EXPECT_NEAR(got[k], want[k], relative * scale) << moment_names[std::size_t(k)];
  }
}

Print read(const std::string& text, const FilamentSpec& spec = {}) {
  GcodeReader reader("part.gcode");
  reader.feed(text);
  return reader.finish(spec);
}

/// At density 1000: grams are then mm^3.
Moments part_of(const std::string& text) { return read(text, {std::nullopt, 1e3}).part_mass(); }

TEST(Beads, StraightOnesAreBoxes) {
  // 30 mm long, 0.2 high, and as wide as the filament that goes into it says.
  const double filament = 1.5, width = filament * area / (30 * 0.2);
  Beads along, turned;
  along.add_line({10, 20, 0.5}, {40, 20, 0.5}, filament, 0.2);
  expect_equal(along.moments(area), box_moments({25, 20, 0.4}, {30, width, 0.2}));
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vec3::UnitZ()).toRotationMatrix();
  turned.add_line(turn * Vec3(10, 20, 0.5), turn * Vec3(40, 20, 0.5), filament, 0.2);
  expect_equal(turned.moments(area),
               transformed(box_moments({25, 20, 0.4}, {30, width, 0.2}), turn, Vec3::Zero()));
}

TEST(Beads, ThatClimbAreShearedBoxes) {
  const double filament = 1.5, width = filament * area / (5 * 0.2);
  Beads beads;
  beads.add_line({1, 2, 3}, {4, 6, 3.1}, filament, 0.2);
  Eigen::Matrix3d spans;  // one a column; of the same volume as the box, whose edges are 1
  spans << 3, -0.8 * width, 0, 4, 0.6 * width, 0, 0.1, 0, 0.2;
  const double volume = spans.determinant();
  const Moments box = box_moments(Vec3::Zero(), Vec3::Ones());
  const Moments want = volume * transformed(box, spans, {2.5, 4, 2.95});
  expect_equal(beads.moments(area), want);
}

/// Of the ring between two circles.
Moments ring(const Vec3& centre, double inner, double outer, double height) {
  const double volume = pi * (outer * outer - inner * inner) * height;
  Moments s = Moments::Zero();
  s[S1] = volume;
  s[SXX] = s[SYY] = pi / 4 * (std::pow(outer, 4) - std::pow(inner, 4)) * height;
  s[SZZ] = volume * height * height / 12;
  return transformed(s, Eigen::Matrix3d::Identity(), centre);
}

TEST(Beads, ArcsMakeARing) {
  const Vec3 centre(50, 60, 0);
  const double r = 8, filament = 4, width = filament * area / (2 * pi * r * 0.3);
  for (const int arcs : {1, 2, 5}) {
    Beads beads;
    for (int k = 0; k < arcs; ++k) {
      const auto at = [&](int i) {
        const double a = 0.3 + 2 * pi * i / arcs;
        return Vec3(50 + r * std::cos(a), 60 + r * std::sin(a), 1.3);
      };
      beads.add_arc(at(k), at(k + 1), centre, 2 * pi / arcs, filament / arcs, 0.3);
    }
    expect_equal(beads.moments(area), ring({50, 60, 1.15}, r - width / 2, r + width / 2, 0.3));
  }
}

TEST(Beads, AnArcIsTheLimitOfItsChords) {
  // Clockwise and climbing, of a width that shows. What chords leave out falls with the square of their
  // number.
  const Vec3 centre(3, -2, 0);
  const double r = 5, angle = -2.1, height = 0.4, filament = 3, from = 0.4, thin = 1e-6;
  const auto at = [&](double t) {
    return Vec3(3 + r * std::cos(from + angle * t), -2 + r * std::sin(from + angle * t), 2 + 0.7 * t);
  };
  Beads arc;
  arc.add_arc(at(0), at(1), centre, angle, filament, height);
  const auto miss = [&](int chords) {
    Beads line;
    for (int k = 0; k < chords; ++k)
      line.add_line(at(double(k) / chords), at(double(k + 1) / chords), filament / chords, height);
    return (line.moments(thin) - arc.moments(thin)).cwiseAbs().maxCoeff();
  };
  EXPECT_NEAR(miss(100) / miss(200), 4, 0.05);
  EXPECT_LT(miss(2000), 1e-6 * arc.moments(thin).cwiseAbs().maxCoeff());
}

TEST(Beads, AnArcThatClimbsIsTheLimitOfLevelOnes) {
  const Vec3 centre(3, -2, 0);
  const double r = 5, angle = 4.1, height = 0.4, filament = 3, from = 0.4, rise = 0.7;
  const auto at = [&](double t, double z) {
    return Vec3(3 + r * std::cos(from + angle * t), -2 + r * std::sin(from + angle * t), 2 + rise * z);
  };
  Beads arc;
  arc.add_arc(at(0, 0), at(1, 1), centre, angle, filament, height);
  const auto miss = [&](int steps) {
    Beads all;
    for (int k = 0; k < steps; ++k) {
      const double z = (k + 0.5) / steps;
      all.add_arc(at(double(k) / steps, z), at(double(k + 1) / steps, z), centre, angle / steps,
                  filament / steps, height);
    }
    return (all.moments(area) - arc.moments(area)).cwiseAbs().maxCoeff();
  };
  EXPECT_NEAR(miss(100) / miss(200), 4, 0.05);
  EXPECT_LT(miss(2000), 1e-6 * arc.moments(area).cwiseAbs().maxCoeff());
}

/// A box of parallel beads that fill it, without the lines that say what type it is.
std::string box_of_beads(double e_factor = 1) {
  std::string text;
  const double width = 0.5, height = 0.25, length = 12;
  const double e = e_factor * width * height * length / area;
  for (int layer = 1; layer <= 8; ++layer)
    for (int line = 0; line < 20; ++line) {
      const double y = 30 + (line + 0.5) * width;
      text += fmt::format("G0 X20 Y{} Z{}\nG1 X{} E{:.15f}\n", y, layer * height, 20 + length, e);
    }
  return text;
}

TEST(Gcode, ABoxThatIsFilledHasTheMomentsOfTheBox) {
  expect_equal(part_of("M83\n" + box_of_beads()), box_moments({26, 35, 1}, {12, 10, 2}));
}

TEST(Gcode, BlocksOfAnySizeGiveTheSame) {
  const std::string text = "M83\n" + box_of_beads();
  const Moments whole = part_of(text);
  for (const std::size_t size : {1, 7, 100}) {
    GcodeReader reader("part.gcode");
    for (std::size_t at = 0; at < text.size(); at += size)
      reader.feed(std::string_view(text).substr(at, size));
    EXPECT_EQ(reader.finish({std::nullopt, 1e3}).part_mass(), whole);
  }
}

/// The same L of two beads in other words, 2 mm of filament: 10 mm along x, 10 mm along y.
class SameMoves : public ::testing::TestWithParam<const char*> {};

TEST_P(SameMoves, GiveTheSameMoments) {
  const double width = area / (10 * 0.2);
  expect_equal(part_of(GetParam()),
               box_moments({15, 10, 0.1}, {10, width, 0.2}) + box_moments({20, 15, 0.1}, {width, 10, 0.2}));
}

INSTANTIATE_TEST_SUITE_P(
    InOtherWords, SameMoves,
    ::testing::Values(
        "G1 X10 Y10 Z.2\nG1 X20 E1\nG1 Y20 E2\n",                                  // absolute E
        "M83\nG1 X10 Y10 Z.2\nG1 X20 E1\nG1 Y20 E1\n",                             // relative E
        "M83\nG90\nG1 X10 Y10 Z.2\nG1 X20 E1\nG1 Y20 E1\n",                        // G90 leaves E as it is
        "M83\r\nG1 X10 Y10 Z.2\r\nG1 X20 E1\r\nG1 Y20 E1\r\n",                     // lines of Windows
        "G1 X10 Y10 Z.2\nG91\nG1 X10 E1\nG1 Y10 E1\n",                             // all relative
        "G0 X10 Y10 Z.2\nG1 X20 E1\nG92 E0\nG1 Y20 E1\n",                          // E set back
        "G92 X-90 E5\nG1 X-80 Y10 Z.2\nG1 X-70 E6\nG1 Y20 E7\n",                   // X, too
        "G20\nG1 X.39370078740157483 Y.39370078740157483 Z.0078740157480314963\n"  // inches
        "G1 X.78740157480314965 E.039370078740157483\nG1 Y.78740157480314965 "
        "E.078740157480314966\n",
        "G1 X10 Y10 Z.2\nG1 E-3\nG1 E0\nG1 X20 E1\nG1 E-1 F2400\nG1 Y15 X30\nG1 X20 Y10\nG1 "
        "Y20 E2\n",                                                                   // retracted
        "G1 X10 Y10 Z.2\nG10\nG11\nG1 X20 E1\nG10\nG1 Z5\nG1 Z.2\nG11\nG1 Y20 E2\n",  // by
                                                                                      // the
                                                                                      // firmware
        "M200 D1.75\nG1 X10 Y10 Z.2\nG1 X20 E2.4052818754046852\nG1 Y20 "
        "E4.8105637508093704\n",  // E in mm^3
        "G1 X10 Y10 Z.2\nG1 X20 E2.4052818754046852\nG1 Y20 E4.8105637508093704\n; "
        "use_volumetric_e = 1\n",
        "N1 G1 X10 Y10 Z.2*99\nN2 G1 X20 E1*7\nN3 G1 Y20 E2*14\n",        // numbered
        "g1 x10 y10 z.2\nG1X20E1\nG01 Y20 E2 (a remark; and another)\n",  // as people write
                                                                          // it
        "; layer_height = 9\nSTART_PRINT BED=60 X=9\nM104 S200\nG28 W\nG29\nT0\nG4 "
        "P100\nM486 T1\n"
        "G1 X10 Y10 Z.2\nG1 X20 E1\nG1 Y20 E2\nM117 X1E9 G1\n"));  // what else is in files

TEST(Gcode, ArcsByCentreAndByRadiusMakeARing) {
  const double width = area / (pi * 8 * 0.2);  // 1 mm of filament each half
  const Moments want = ring({10, 0, 0.1}, 8 - width / 2, 8 + width / 2, 0.2);
  for (const char* halves :
       {"G3 X2 I-8 E1\nG3 X18 I8 J0 E2\n", "G2 X2 I-8 E1\nG2 X18 I8 E2\n", "G3 X2 R8 E1\nG3 X18 R8 E2\n",
        "G3 I-8 E2\n", "G2 I-8 J0 E2\n", "G2 I-8 P1 E2\n"})
    expect_equal(part_of(fmt::format("G1 X18 Y0 Z.2\n{}", halves)), want, 1e-9);
  // The longer way round: three quarters.
  const Moments quarters = part_of("G1 X18 Y0 Z.2\nG3 X10 Y-8 R-8 E3\nG3 X18 Y0 R8 E4\n");
  expect_equal(quarters, ring({10, 0, 0.1}, 8 - width, 8 + width, 0.2), 1e-9);
}

TEST(Gcode, LayersAreAsHighAsTheSlicerSaysOrAsTheNozzleClimbs) {
  // Two beads above each other, of 0.3 and 0.2 mm.
  const auto stack = [&](const char* first, const char* second) {
    return part_of(fmt::format("M83\n{}G1 X0 Y0 Z.3\nG1 X10 E1\n{}G1 X0 Z.5\nG1 X10 E1\n", first, second));
  };
  const Moments want = box_moments({5, 0, 0.15}, {10, area / (10 * 0.3), 0.3}) +
                       box_moments({5, 0, 0.4}, {10, area / (10 * 0.2), 0.2});
  expect_equal(stack("", ""), want);
  expect_equal(stack("; LAYER_HEIGHT: 0.3\n", "; LAYER_HEIGHT: 0.2\n"), want);
  expect_equal(stack(";HEIGHT:0.3\n", ";HEIGHT:0.2\n"), want);
  // A machine primes in the air first, standing or not: no layer is as high as that.
  const Print primed = read("M83\nG1 Z15\nG1 E3\n;TYPE:FILL\nG1 X0 Y0 Z.3\nG1 X10 E1\nG1 X0 Z.5\nG1 X10 E1\n",
                            {std::nullopt, 1e3});
  expect_equal(primed.part_mass(), want);
  expect_equal(part_of("M83\nG1 X5 Z15 E0\nG1 X9 E1\nG1 X0 Y0 Z.3\nG1 X10 E1\nG1 X0 Z.5\nG1 X10 E1\n") -
                   box_moments({7, 0, 7.5}, {4, area / (4 * 15), 15}),
               want);
  const Moments bridge = box_moments({5, 0, 0.3}, {10, area / (10 * 0.4), 0.4});
  expect_equal(stack("", ";HEIGHT:.4\n"), box_moments({5, 0, 0.15}, {10, area / (10 * 0.3), 0.3}) + bridge);
}

/// One bead of 10 mm of filament a call, ten millimetres long at that place.
std::string bead(int y, double z = 0.2) { return fmt::format("G0 X0 Y{} Z{}\nG1 X10 E10 F1800\n", y, z); }

/// How much of what: mm of filament, by type, object and tool.
std::vector<std::string> told(const std::string& text) {
  std::vector<std::string> all;
  for (const PrintGroup& g : read(text).groups)
    all.push_back(fmt::format("{}|{}|{}|{:.6g}|{}", g.type, g.object, g.tool, g.volume() / area,
                              g.of_part ? "part" : "beside"));
  return all;
}

using Told = std::vector<std::string>;

TEST(GcodeDialects, PrusaSlicer) {
  const std::string text =
      "; generated by PrusaSlicer 2.5.0+x on 2026-11-30 at 13:00:46 UTC\n\nM83\n;TYPE:Custom\n" + bead(0) +
      ";LAYER_CHANGE\n;Z:.2\n;HEIGHT:0.2\n;TYPE:Skirt/Brim\n;WIDTH:0.45\n" + bead(1) +
      "; printing object cube.stl id:0 copy 0\n;TYPE:External perimeter\n" + bead(2) +
      ";TYPE:Solid infill\n" + bead(3) +
      "; stop printing object cube.stl id:0 copy 0\n; printing object cube.stl id:0 copy 1\n" + bead(4) +
      ";TYPE:Support material interface\n" + bead(5) +
      "; stop printing object cube.stl id:0 copy 1\n;TYPE:Wipe tower\n" + bead(6) +
      "; filament used [mm] = 60\n; prusaslicer_config = begin\n; filament_diameter = 1.75\n";
  EXPECT_EQ(
      told(text),
      (Told{"Custom||0|10|beside", "Skirt/Brim||0|10|beside",
            "External perimeter|cube.stl id:0 copy 0|0|10|part",
            "Solid infill|cube.stl id:0 copy 0|0|10|part", "Solid infill|cube.stl id:0 copy 1|0|10|part",
            "Support material interface|cube.stl id:0 copy 1|0|10|beside", "Wipe tower||0|10|beside"}));
  const Print print = read(text);
  EXPECT_EQ(print.slicer, "PrusaSlicer 2.5.0+x");
  EXPECT_EQ(print.used_mm, 60);
  ASSERT_EQ(print.objects.size(), 2u);
  EXPECT_NEAR(print.objects[1].foot[1], 4, 1e-12);
  ASSERT_EQ(print.layers.size(), 1u);
  EXPECT_NEAR(print.layers[0].volume, 30 * area, 1e-9);
}

TEST(GcodeDialects, Slic3rSaysNoTypesUnlessAsked) {
  const std::string head = "; generated by Slic3r 1.3.0 on 2026-11-30 at 13:00:47\nM83\n",
                    foot = "; filament used = 20.0mm (0.1cm3)\n; filament_diameter = 3\n";
  EXPECT_EQ(told(head + bead(0) + bead(1, 0.4) + foot).size(), 1u);
  EXPECT_NEAR(read(head + bead(0) + bead(1, 0.4) + foot).part_volume(), 20 * pi / 4 * 9, 1e-9);
  EXPECT_EQ(read(head + bead(0) + bead(1, 0.4) + foot).layers.size(), 2u);
  EXPECT_EQ(
      told(head +
           "G1 X0 Y0 Z.2 ; move to next layer (0)\nG1 X5 E1 ; skirt\nG1 E-1 ; retract\nG1 E1 ; unretract\n"
           "G1 X9 E2 ; perimeter\nG1 X3 E3 ; infill\n; filament_diameter = 1.75\n; filament used = 6mm "
           "(0.1cm3)\n"),
      (Told{"skirt||0|1|beside", "perimeter||0|2|part", "infill||0|3|part"}));
}

TEST(GcodeDialects, Cura) {
  const std::string text =
      ";FLAVOR:Marlin\n;TIME:6666\n;Layer height: 0.2\n;Generated with Cura_SteamEngine 4.13.0\nM83\nG1 F200 "
      "E3\n"
      ";LAYER_COUNT:2\n;LAYER:-1\n;TYPE:SUPPORT-INTERFACE\n" +
      bead(0) + ";LAYER:0\n;TYPE:SKIRT\n" + bead(1) + ";MESH:a.stl\n;TYPE:WALL-OUTER\n" + bead(2) +
      ";MESH:b.stl\n;TYPE:WALL-OUTER\n" + bead(3) +
      ";MESH:NONMESH\n;LAYER:1\n"
      ";MESH:a.stl\n;TYPE:FILL\n" +
      bead(4, 0.4) + ";TIME_ELAPSED:20\n";
  EXPECT_EQ(told(text),
            (Told{"||0|3|beside", "SUPPORT-INTERFACE||0|10|beside", "SKIRT||0|10|beside",
                  "WALL-OUTER|a.stl|0|10|part", "WALL-OUTER|b.stl|0|10|part", "FILL|a.stl|0|10|part"}));
  EXPECT_EQ(read(text).layers.size(), 2u);
  // E in mm^3, and a raft of what elsewhere would be the part.
  EXPECT_NEAR(read(";FLAVOR:UltiGCode\nM83\n;LAYER:-2\n;TYPE:SKIN\n" + bead(0) + ";LAYER:0\n" + bead(1, 0.5))
                  .part_volume(),
              10, 1e-9);
}

TEST(GcodeDialects, OrcaSlicer) {
  const std::string text =
      "; HEADER_BLOCK_START\n; generated by OrcaSlicer 2.1.1 on 2024-08-01 at 10:00:00\n; filament_density: "
      "1.24,1.27\n"
      "; filament_diameter: 1.75,1.75\n; HEADER_BLOCK_END\n; "
      "EXECUTABLE_BLOCK_START\n;TYPE:Custom\nM83\n;LAYER_CHANGE\n;Z:0.2\n;HEIGHT:0.2\n"
      "; printing object a id:0 copy 0\nEXCLUDE_OBJECT_START NAME=a_id_0_copy_0\n;TYPE:Inner "
      "wall\n;WIDTH:0.42\n" +
      bead(0) + ";TYPE:Sparse infill\n" + bead(1) +
      "EXCLUDE_OBJECT_END NAME=a_id_0_copy_0\n; stop printing object a id:0 copy 0\nT1\n;TYPE:Prime tower\n" +
      bead(2) + "EXCLUDE_OBJECT_START NAME=b\n;TYPE:Internal solid infill\n" + bead(3) +
      "EXCLUDE_OBJECT_END\n; EXECUTABLE_BLOCK_END\n\n"
      "; filament used [mm] = 20.0, 20.0\n; filament_density = 1.24,1.27\n";
  EXPECT_EQ(told(text), (Told{"Inner wall|a_id_0_copy_0|0|10|part", "Sparse infill|a_id_0_copy_0|0|10|part",
                              "Prime tower||1|10|beside", "Internal solid infill|b|1|10|part"}));
  EXPECT_EQ(read(text).used_mm, 40);
  EXPECT_NEAR(read(text).part_mass()[S1], 1e-3 * area * (20 * 1.24 + 10 * 1.27), 1e-12);
}

TEST(GcodeDialects, BambuStudio) {
  const std::string text =
      "; HEADER_BLOCK_START\n; BambuStudio 01.09.05.51\n; total layer number: 1\n; HEADER_BLOCK_END\n; "
      "CONFIG_BLOCK_START\n"
      "; filament_density = 1.26\n; filament_diameter = 1.75\n; CONFIG_BLOCK_END\n; "
      "EXECUTABLE_BLOCK_START\nM83\n; FEATURE: Custom\n" +
      bead(0) +
      "; CHANGE_LAYER\n; Z_HEIGHT: 0.2\n; LAYER_HEIGHT: 0.2\nT1000\n; start printing object, unique label "
      "id: 97\nM624 AQAAAAAAAAA=\n"
      "; FEATURE: Outer wall\n; LINE_WIDTH: 0.42\n" +
      bead(1) + "; FLUSH_START\n" + bead(2) +
      "; FLUSH_END\nG3 Z.6 I1.2 J0 P1 F60000\n"
      "; FEATURE: Support transition\n" +
      bead(3) + "; stop printing object, unique label id: 97\nM625\n; EXECUTABLE_BLOCK_END\n";
  EXPECT_EQ(told(text), (Told{"Custom||0|10|beside", "Outer wall|97|0|10|part", "Outer wall|97|0|10|beside",
                              "Support transition|97|0|10|beside"}));
  EXPECT_EQ(read(text).slicer, "BambuStudio 01.09.05.51");
  EXPECT_FALSE(read(text).filaments[0].density_assumed);
}

TEST(GcodeDialects, MarlinsObjects) {
  EXPECT_EQ(told("M83\nM486 T2\nM486 S0\n" + bead(0) + "M486 S1\n" + bead(1) + "M486 S-1\n" + bead(2)),
            (Told{"|0|0|10|part", "|1|0|10|part", "||0|10|part"}));
}

TEST(Gcode, EachToolHasItsFilament) {
  const std::string text = "M83\n" + bead(0) + "T1\nG1 E5\nG1 E-2\nT0\nG1 E-4\nT1\nG1 E2\n" + bead(1) +
                           "T0\nG1 E4\n" + bead(2) +
                           "; filament_diameter = 1.75,2.85\n; filament_density = 1.2,0\n";
  const Print print = read(text);
  ASSERT_EQ(print.filaments.size(), 2u);
  EXPECT_EQ(print.filaments[1].diameter, 2.85);
  EXPECT_FALSE(print.filaments[0].density_assumed);
  EXPECT_TRUE(print.filaments[1].density_assumed);
  // What a tool drew back it owes itself alone.
  EXPECT_NEAR(print.part_volume(), 20 * area + 15 * pi / 4 * 2.85 * 2.85, 1e-9);
  EXPECT_NEAR(read(text, {3, 2}).part_mass()[S1], 1e-3 * 2 * 35 * pi / 4 * 9, 1e-9);
}

struct Bad {
  std::string text, says;
};

class BadGcode : public ::testing::TestWithParam<Bad> {};

TEST_P(BadGcode, IsRefusedInOneLine) {
  expect_refusal([] { (void)read(GetParam().text); }, "part.gcode: ", {GetParam().says});
}

INSTANTIATE_TEST_SUITE_P(
    Each, BadGcode,
    ::testing::Values(Bad{"", "empty file"}, Bad{"G1 X1\nG1 Y2\n", "prints nothing"},
                      Bad{"M83\nG1 Xnan E1\n", "line 2: 'Xnan'"},
                      Bad{"M83\nG1 X1.2.3 E1\n", "line 2: 'X1.2.3'"}, Bad{"G1 X E1\n", "line 1: 'X'"},
                      Bad{"G1 X- E1\n", "'X-'"}, Bad{"G1 X1 Einf\n", "'Einf'"}, Bad{"G1 X1,5 E1\n", "'X1,5'"},
                      Bad{"G1 X1 \"E1\"\n", "'\"E1\"'"}, Bad{"G92 E\x1b[2J\n", "'E?[2J'"},
                      Bad{"\n\nG1 X1e7 Y1\nG1 X10000000 E1\n", "X1e+07"},
                      Bad{"G1 X5 E99999999999\n", "E1e+11"}, Bad{"GCDE\x01\x02\n", "binary"},
                      Bad{std::string("\x7f"
                                      "ELF\0\0\n",
                                      7),
                          "binary"},
                      Bad{std::string(3u << 20, 'x'), "longer than"},
                      Bad{"G3 X5 Y5 E1\n", "without its centre"},
                      Bad{"G1 X5\nG3 X9 I1 J0 E1\n", "line 2: an arc that begins 1 mm"},
                      Bad{"G3 R5 E1\n", "ends where it begins"}, Bad{"G3 X20 R5 E1\n", "20 mm apart"},
                      Bad{"G18\nG3 X2 I1 E1\n", "plane"}, Bad{"G5 X1 Y1 I1 J1 P1 Q1 E1\n", "G5"},
                      Bad{"G1 X10 E1\nG1 X2", "line 2: the file ends within"},
                      Bad{";HEIGHT:x\nG1 X1 E1\n", "line 1: height 'x'"},
                      Bad{"; generated by PrusaSlicer 2.5.0 on x\nG1 X9 E1\n", "cut off"},
                      Bad{"; EXECUTABLE_BLOCK_START\nG1 X9 E1\n", "cut off"},
                      Bad{";LAYER_COUNT:9\n;LAYER:0\nG1 X9 E1\n", "the last of 9 layers"}));

TEST(BadGcode, HasNoMoreLabelsThanThereCanBe) {
  std::string text;
  for (int k = 0; k < 20000; ++k) text += fmt::format(";TYPE:{}\n", k);
  expect_refusal([&] { (void)read(text); }, "part.gcode: line 10001: ", {"more than 10000 types"});
}

TEST(Gcode, IsKnownByItsName) {
  EXPECT_TRUE(is_gcode("a/b.gcode"));
  EXPECT_TRUE(is_gcode("B.GCO"));
  EXPECT_FALSE(is_gcode("b.stl"));
  expect_refusal([] { (void)read_gcode("/nowhere/b.gcode"); }, "/nowhere/b.gcode: ", {"No such file"});
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
