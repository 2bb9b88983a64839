#include <gtest/gtest.h>

#include <cmath>

#include "experiment/recorded_runs.hpp"
#include "table/data_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

/// A square plate of 10 mm a length: solid at a height of 0.5 and 1 thick, written flat and low.
RecordedRun plate(const std::string& problem, const std::map<std::string, std::string>& settings,
                  double height = 0.125) {
  RunResult r = optimal_result(settings);
  r.config.problem = problem;
  r.config.body.model = "teapot";
  r.frame.length = r.length_mm = 10;
  r.solid = box_moments({0, 0, 4 * height}, {1.5, 1.5, 1});
  r.verified.moments = box_moments({0, 0, height}, {2, 2, 0.25});
  return recorded(r);
}

TEST(TopTable, SetsTheRatioOfSpeedsBesideThePapers) {
  const Published paper = read_published(published_file("spinit_teapot"));
  const Tables tables = tables_by(
      "tops", {plate("top", {{"problem.lower", "none"}}), plate("top", {{"problem.gamma_c", "2"}})}, paper);
  // omega^2 goes like c / (Izz - Ixx) per mass: 0.5 / (1.25/12) of the solid, 0.125 / (3.9375/12) of the
  // part.
  const double ratio = std::sqrt((0.5 / 1.25) / (0.125 / 3.9375));
  EXPECT_NEAR(ratio, 3.55, 0.005);
  EXPECT_EQ(squeezed_line(to_text(tables), "teapot  40x26x26  top      rayrep       1.5h  lower=none"),
            "teapot 40x26x26 top rayrep 1.5h lower=none 0.8 44.4 | 0.00 0.00 5.00 1.385 655 | 1.25 1.969 185 "
            "| 3.55 "
            "1.56 | yes")
      << to_text(tables);
  const std::string other =
      squeezed_line(to_text(tables), "teapot  40x26x26  top      rayrep       1.5h  gamma_c=2");
  EXPECT_NE(other.find("| 3.55 - | yes"), std::string::npos)
      << "the paper's weights are taken for ours: " << other;
}

TEST(TopTable, OfYoyosHasNoSpeeds) {
  const std::string text = to_text(tables_by("tops", {plate("yoyo", {}, 0)}));
  EXPECT_EQ(text.find("rpm"), std::string::npos) << text;
  EXPECT_EQ(squeezed_line(text, "teapot"),
            "teapot 40x26x26 yoyo rayrep 1.5h defaults 0.8 44.4 | 0.00 0.00 1.385 | 1.969 | yes");
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
