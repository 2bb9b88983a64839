// The same little solid in every way in which people's files say it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "mesh/io/text.hpp"
#include "mesh/mesh_folder.hpp"
#include "mesh/solid/check.hpp"

namespace kreisel::core {
namespace THIS_FILE {

class Dialects : public MeshFolder {
 protected:
  /// The file is the tetrahedron of volume 1 with legs 1, 2 and 3.
  void is_tetrahedron(const std::string& name, const std::string& bytes) const {
    const TriangleMesh mesh = read(name, bytes);
    EXPECT_EQ(mesh.vertices.size(), 4u) << bytes;
    EXPECT_TRUE(inspect(mesh).watertight()) << bytes;
    EXPECT_DOUBLE_EQ(inspect(mesh).volume, 1) << bytes;
  }

  std::vector<std::string> notes(const std::string& name, const std::string& bytes) const {
    return read_mesh_file(file(name, bytes)).notes;
  }
};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

const std::string bom = "\xef\xbb\xbf";
const std::string corners = "0 0 0\n1 0 0\n0 2 0\n0 0 3\n", faces = "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
const std::string off = "OFF\n4 4 6\n" + corners + faces;
const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
const std::string ply =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 4\nproperty list uchar int vertex_indices\nend_header\n" +
    corners + faces;

std::string facet(const std::string& a, const std::string& b, const std::string& c) {
  return "facet normal 0 0 0\n outer loop\n  vertex " + a + "\n  vertex " + b + "\n  vertex " + c +
         "\n endloop\nendfacet\n";
}
const std::string o = "0 0 0", x = "1 0 0", y = "0 2 0", z = "0 0 3";
const std::string stl = "solid a part\n" + facet(o, y, x) + facet(o, x, z) + facet(x, y, z) + facet(y, o, z) +
                        "endsolid a part\n";

TEST_F(Dialects, TakeEveryLineEndAndAByteOrderMark) {
  const std::pair<const char*, const std::string*> files[] = {
      {"a.off", &off}, {"a.obj", &obj}, {"a.ply", &ply}, {"a.stl", &stl}};
  for (const auto& [name, text] : files)
    for (const std::string end : {"\n", "\r\n", "\r"}) {
      is_tetrahedron(name, replaced(*text, "\n", end));
      is_tetrahedron(name, bom + replaced(*text, "\n", end));
    }
}

TEST_F(Dialects, AByteOrderMarkCostsNoVertex) {
  // With a vertex more than is used, the loss of the first would go unnoticed.
  const TriangleMesh mesh = read("a.obj", bom + "v 7 7 7\n" +
                                              replaced(replaced(obj, "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4",
                                                                "f 2 4 3\nf 2 3 5\nf 3 4 5\nf 4 2 5"),
                                                       "\n", "\n"));
  EXPECT_EQ(mesh.vertices.size(), 5u);
  EXPECT_EQ(mesh.vertices[0], Vec3(7, 7, 7));
  EXPECT_DOUBLE_EQ(inspect(mesh).volume, 1);
}

TEST_F(Dialects, RefuseUtf16ByItsName) {
  for (const std::string name : {"a.off", "a.obj", "a.ply", "a.stl"})
    for (const bool marked : {true, false})
      for (const bool little : {true, false}) {
        std::string wide = marked ? little ? "\xff\xfe" : "\xfe\xff" : "";
        for (const char c : off) (wide += little ? c : '\0') += little ? '\0' : c;
        refuses(file(name, wide), {"UTF-16", "UTF-8"});
      }
}

TEST_F(Dialects, OffWithAGluedHeaderOrWithoutOne) {
  is_tetrahedron("a.off", "OFF4 4 6\n" + corners + faces);
  is_tetrahedron("a.off", "OFF 4 4 6\n" + corners + faces);
  is_tetrahedron("a.off", "4 4 6\n" + corners + faces);
  is_tetrahedron("a.off", "off\n4 4 6\n" + corners + faces);
  is_tetrahedron("a.off", "# of our own\n\nOFF # the format\n# counts\n4 4 6 # and edges\n\n" + corners +
                              "# faces\n" + faces);
}

TEST_F(Dialects, OffWithCountsOverSeveralLines) {
  is_tetrahedron("a.off", "OFF\n4\n4\n6\n" + corners + faces);
  is_tetrahedron("a.off", "OFF\n4 4\n6\n" + corners + faces);
  is_tetrahedron("a.off", "OFF\n4 4\n" + corners + faces);
  is_tetrahedron("a.off", "OFF4\n4 6\n" + corners + faces);
}

TEST_F(Dialects, OffWithSeveralItemsInALineOrOneInSeveral) {
  is_tetrahedron("a.off", replaced(off, "\n", " "));
  is_tetrahedron("a.off", replaced(off, " ", "\n"));
  is_tetrahedron("a.off", "OFF\n4 4 6\n" + replaced(corners, "\n", " ") + "\n" + faces);
  is_tetrahedron("a.off", "OFF\n4 4 6\n" + corners + replaced(faces, "\n", " ") + "\n");
  is_tetrahedron("a.off", "NOFF\n4 4 6\n" + replaced(corners, "\n", "\n0 0 1\n") + faces);
  is_tetrahedron("a.off", "NOFF 4 4 6 0 0 0 nan nan nan 1 0 0 1 0 0 0 2 0 0 1 0 0 0 3 0 0 1 " +
                              replaced(faces, "\n", " "));
}

TEST_F(Dialects, OffPassesOverEveryKindOfAttribute) {
  const auto with = [&](const std::string& behind) { return replaced(corners, "\n", behind + "\n"); };
  is_tetrahedron("a.off", "COFF\n4 4 6\n" + with(" 255 0 0 255") + faces);
  is_tetrahedron("a.off", "COFF\n4 4 6\n" + with(" 0.5 0.5 0.5") + replaced(faces, "\n", " 1 0 0\n"));
  is_tetrahedron("a.off", "NOFF\n4 4 6\n" + with(" nan nan nan") + faces);
  is_tetrahedron("a.off", "CNOFF\n4 4 6\n" + with(" 0 0 1 255 0 0 255") + faces);
  is_tetrahedron("a.off", "STOFF\n4 4 6\n" + with(" 0.1 0.2") + faces);
  is_tetrahedron("a.off", "STCNOFF\n4 4 6\n" + with(" 0 0 1 255 0 0 255 0.1 0.2") + faces);
  is_tetrahedron("a.off",
                 "OFF\n4 4 6\n" + with(" 200 100 0") + faces);  // colours that the header keeps to itself
}

TEST_F(Dialects, OffOfOtherDimensionsIsRefusedByName) {
  for (const std::string name : {"4OFF", "nOFF", "4nOFF", "C4OFF"})
    refuses(file("a.off", name + "\n4 4 6\n" + corners + faces), {"'" + name + "'", "three coordinates"});
  refuses(file("a.off", "XOFF\n4 4 6\n"), {"'XOFF'"});
}

TEST_F(Dialects, TextStlInAnyCase) {
  std::string capital = stl;
  std::ranges::transform(capital, capital.begin(),
                         [](char c) { return c >= 'a' && c <= 'z' ? char(c - 'a' + 'A') : c; });
  is_tetrahedron("a.stl", capital);
  is_tetrahedron("a.stl", replaced(replaced(stl, "solid", "Solid"), "facet", "Facet"));
}

TEST_F(Dialects, TextStlWithBlanksInItsEnds) {
  is_tetrahedron("a.stl", replaced(stl, "end", "end "));
  is_tetrahedron("a.stl", replaced(stl, "endloop", "END Loop"));
}

TEST_F(Dialects, TextStlOnFewLines) {
  is_tetrahedron(
      "a.stl",
      "solid a\n" +
          replaced(stl.substr(stl.find('\n') + 1, stl.find("endsolid") - stl.find('\n') - 1), "\n", " ") +
          "\nendsolid\n");
}

TEST_F(Dialects, TextStlOfSeveralSolidsWithAnyNames) {
  const std::string two = replaced(stl, "a part", "vertex of a facet") +
                          replaced(replaced(stl, "a part", "endsolid # 7"), "vertex ", "vertex 1e1");
  const TriangleMesh mesh = read("a.stl", two);
  EXPECT_EQ(mesh.triangles.size(), 8u);
  is_tetrahedron("b.stl", replaced(stl, " a part", ""));
  is_tetrahedron("b.stl", "\n" + stl.substr(stl.find("facet"), stl.find("endsolid") - stl.find("facet")));
  is_tetrahedron("c.stl", replaced(stl, "a part", "endloop"));
}

TEST_F(Dialects, NothingOfANormalIsJudged) {
  for (const std::string normal : {"nan nan nan", "-nan(ind) 0 inf", "1,0 0,0 0,0", ""})
    is_tetrahedron("a.stl", replaced(stl, "0 0 0\n outer", normal + "\n outer"));
  is_tetrahedron("b.stl", replaced(stl, "facet normal 0 0 0", "facet"));
}

TEST_F(Dialects, ObjCommentsAreNotContinued) {
  is_tetrahedron("a.obj", "# in C:\\models\\\n" + obj);
  is_tetrahedron("a.obj", replaced(obj, "v 1 0 0\n", "v 1 0 0 # first \\\n"));
}

TEST_F(Dialects, ObjStatementsAreContinued) {
  is_tetrahedron("a.obj", replaced(obj, "v 1 0 0", "v 1 \\\n 0 \\ \n 0"));
  is_tetrahedron("a.obj", replaced(replaced(obj, "f 1 3 2", "f 1 \\\n3 2"), "\n", "\r\n"));
  refuses(file("b.obj", "v 0 \\\n0 0\nv 1 0 zero\n"), {"line 3", "'zero'"});
}

TEST_F(Dialects, ObjCornersHaveEveryForm) {
  is_tetrahedron("a.obj", "vt 0 0\nvn nan nan nan\n" + replaced(obj, "f 1 3 2", "f 1/1/1 3/1/1 2/1/1"));
  is_tetrahedron("a.obj", replaced(obj, "f 1 3 2", "f 1//9 3// 2/"));
  is_tetrahedron("a.obj",
                 replaced(obj, "f 1 2 4\nf 2 3 4\nf 3 1 4", "f -4/-1 -3/-1 -1/-1\nf -3 3 -1\nfo -2 1 -1"));
  is_tetrahedron("a.obj", "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\nv 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\n");
}

TEST_F(Dialects, ObjVerticesHaveColoursAndWeights) {
  is_tetrahedron("a.obj",
                 replaced(replaced(obj, "v 1 0 0", "v 1 0 0 0.5 nan 0.5"), "v 0 2 0", "v 0 2 0 1.0"));
}

TEST_F(Dialects, ObjTellsWhatItPassesOver) {
  EXPECT_TRUE(notes("a.obj", "vt 0 0\nvn 0 0 1\n" + obj).empty());
  const auto told = notes("a.obj", "mtllib a.mtl\no part\ng one\n" + obj +
                                       "g two\nl 1 2 3\nusemtl none\ncstype bezier\ncurv 0 1 1 2\n");
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(
      told[0],
      "passed over 1 of 'cstype', 1 of 'curv', 2 of 'g', 1 of 'l', 1 of 'mtllib', 1 of 'o', 1 of 'usemtl'");
}

TEST_F(Dialects, PlyStripsTurnEverySecondTriangle) {
  const auto with = [](const std::string& strips) {
    return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
           "element tristrips " +
           std::to_string(std::ranges::count(strips, '\n')) +
           "\nproperty list int int vertex_indices\nend_header\n" + corners + strips;
  };
  is_tetrahedron("a.ply", with("6 0 2 1 3 0 2\n"));
  is_tetrahedron("a.ply", with("11 0 2 1 3 -1 0 3 2 -1 -1 0\n"
                               "3 0 1 3\n"));
  is_tetrahedron("a.ply", with("12 0 2 1 -1 0 1 3 -1 1 2 3 0\n"));
  is_tetrahedron("a.ply", with("8 0 2 1 3 0 0 2 3\n"));  // a corner that is repeated makes no triangle
  refuses(file("b.ply", with("4 0 1 2 4\n")), {"tristrips 1", "index 4"});
  refuses(file("c.ply", with("4 0 1 2 -2\n")), {"tristrips 1", "index -2"});
}

TEST_F(Dialects, PlyJudgesNothingThatItDoesNotUse) {
  const std::string with_normals = replaced(
      replaced(ply, "property float z\n",
               "property float z\nproperty float nx\nproperty list uchar float w\n"),
      "end_header\n" + corners, "end_header\n0 0 0 nan 0\n1 0 0 inf 1 -nan\n0 2 0 none 0\n0 0 3 1,5 0\n");
  is_tetrahedron("a.ply", with_normals);
}

TEST_F(Dialects, BinaryPlyBehindAHeaderOfAnyLineEnds) {
  std::string body;
  for (const float v : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 2.f, 0.f, 0.f, 0.f, 3.f})
    body.append(reinterpret_cast<const char*>(&v), sizeof v);
  for (const std::array<std::int32_t, 3>& f : {std::array{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}) {
    body += '\3';
    body.append(reinterpret_cast<const char*>(f.data()), sizeof f);
  }
  const std::string header =
      replaced(ply.substr(0, ply.find("end_header\n") + 11), "ascii", "binary_little_endian");
  for (const std::string end : {"\n", "\r\n", "\r"})
    is_tetrahedron("a.ply", replaced(header, "\n", end) + body);
}

/// What a text of such numbers cannot tell apart.
double weld_of(const std::vector<std::string>& numbers, double largest) {
  Digits digits;
  for (const std::string& number : numbers) digits.see(number, std::stod(number));
  return digits.weld(largest);
}

constexpr double float_step = std::numeric_limits<float>::epsilon();  // at 1
constexpr double double_step = std::numeric_limits<double>::epsilon();

TEST(DigitsOfAFile, SayWhatItCannotTellApart) {
  EXPECT_DOUBLE_EQ(weld_of({"12.345", "0.100", "-7.000"}, 12.345), 1.8e-3);  // three decimals everywhere
  EXPECT_DOUBLE_EQ(weld_of({"1.234567e+01", "5.000000e-17"}, 12.34567), 1.8e-5);
  EXPECT_DOUBLE_EQ(weld_of({"12.3457", "0.333333", "20"}, 20), 1.8e-4);  // six digits, as many programs write
  EXPECT_DOUBLE_EQ(weld_of({"20", "0", "-5e-17"}, 20), 1.8e-4);          // short numbers of one that has six
  EXPECT_DOUBLE_EQ(weld_of({"0.12345678901234", "20"}, 20), 1.8e-12);
  EXPECT_DOUBLE_EQ(weld_of({"0.12345678901234567", "20"}, 20),
                   16 * 4 * double_step);                            // no finer than doubles
  EXPECT_DOUBLE_EQ(weld_of({"0.12", "1.53"}, 1.53), 1.8e-4 * 1.53);  // of inches, say: no round-off
  EXPECT_DOUBLE_EQ(weld_of({"0.123456789", "1"}, 1), 4 * float_step);
  EXPECT_EQ(weld_of({"100000001", "7"}, 100000001), 0);  // whole numbers, and more than floats have
  EXPECT_EQ(weld_of({"0", "0.0"}, 0), 0);
}

TEST(DigitsOfAFile, AreThoseOfFloatsWhereAllAreFloats) {
  EXPECT_EQ(weld_of({"0.10000000149011612", "1"}, 1), 4 * float_step);
  EXPECT_EQ(weld_of({"3", "0.25", "1.50"}, 3), 2 * 4 * float_step);
  Digits single, twice;
  for (const double value : {0.5, double(0.1f)}) single.see(value), twice.see(value);
  twice.see(0.1);
  EXPECT_EQ(single.weld(1.99), 4 * float_step);
  EXPECT_EQ(single.weld(100), 64 * 4 * float_step);
  EXPECT_EQ(twice.weld(1), 4 * double_step);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
