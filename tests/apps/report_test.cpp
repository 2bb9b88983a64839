// report_test.cpp - `bench report` and the scripts of plots/ as a user runs them, on a tiny experiment.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "apps/run_bench.hpp"
#include "installed.hpp"
#include "places.hpp"

namespace kreisel::core {
namespace THIS_FILE {

namespace fs = std::filesystem;

BenchAnswer plot(const std::string& script, const std::string& arguments) {
  return shell(fmt::format("KREISEL_BENCH='{}' /usr/bin/python3 '{}/plots/{}.py' {}", bench_program,
                           source_folder, script, arguments));
}

std::string content_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

/// Runs a tiny experiment once for all tests: two starts, one run that ends in an error.
class Report : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = fs::temp_directory_path() / fmt::format("kreisel-report-test-{}", ::getpid());
    fs::create_directories(folder_);
    std::ofstream(file("tiny.toml")) << "# tiny.toml - does <it> work?\n#\n# A second paragraph.\n\n"
                                        "title = \"A tiny & simple experiment\"\ntable = \"settings\"\n"
                                        "figures = [\"settings\", \"history\"]\n"
                                        "model = \"ellipsoid\"\nresolution = 24\nfineness = 16\n"
                                        "[[run]]\nset.solver.start = [\"lower\", \"upper\"]\n"
                                        "[[run]]\nset.ipopt.output_file = \"/nowhere/log\"\n";
    std::ofstream(file("other.toml")) << "[[run]]\nmodel = \"bird\"\n";
    ran_ = bench(fmt::format("run {} --results {}", file("tiny.toml"), file("runs")));
  }
  static void TearDownTestSuite() { fs::remove_all(folder_); }
  void SetUp() override { KREISEL_NEEDS(imports("h5py, matplotlib"), "h5py or matplotlib"); }
  static std::string file(const std::string& name) { return (folder_ / name).string(); }

  static inline fs::path folder_;
  static inline BenchAnswer ran_;
};

TEST_F(Report, IsOnePageWithTablesFiguresAndProvenance) {
  ASSERT_EQ(ran_.code, 4) << ran_.out;  // the run that writes nowhere failed
  const BenchAnswer a = bench(fmt::format("report {} {} --results {} -o {}", file("tiny.toml"),
                                          file("other.toml"), file("runs"), file("page.html")));
  ASSERT_EQ(a.code, 0) << a.out;
  const std::string page = content_of(file("page.html"));
  EXPECT_NE(page.find("A tiny &amp; simple experiment</h2>"), std::string::npos);
  EXPECT_NE(page.find("<p>Does &lt;it&gt; work?</p>"), std::string::npos) << "the comment of the file";
  EXPECT_EQ(count(page, "<img"), 2u);
  EXPECT_EQ(count(page, "src=\"data:image/png;base64,"), 2u) << "figures are embedded";
  EXPECT_NE(page.find("<td class=\"left\">start=lower</td><td class=\"left\">optimal</td>"),
            std::string::npos);
  EXPECT_NE(page.find("<td class=\"left\">output_file=/nowhere/log</td><td class=\"left\">error</td>"),
            std::string::npos);
  EXPECT_NE(page.find("href=\"data:text/csv;charset=utf-8,model%2Cgrid"), std::string::npos);
  EXPECT_NE(page.find("Commit "), std::string::npos);
  EXPECT_EQ(page.find("<h2 id=\"other\""), std::string::npos) << "nothing is on record for it";
  // Nothing is fetched from elsewhere.
  EXPECT_EQ(count(page, "src="), 2u);
  EXPECT_EQ(page.find("<link"), std::string::npos);
  EXPECT_EQ(page.find("<script"), std::string::npos);
  for (const auto& entry : fs::directory_iterator(folder_))
    EXPECT_EQ(entry.path().string().find(".tmp"), std::string::npos) << entry.path();
}

TEST_F(Report, DrawsThePartOfARunInMotionBesideItsSolid) {
  std::ofstream(file("motion.toml"))
      << "table = \"simulation\"\nkind = \"simulation\"\nfigures = [\"simulate\"]\nresolution = 24\n"
         "fineness = 16\nformulation = \"quadric\"\n[[run]]\n"
         "[[run]]\nvoid-density = 1\n";  // nothing to design
  (void)bench(fmt::format("run {} --results {}", file("motion.toml"), file("runs")));
  const BenchAnswer a = bench(
      fmt::format("report {} --results {} -o {}", file("motion.toml"), file("runs"), file("motion.html")));
  ASSERT_EQ(a.code, 0) << a.out;
  const std::string page = content_of(file("motion.html"));
  EXPECT_EQ(count(page, "<img"), 1u) << "of the run that made a part";
  EXPECT_NE(page.find("alt=\"simulate\""), std::string::npos);
}

TEST_F(Report, DrawsTopsCutOpenWhereTheirMeshesAreKept) {
  const std::string common =
      "table = \"tops\"\nfigures = [\"tops\"]\nresolution = 24\nfineness = 16\nproblem = \"top\"\n"
      "formulation = \"quadric\"\n[[run]]\nset.problem.lower = [\"none\", \"height\", \"mass\"]\n";
  std::ofstream(file("tops.toml")) << common << "mesh = true\n";
  std::ofstream(file("bare.toml")) << common;
  for (const std::string name : {"tops", "bare"}) {
    (void)bench(fmt::format("run {} --results {}", file(name + ".toml"), file("runs")));
    const BenchAnswer a = bench(fmt::format("report {} --results {} -o {}", file(name + ".toml"),
                                            file("runs"), file(name + ".html")));
    ASSERT_EQ(a.code, 0) << a.out;
    const std::string page = content_of(file(name + ".html"));
    EXPECT_EQ(count(page, "alt=\"tops\""), name == "tops" ? 1u : 0u);
    EXPECT_EQ(count(page, "no tops with their meshes"), name == "tops" ? 0u : 1u);
  }
}

