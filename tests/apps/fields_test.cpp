// fields_test.cpp - the page of fields is what the program says.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "apps/run_bench.hpp"

namespace kreisel::core {
namespace THIS_FILE {

TEST(BenchFields, AreThePageThatListsThem) {
  std::ifstream file(std::string(source_folder) + "/docs/fields.md");
  const std::string page((std::istreambuf_iterator<char>(file)), {});
  const BenchAnswer a = bench("fields --markdown");
  ASSERT_EQ(a.code, 0) << a.out;
  EXPECT_NE(page.find(a.out), std::string::npos) << "write `bench fields --markdown` into docs/fields.md";
}

TEST(BenchFields, AreListedByKind) {
  const BenchAnswer a = bench("fields layers");
  EXPECT_EQ(a.code, 0);
  EXPECT_NE(a.out.find("printer-accuracy"), std::string::npos) << a.out;
  EXPECT_EQ(a.out.find("centroid  "), std::string::npos) << a.out;
  const BenchAnswer wrong = bench("fields leyers");
  EXPECT_EQ(wrong.code, 2);
  EXPECT_NE(wrong.out.find("did you mean 'layers'?"), std::string::npos) << wrong.out;
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
