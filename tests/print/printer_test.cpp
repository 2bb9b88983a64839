// printer_test.cpp - printers that are known, and what they take.
#include "print/printer/printer.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <filesystem>

#include "geometry/moved.hpp"
#include "mesh/shapes.hpp"
#include "refusal.hpp"

namespace kreisel::core {
namespace THIS_FILE {

constexpr const char* bundle = R"(
# a maker's
[printer_model:P1]
name = First && Second
variants = 0.4; 0.6
technology = FFF

[printer_model:S1]
name = Of resin

[printer:*common*]
bed_shape = 0x0,200x0,200x100,0x100
max_print_height = 150
nozzle_diameter = 0.4,0.4
min_layer_height = 0.07
max_layer_height = 0.25
printer_technology = FFF
[printer:*tall*]
max_print_height = 180
[printer:First 0.8 nozzle]
inherits = *common*; *tall*
printer_model = P1
nozzle_diameter = 0.8
max_layer_height = 0.5
[printer:First]
inherits = *common*; *tall*
printer_model = P1
[printer:First 0.6 nozzle]
inherits = First
nozzle_diameter = 0.6
[printer:Resin]
inherits = *common*
printer_technology = SLA
printer_model = S1
[printer:Round]
inherits = Round
printer_model = P1
)";

TEST(Printers, InheritAsTheSlicersProfilesDo) {
  const auto found = printers_of_slicer(bundle, "a.ini");
  ASSERT_EQ(found.size(), 1u);
  const Printer& printer = found.front();
  EXPECT_EQ(printer.name, "First & Second");
  EXPECT_EQ(printer.also, std::vector<std::string>{"P1"});
  EXPECT_EQ(printer.height, 180);
  EXPECT_EQ(printer.nozzles, (std::vector<double>{0.4, 0.8, 0.6}));
  EXPECT_EQ(printer.least_layer, 0.07);  // of the usual nozzle, which is not the first that there is
  EXPECT_EQ(printer.most_layer, 0.25);
  EXPECT_EQ(printer.size_text(), "200 x 100 x 180 mm");
  EXPECT_EQ(printer.bed_text(), "0x0,200x0,200x100,0x100");
  EXPECT_TRUE(printers_of_slicer("no = section\n[printer:]\n[", "a.ini").empty());
}

TEST(Printers, TakeWhatLiesOnTheirBed) {
  Printer printer{"p", {}, {{0, 0}, {200, 0}, {200, 100}, {0, 100}}, 50};
  const TriangleMesh whole = box_mesh({0, 0, 0}, {200, 100, 50});
  EXPECT_TRUE(printer.holds(whole));
  EXPECT_FALSE(printer.holds(moved(whole, Eigen::Translation3d(0.01, 0, 0))));
  EXPECT_FALSE(printer.holds(box_mesh({0, 0, 0}, {1, 1, 50.1})));
  std::ranges::reverse(printer.bed);  // whichever way round it is told
  EXPECT_TRUE(printer.holds(whole));
  // A round bed takes what is inside its circle, not what is inside its box.
  Printer round{"r", {}, {}, 50};
  for (int k = 0; k < 64; ++k) {
    const double angle = 2 * 3.14159265358979 * k / 64;
    round.bed.emplace_back(100 * std::cos(angle), 100 * std::sin(angle));
  }
  EXPECT_TRUE(round.holds(box_mesh({-70, -70, 0}, {70, 70, 1})));
  EXPECT_FALSE(round.holds(box_mesh({-72, -72, 0}, {72, 72, 1})));
}

TEST(Printers, OfOursCiteAProfile) {
  for (const Printer& printer : printers()) {
    EXPECT_GE(printer.bed.size(), 3u) << printer.name;
    EXPECT_GT(printer.height, 50) << printer.name;
    EXPECT_FALSE(printer.nozzles.empty()) << printer.name;
    EXPECT_GT(printer.nozzles.front(), 0.1) << printer.name;
    EXPECT_FALSE(printer.source.empty()) << printer.name;
  }
  const Printer mini = find_printer("bambu lab a1 MINI");
  EXPECT_EQ(mini.size_text(), "180 x 180 x 180 mm");
  EXPECT_NE(mini.source.find("github.com/bambulab"), std::string::npos);
}

TEST(Printers, GoByNameAndNozzle) {
  EXPECT_EQ(find_printer("CORE One").name, "Prusa CORE One");
  const Printer fine = find_printer("CORE One@0.25");
  EXPECT_EQ(fine.nozzles.front(), 0.25);
  EXPECT_EQ(fine.most_layer, 0);
  expect_refusal([] { (void)find_printer("CORE One@0.7"); }, "--printer CORE One@0.7: no such nozzle",
                 {"0.25"});
  expect_refusal([] { (void)find_printer("Bambu Lab"); }, "--printer Bambu Lab: several go by it",
                 {"A1 mini"});
  expect_refusal([] { (void)find_printer("Prusa CORE Own"); }, "--printer Prusa CORE Own: unknown",
                 {"did you mean prusa core one"});
  expect_refusal([] { (void)find_printer("qqqqqq"); }, "--printer qqqqqq: unknown", {"--printer list"});
}

TEST(Printers, OfPrusaSlicerAreThoseOfItsProfiles) {
  if (!std::filesystem::exists("/usr/share/PrusaSlicer/profiles/PrusaResearch.ini"))
    GTEST_SKIP() << "PrusaSlicer's profiles are not here";
  const Printer mk3 = find_printer("MK3S");
  EXPECT_EQ(mk3.size_text(), "250 x 210 x 210 mm");
  EXPECT_EQ(mk3.nozzles.front(), 0.4);
  EXPECT_GE(mk3.nozzles.size(), 3u);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