TEST_F(Report, SaysInOneLineThatNothingIsOnRecord) {
  for (const std::string arguments : {"", "rayrep_table2"}) {
    const BenchAnswer a =
        bench(fmt::format("report {} --results {} -o {}", arguments, file("none"), file("none.html")));
    EXPECT_EQ(a.code, 2) << a.out;
    EXPECT_EQ(std::ranges::count(a.out, '\n'), 1) << a.out;
    EXPECT_NE(a.out.find("no records of"), std::string::npos) << a.out;
    EXPECT_FALSE(fs::exists(file("none.html")));
  }
}

TEST_F(Report, SaysInOneLineThatPythonOrItsModulesAreMissing) {
  const std::string arguments =
      fmt::format("report {} --results {} -o {}", file("tiny.toml"), file("runs"), file("missing.html"));
  const BenchAnswer without = bench(arguments, "KREISEL_PYTHON=/no/such/python3");
  EXPECT_EQ(without.code, 2) << without.out;
  EXPECT_EQ(std::ranges::count(without.out, '\n'), 1) << without.out;
  EXPECT_NE(without.out.find("/no/such/python3"), std::string::npos) << without.out;
  // A module of that name that cannot be imported stands for one that is not there.
  fs::create_directories(folder_ / "broken");
  std::ofstream(folder_ / "broken" / "matplotlib.py") << "raise ImportError(name='matplotlib')\n";
  const BenchAnswer bare = bench(arguments, fmt::format("PYTHONPATH='{}'", file("broken")));
  EXPECT_EQ(bare.code, 2) << bare.out;
  EXPECT_EQ(std::ranges::count(bare.out, '\n'), 1) << bare.out;
  EXPECT_NE(bare.out.find("expected h5py and matplotlib"), std::string::npos) << bare.out;
  EXPECT_FALSE(fs::exists(file("missing.html")));
}

TEST_F(Report, LeavesAnEarlierPageAloneWhenItCannotBeWritten) {
  fs::create_directories(folder_ / "taken.html");
  const BenchAnswer a =
      bench(fmt::format("report {} --results {} -o {}", file("tiny.toml"), file("runs"), file("taken.html")));
  EXPECT_EQ(a.code, 2) << a.out;
  EXPECT_NE(a.out.find("taken.html"), std::string::npos) << a.out;
  EXPECT_TRUE(fs::is_directory(folder_ / "taken.html"));
}

TEST_F(Report, ComparesTwoFoldersRunByRun) {
  const BenchAnswer again = bench(fmt::format("run {} --results {}", file("tiny.toml"), file("again")));
  ASSERT_EQ(again.code, 4) << again.out;
  const BenchAnswer a =
      bench(fmt::format("compare {} {} --csv {}", file("runs"), file("again"), file("c.csv")));
  EXPECT_EQ(a.code, 0) << a.out;
  EXPECT_NE(a.out.find("solver.start=lower"), std::string::npos) << a.out;
  EXPECT_NE(a.out.find("geometric mean of B / A"), std::string::npos) << a.out;
  EXPECT_EQ(count(content_of(file("c.csv")), "\n"), 4u) << "a heading, two runs, one that failed in both";
  // A run is never a hundred times slower than itself, and always slower than next to nothing.
  EXPECT_EQ(bench(fmt::format("compare {} {} --fail-above 100", file("runs"), file("again"))).code, 0);
  const BenchAnswer slow = bench(fmt::format("compare {} {} --fail-above 1e-3", file("runs"), file("again")));
  EXPECT_EQ(slow.code, 1) << slow.out;
  EXPECT_NE(slow.out.find("2 of 3 runs"), std::string::npos) << slow.out;
  for (const std::string wrong : {"--fail-above 0", "--fail-above x"})
    EXPECT_EQ(bench(fmt::format("compare {} {} {}", file("runs"), file("again"), wrong)).code, 2);
  EXPECT_EQ(bench(fmt::format("compare {} {}", file("runs"), file("nothing"))).code, 2);
}

TEST_F(Report, DrawsEveryFigureOfAFolderAlone) {
  for (const std::string script : {"settings", "history", "inertia", "published"}) {
    const std::string png = file(script + ".png");
    const BenchAnswer a = plot(script, fmt::format("{} -o {}", file("runs/tiny"), png));
    EXPECT_EQ(a.code, 0) << a.out;
    EXPECT_EQ(content_of(png).substr(0, 8), "\x89PNG\r\n\x1a\n") << script;
    EXPECT_GT(fs::file_size(png), 10'000u) << script << ": hardly anything drawn";
  }
}

TEST_F(Report, FiguresRefuseFoldersWithoutRecordsInOneLine) {
  fs::create_directories(folder_ / "empty");
  for (const std::string script : {"settings", "history", "inertia", "published", "speedup"}) {
    const BenchAnswer a = plot(script, fmt::format("{} -o {}", file("empty"), file("empty.png")));
    EXPECT_EQ(a.code, 2) << a.out;
    EXPECT_EQ(std::ranges::count(a.out, '\n'), 1) << a.out;
    EXPECT_NE(a.out.find("no records"), std::string::npos) << a.out;
  }
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
