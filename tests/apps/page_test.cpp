// page_test.cpp - the page of `design --html`, opened in a browser without a screen.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>

#include "apps/installed.hpp"
#include "apps/run_design.hpp"
#include "temporary_folder.hpp"

namespace kreisel {
namespace {

class Page : public ::testing::Test {
 protected:
  void SetUp() override {
    KREISEL_NEEDS(std::filesystem::exists("/usr/share/javascript/three/three.min.js"), "libjs-three");
    const BenchAnswer a = design(
        fmt::format("spin ellipsoid -o {0}/part.stl --html {0}/page.html --resolution 40 --fineness 24",
                    folder_.path.string()));
    ASSERT_EQ(a.code, 0) << a.out;
  }

  [[nodiscard]] std::string text() const {
    std::ifstream in(folder_.path / "page.html");
    return {std::istreambuf_iterator<char>(in), {}};
  }

  const TemporaryFolder folder_;
};

TEST_F(Page, NeedsNothingButItself) {
  const std::string page = text();
  for (const char* elsewhere : {" src=", "<link", "@import", "@THREE@", "@REPORT@", "@MESHES@"})
    EXPECT_EQ(page.find(elsewhere), std::string::npos) << elsewhere;
  EXPECT_NE(page.find("\"constraint_residual\""), std::string::npos);
}

TEST_F(Page, ShowsThePartAndCutsItOpen) {
  KREISEL_NEEDS(installed("chromium"), "chromium");
  const auto opened = [&](const char* cut) {
    return shell(
               fmt::format("timeout 300 chromium --headless --no-sandbox --use-angle=swiftshader "
                           "--enable-unsafe-swiftshader --user-data-dir='{0}/profile' --window-size=900,700 "
                           "--dump-dom 'file://{0}/page.html#cut={1}' 2> /dev/null",
                           folder_.path.string(), cut))
        .out;
  };
  const auto number = [](const char* name, const std::string& dom) {
    std::smatch found;
    return std::regex_search(dom, found, std::regex(fmt::format("data-{}=\"(\\d+)\"", name)))
               ? std::stod(found[1])
               : -1;
  };
  const std::string closed = opened("0"), half = opened("0.5");
  for (const std::string& dom : {closed, half}) {
    // The scripts' own text mentions it, too; the attribute is on the body.
    EXPECT_EQ(dom.find("<body data-error"), std::string::npos) << dom.substr(0, 2000);
    EXPECT_GT(number("drawn", dom), 20000) << "pixels that are not background";
    EXPECT_NE(dom.find("<td>mass, g</td>"), std::string::npos);
    EXPECT_NE(dom.find("id=\"verdict\" class=\"\">spins: "), std::string::npos);
  }
  EXPECT_EQ(number("open", closed), 0) << "nothing is cut";
  EXPECT_GT(number("open", half), 3000) << "pixels of material that is cut";
}

}  // namespace
}  // namespace kreisel
