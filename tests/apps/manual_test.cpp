// manual_test.cpp - the programs' pages for man(1): whole, and fit to be read by roff.
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <sstream>

#include "apps/run_bench.hpp"
#include "apps/run_design.hpp"
#include "installed.hpp"
#include "places.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

struct Program {
  std::string name;
  std::function<BenchAnswer(const std::string& line)> ask;
};

class Manual : public testing::TestWithParam<Program> {
 protected:
  static BenchAnswer ask(const std::string& line) { return GetParam().ask(line); }

  /// What a shell is offered.
  static std::vector<std::string> words(const std::string& line) {
    std::vector<std::string> all;
    std::istringstream text(ask("complete " + line).out);
    for (std::string word; std::getline(text, word);) all.push_back(word);
    return all;
  }

  /// As roff has it.
  static std::string escaped(const std::string& word) {
    std::string out;
    for (const char c : word) out += c == '-' ? std::string("\\-") : std::string(1, c);
    return out;
  }
};

TEST_P(Manual, NamesEveryCommandAndOption) {
  const BenchAnswer page = ask("manual");
  ASSERT_EQ(page.code, 0) << page.out;
  EXPECT_EQ(page.out.rfind(".TH ", 0), 0u) << page.out.substr(0, 80);
  std::size_t named = 0;
  const auto names_options = [&](const std::string& section, const std::string& command) {
    for (const std::string& option : words(command + " --")) {
      ++named;
      const std::string typed = escaped(option);
      EXPECT_TRUE(section.find(typed + "\\fR") != std::string::npos ||
                  section.find(typed + ",") != std::string::npos)
          << command << " " << option;
    }
  };
  std::size_t commands = 0;
  for (const std::string& word : words("''")) {
    const std::size_t at = page.out.find(".SS " + GetParam().name + " " + word + "\n");
    if (word.starts_with('-')) continue;
    ++commands;
    ASSERT_NE(at, std::string::npos) << word;
    const std::size_t end = std::min(page.out.find("\n.SS ", at), page.out.find("\n.SH ", at));
    names_options(page.out.substr(at, end - at), word);
  }
  names_options(page.out.substr(0, page.out.find(".SH COMMANDS")), "");
  EXPECT_GT(commands, 5u);
  EXPECT_GT(named, 50u);
  for (const char* code : {"\\fB0\\fR", "\\fB2\\fR", "\\fB5\\fR", "\\fB130\\fR"})
    EXPECT_NE(page.out.find(code, page.out.find(".SH EXIT STATUS")), std::string::npos) << code;
}

TEST_P(Manual, IsReadByRoffWithoutAWarning) {
  KREISEL_NEEDS(installed("groff"), "groff");
  const TemporaryFolder folder;
  const std::string page = (folder.path / "page.1").string();
  std::ofstream(page) << ask("manual").out;
  const BenchAnswer roff = shell(fmt::format("groff -ww -man -Tascii -z '{}'", page));
  EXPECT_EQ(roff.code, 0);
  EXPECT_EQ(roff.out, "");
  const BenchAnswer read = shell(fmt::format("groff -man -Tascii -P-cbou '{}'", page));
  EXPECT_NE(read.out.find("--help"), std::string::npos);
  EXPECT_NE(read.out.find("EXIT STATUS"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Programs, Manual,
                         testing::Values(Program{"bench", [](const auto& line) { return bench(line); }},
                                         Program{"design", [](const auto& line) { return design(line); }}),
                         [](const auto& program) { return program.param.name; });

}  // namespace THIS_FILE
}  // namespace kreisel::core
