// columns_test.cpp - values of columns as programs read them, and the page that lists the columns.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "apps/run_bench.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

TEST(BenchColumns, AreThePageThatListsThem) {
  std::ifstream file(std::string(source_folder) + "/docs/tables.md");
  const std::string page((std::istreambuf_iterator<char>(file)), {});
  const BenchAnswer a = bench("columns --markdown");
  ASSERT_EQ(a.code, 0) << a.out;
  EXPECT_NE(page.find(a.out), std::string::npos) << "write `bench columns --markdown` into docs/tables.md";
}

TEST(BenchColumns, GiveTheValuesOfEachRecord) {
  const TemporaryFolder folder;
  const std::string at = folder.path.string();
  for (const char* cells : {"16", "20"})
    ASSERT_EQ(
        bench(fmt::format("--formulation quadric --wall 2% --part none --resolution {0} --record {1}/{0}.h5",
                          cells, at))
            .code,
        0);
  const BenchAnswer a =
      bench(fmt::format("show '{}' --columns 'model,grid,seconds,converged,asked.wall,2 * "
                        "variables,ratio(rays, resolution=16)' --json -",
                        at));
  ASSERT_EQ(a.code, 0) << a.out;
  const auto rows = nlohmann::json::parse(a.out);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[1].at("path"), at + "/20.h5");
  EXPECT_EQ(rows[1].at("model"), "ellipsoid");
  EXPECT_EQ(rows[1].at("grid"), "20x14x13");
  EXPECT_GT(rows[1].at("seconds").get<double>(), 0);
  EXPECT_EQ(rows[1].at("converged"), true);
  EXPECT_EQ(rows[1].at("asked.wall"), "2%");
  EXPECT_EQ(rows[1].at("2 * variables"), 20);
  const BenchAnswer table = bench(fmt::format("show '{}' --columns grid,variables", at));
  EXPECT_NE(table.out.find("20x14x13"), std::string::npos) << table.out;
  EXPECT_EQ(bench(fmt::format("show '{}' --columns 'rays +'", at)).code, 2);
  EXPECT_EQ(bench(fmt::format("show '{}' --json -", at)).code, 2);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
