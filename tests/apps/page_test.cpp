// page_test.cpp - the page of `design --html`, opened in a browser without a screen.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>

#include "apps/run_design.hpp"
#include "deform/bodies.hpp"
#include "installed.hpp"
#include "mesh/io/write.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

class Page : public ::testing::Test {
 protected:
  void SetUp() override {
    KREISEL_NEEDS(std::filesystem::exists("/usr/share/javascript/three/three.min.js"), "libjs-three");
  }

  /// A page of a part, made once.
  [[nodiscard]] const std::string& text() const {
    static const std::string made = [this] {
      const BenchAnswer a = design(
          fmt::format("spin ellipsoid -o {0}/part.stl --html {0}/part.html --resolution 40 --fineness 24",
                      folder_.path.string()));
      EXPECT_EQ(a.code, 0) << a.out;
      std::ifstream in(folder_.path / "part.html");
      return std::string{std::istreambuf_iterator<char>(in), {}};
    }();
    return made;
  }

  /// Writes page.html of what is designed.
  void make_page(const std::string& asked) const {
    const BenchAnswer a =
        design(fmt::format("{1} -o {0}/part.stl --html {0}/page.html --force", folder_.path.string(), asked));
    ASSERT_EQ(a.code, 0) << a.out;
  }

  /// What a browser makes of a page. @param view  behind the #, as cut=0.5
  [[nodiscard]] std::string opened(const char* name, const char* view) const {
    return shell(fmt::format("timeout 300 chromium --headless --no-sandbox --use-angle=swiftshader "
                             "--enable-unsafe-swiftshader --virtual-time-budget=60000 "
                             "--user-data-dir='{0}/profile' --window-size=600,460 "
                             "--dump-dom 'file://{0}/{1}.html#{2}' 2> /dev/null",
                             folder_.path.string(), name, view))
        .out;
  }
  /// What the page says of its picture.
  [[nodiscard]] static double number(const char* name, const std::string& dom) {
    std::smatch found;
    return std::regex_search(dom, found, std::regex(fmt::format("data-{}=\"(\\d+)\"", name)))
               ? std::stod(found[1])
               : -1;
  }

  const TemporaryFolder folder_;
};

TEST_F(Page, NeedsNothingButItself) {
  const std::string page = text();
  for (const char* elsewhere : {" src=", "<link", "@import", "@THREE@", "@REPORT@", "@BODIES@"})
    EXPECT_EQ(page.find(elsewhere), std::string::npos) << elsewhere;
  EXPECT_NE(page.find("\"constraint_residual\""), std::string::npos);
}

TEST_F(Page, ShowsThePartAndCutsItOpen) {
  KREISEL_NEEDS(installed("chromium"), "chromium");
  std::ofstream(folder_.path / "page.html") << text();
  // A copy of the page whose slider is moved, as by hand, once it has been drawn.
  {
    std::string moved = text();
    moved.insert(
        moved.rfind("</html>"),
        "<script>const waiting = setInterval(() => { if (!('drawn' in document.body.dataset)) return; "
        "clearInterval(waiting); const slider = document.getElementById('cut'); slider.value = 0.5; "
        "slider.dispatchEvent(new Event('input')); }, 20);</script>\n");
    std::ofstream(folder_.path / "moved.html") << moved;
  }
  const std::string closed = opened("page", "cut=0"), half = opened("page", "cut=0.5"),
                    moved = opened("moved", "cut=0");
  for (const std::string& dom : {closed, half, moved}) {
    // The scripts' own text mentions it, too; the attribute is on the body.
    EXPECT_EQ(dom.find("<body data-error"), std::string::npos) << dom.substr(0, 2000);
    EXPECT_GT(number("drawn", dom), 8760) << "pixels that are not background";
    EXPECT_NE(dom.find("<td>mass, g</td>"), std::string::npos);
    EXPECT_NE(dom.find("id=\"verdict\" class=\"\">spins: "), std::string::npos);
  }
  EXPECT_EQ(number("open", closed), 0) << "nothing is cut";
  EXPECT_GT(number("open", half), 1314) << "pixels of material that is cut";
  EXPECT_EQ(number("open", moved), number("open", half)) << "by the slider";
}

TEST_F(Page, SetsThePrintBesideThePart) {
  KREISEL_NEEDS(installed("chromium"), "chromium");
  KREISEL_NEEDS(installed("prusa-slicer"), "prusa-slicer");
  make_page("spin ellipsoid --size 25 --wall 1 --resolution 24 --fineness 8 --slicer prusa-slicer --accept");
  const std::string dom = opened("page", "cut=0.5");
  EXPECT_EQ(dom.find("<body data-error"), std::string::npos) << dom.substr(0, 2000);
  EXPECT_NE(dom.find("<th>solid</th><th>part</th><th>print</th>"), std::string::npos);
  EXPECT_NE(dom.find("as printed by PrusaSlicer"), std::string::npos);
}

TEST_F(Page, OfADeformedBodySlidesBetweenBothShapes) {
  KREISEL_NEEDS(installed("chromium"), "chromium");
  write_mesh(folder_.path / "leaning.off", {leaning_ellipsoid({14, 16, 30}, 50, 40)});
  make_page(fmt::format("spin {}/leaning.off --resolution 32 --wall 1.5 --deform least --accept",
                        folder_.path.string()));
  const std::string now = opened("page", "cut=0"), before = opened("page", "cut=0&shape=0");
  for (const std::string& dom : {now, before})
    EXPECT_EQ(dom.find("<body data-error"), std::string::npos) << dom.substr(0, 2000);
  EXPECT_EQ(number("shape", before), 0);
  EXPECT_NE(number("drawn", before), number("drawn", now)) << "another outline";
}

/// Of a solid under water less is known than of the part that floats.
TEST_F(Page, IsDrawnWhereTheSolidSinks) {
  KREISEL_NEEDS(installed("chromium"), "chromium");
  make_page("float duck --fineness 16 --density 1.24 --draft 40% --resolution 40");
  EXPECT_GT(number("drawn", opened("page", "cut=0.5")), 0);
}

TEST_F(Page, OfANestedDollTakesItApart) {
  KREISEL_NEEDS(installed("chromium"), "chromium");
  make_page("nest duck --fineness 12 --particles 24 --iterations 6 --cells 48 --printer-accuracy 1");
  const std::string whole = opened("page", "cut=0.5"), apart = opened("page", "cut=0.5&apart=1");
  for (const std::string& dom : {whole, apart}) {
    EXPECT_EQ(dom.find("<body data-error"), std::string::npos) << dom.substr(0, 2000);
    EXPECT_NE(dom.find("id=\"verdict\" class=\"\">nests: 1 layer"), std::string::npos);
    EXPECT_NE(dom.find("<td>layer-1-upper</td>"), std::string::npos);
  }
  EXPECT_GT(number("open", whole), 1314);
  EXPECT_LT(number("open", apart), number("open", whole))
      << "from farther away, most of it moved out of the cut";
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
