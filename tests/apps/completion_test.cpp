// completion_test.cpp - what shells offer: asked of the programs, and by bash itself.
#include <gtest/gtest.h>

#include <sstream>

#include "apps/run_bench.hpp"
#include "apps/run_design.hpp"
#include "installed.hpp"
#include "places.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

using Words = std::vector<std::string>;

Words lines_of(const BenchAnswer& answer) {
  EXPECT_EQ(answer.code, 0) << answer.out;
  Words lines;
  std::istringstream text(answer.out);
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

/// @param line  of a shell, the last word as far as it is typed
Words offered(const std::string& line) { return lines_of(bench("complete " + line)); }

bool has(const Words& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

TEST(Completion, OffersCommandsAndOptionsOfThatCommandAlone) {
  EXPECT_EQ(offered("comp"), (Words{"compare", "completion"}));
  EXPECT_TRUE(has(offered("''"), "run"));
  const Words options = offered("nest --");
  EXPECT_TRUE(has(options, "--keep-out"));
  EXPECT_FALSE(has(options, "--wall-to"));
  EXPECT_EQ(offered("--wall-"), (Words{"--wall-to"}));
  EXPECT_EQ(offered("complete"), Words());  // what shells call is no command
}

TEST(Completion, OffersWhatAFieldTakes) {
  EXPECT_EQ(offered("--wall-to ''"), (Words{"centres", "corners"}));
  EXPECT_EQ(offered("--model bird --rounding n"), (Words{"nearest"}));
  EXPECT_EQ(offered("--formulation o"), (Words{"octree"}));
  EXPECT_EQ(offered("map bird --through ''"), (Words{"lowest", "centre"}));
  EXPECT_EQ(offered("nest --topology r"), (Words{"ring", "random"}));
  EXPECT_EQ(offered("simulate --contact g"), (Words{"gliding"}));
  EXPECT_EQ(offered("--up ''"), (Words{"auto", "near:", "rest:"}));
  EXPECT_EQ(offered("--set problem.l"),
            (Words{"problem.lambda=", "problem.line=", "problem.load=", "problem.lower="}));
  EXPECT_EQ(offered("fields sw"), (Words{"swarm"}));
  EXPECT_EQ(offered("show x.h5 --columns solid.r"), (Words{"solid.rpm"}));
}

TEST(Completion, OffersFilesWhereAFileIsWanted) {
  EXPECT_EQ(offered("--model ellips"), (Words{"ellipsoid", "/"}));
  EXPECT_EQ(offered("map bir"), (Words{"bird", "/"}));
  EXPECT_EQ(offered("--json ''"), (Words{"/"}));
  EXPECT_EQ(offered("compare a ''"), (Words{"/"}));
  EXPECT_EQ(offered("run rayrep_b"), (Words{"rayrep_bird", "rayrep_bounds", "/"}));
  EXPECT_EQ(offered("report rayrep_bi"), (Words{"rayrep_bird"}));
}

TEST(Completion, ReadsALineAsItsShellSplitsIt) {
  EXPECT_EQ(offered("--wall-to=ce"), (Words{"--wall-to=centres"}));      // zsh, fish
  EXPECT_EQ(offered("--wall-to = ce"), (Words{"centres"}));              // bash
  EXPECT_EQ(offered("map --up near : 0,0,1 bi"), (Words{"bird", "/"}));  // bash
  EXPECT_EQ(offered("nest --removal 0,0,1 0,0,-1 --variant p"), (Words{"peel"}));
}

TEST(Completion, OffersDesignsOwn) {
  const auto design_offers = [](const std::string& line) { return lines_of(design("complete " + line)); };
  EXPECT_EQ(design_offers("st"), (Words{"stand"}));
  EXPECT_EQ(design_offers("spin --through c"), (Words{"centre"}));
  EXPECT_EQ(design_offers("nest bird ell"), (Words{"ellipsoid", "/"}));
}

TEST(Completion, IsPrintedForThreeShells) {
  for (const char* name : {"bash", "zsh", "fish"}) {
    const BenchAnswer script = bench(fmt::format("completion {}", name));
    EXPECT_EQ(script.code, 0);
    EXPECT_NE(script.out.find("bench"), std::string::npos) << script.out;
    EXPECT_EQ(script.out.find("@program@"), std::string::npos) << script.out;
  }
  const BenchAnswer wrong = bench("completion bsh");
  EXPECT_EQ(wrong.code, 2);
  EXPECT_NE(wrong.out.find("did you mean 'bash'?"), std::string::npos) << wrong.out;
}

TEST(Completion, IsWhatBashOffers) {
  KREISEL_NEEDS(installed("bash"), "bash");
  TemporaryFolder folder;
  folder.write("shape.stl", "");
  const auto offers = [&](const std::string& words, int at) {
    return lines_of(shell(
        fmt::format("cd '{}'; bash -c 'source <(\"{}\" completion bash); COMP_WORDS=({}); COMP_CWORD={}; "
                    "_bench \"{}\"; printf \"%s\\n\" \"${{COMPREPLY[@]}}\"'",
                    folder.path.string(), bench_program, words, at, bench_program)));
  };
  EXPECT_EQ(offers("bench --wall-to ce", 2), (Words{"centres"}));
  EXPECT_EQ(offers("bench --wall-to = co", 3), (Words{"corners"}));
  EXPECT_EQ(offers("bench --wall-to =", 2), (Words{"centres", "corners"}));
  EXPECT_EQ(offers("bench --model sh", 2), (Words{"shape.stl"}));
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
