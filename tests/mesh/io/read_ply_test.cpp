#include "mesh/io/read_ply.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "mesh/mesh_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

class ReadPly : public MeshFolder {};

const std::string coordinates = "property double x\nproperty double y\nproperty double z\n";
const std::string corners = "property list uchar int vertex_indices\n";
const std::string ascii_header = "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 4\n" +
                                 coordinates + "element face 1\n" + corners + "end_header\n";
const std::string ascii_body = "0.12345678901234567 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";
const std::vector<Triangle> fan = {{0, 1, 2}, {0, 2, 3}};

/// The bytes of a number, in the order asked for.
template <class T>
std::string bytes(T value, bool big) {
  std::string s(reinterpret_cast<const char*>(&value), sizeof value);
  if (big) std::reverse(s.begin(), s.end());
  return s;
}

/// One triangle (0 0 0) (1.5 0 0) (0 -2 0) with a number type for coordinates, list length and index.
template <class Coordinate, class Length, class Index>
std::string binary(const std::string& c, const std::string& l, const std::string& i, bool big) {
  std::string s = "ply\nformat " + std::string(big ? "binary_big_endian" : "binary_little_endian") +
                  " 1.0\nelement vertex 3\nproperty " + c + " x\nproperty uchar red\nproperty " + c +
                  " y\nproperty " + c + " z\nelement face 1\nproperty list " + l + " " + i +
                  " vertex_index\nproperty float quality\nend_header\n";
  const double points[3][3] = {{0, 0, 0}, {1.5, 0, 0}, {0, -2, 0}};
  for (const auto& p : points)
    s += bytes(Coordinate(p[0]), big) + "R" + bytes(Coordinate(p[1]), big) + bytes(Coordinate(p[2]), big);
  s += bytes(Length(3), big);
  for (const int index : {2, 0, 1}) s += bytes(Index(index), big);
  return s + bytes(0.5f, big);
}

TEST_F(ReadPly, KeepsEveryDigitOfTextAndCutsPolygonsIntoFans) {
  const TriangleMesh mesh = read("a.ply", ascii_header + ascii_body);
  ASSERT_EQ(mesh.vertices.size(), 4u);
  EXPECT_EQ(mesh.vertices[0].x(), 0.12345678901234567);
  EXPECT_EQ(mesh.triangles, fan);
}

TEST_F(ReadPly, TakesWindowsLineEnds) {
  std::string text = ascii_header + ascii_body;
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.insert(at, "\r");
  EXPECT_EQ(read("a.ply", text).triangles, fan);
}

TEST_F(ReadPly, PassesOverOtherElementsAndProperties) {
  const TriangleMesh mesh = read(
      "a.ply",
      "ply\nformat ascii 1.0\nobj_info none\nelement material 1\nproperty list uchar int a\n"
      "property float shine\nelement vertex 3\nproperty float nx\n" +
          coordinates + "property list int float weights\nelement face 1\nproperty uchar flag\n" + corners +
          "element edge 1\nproperty int vertex1\nend_header\n"
          "2 7 7 0.5\n9 0 0 0 0\n9 1 0 0 2 0.5 0.5\n9 0 1 0 0\n1 3 0 1 2\n5\n");
  EXPECT_EQ(mesh.vertices, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}));
}

TEST_F(ReadPly, TakesBothByteOrdersAndEveryNumberType) {
  for (const bool big : {false, true}) {
    std::vector<std::string> files = {
        binary<double, std::uint8_t, std::int32_t>("double", "uchar", "int", big),
        binary<float, std::int8_t, std::uint32_t>("float", "char", "uint", big),
        binary<double, std::uint16_t, std::int8_t>("float64", "uint16", "int8", big),
        binary<float, std::int16_t, std::uint16_t>("float32", "short", "ushort", big),
        binary<double, std::uint32_t, std::int16_t>("double", "uint32", "int16", big),
        binary<double, std::int32_t, std::uint8_t>("double", "int", "uint8", big)};
    for (const std::string& content : files) {
      const TriangleMesh mesh = read("a.ply", content);
      EXPECT_EQ(mesh.vertices, (std::vector<Vec3>{{0, 0, 0}, {1.5, 0, 0}, {0, -2, 0}}));
      EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{2, 0, 1}}));
    }
  }
}

TEST_F(ReadPly, RefusesEveryTruncation) {
  for (const std::string& whole : {ascii_header + ascii_body, binary<double, std::uint8_t, std::int32_t>(
                                                                  "double", "uchar", "int", false)})
    for (std::size_t length = 1; length < whole.size() - 2;
         ++length)  // the last digit may go unnoticed in text
      EXPECT_THROW((void)read("a.ply", whole.substr(0, length)), InputError) << length;
}

TEST_F(ReadPly, SaysWhereItBreaks) {
  const auto with = [&](const std::string& body) { return file("a.ply", ascii_header + body); };
  refuses(with("0 0 0\n1 0 0\n"), {"vertex 3", "ends here", "expected 4"});
  refuses(with("0 0 0\n1 0 0\n1 1 0\n0 1 0\n"), {"face 1", "ends here"});
  refuses(with("0 0 0\n1 nan 0\n1 1 0\n0 1 0\n4 0 1 2 3\n"), {"vertex 2", "finite", "nan"});
  refuses(with("0 0 0\n1 0 0\n1 1 inf\n0 1 0\n4 0 1 2 3\n"), {"vertex 3", "finite", "inf"});
  refuses(with("0 0 0\n1 zero 0\n1 1 0\n0 1 0\n4 0 1 2 3\n"), {"vertex 2", "'zero'", "a finite number"});
  refuses(with("0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 4\n"), {"face 1", "index 4", "0 to 3"});
  refuses(with("0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 -1\n"), {"face 1", "index -1"});
  refuses(with("0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 2.5\n"), {"face 1", "index 2.5"});
  refuses(with("0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 0 1\n"), {"face 1", "2 corners"});
  refuses(with("0 0 0\n1 0 0\n1 1 0\n0 1 0\n-3 0 1 2\n"), {"face 1", "length -3"});
  refuses(with(ascii_body + "7\n"), {"'7'", "end of the file"});
  refuses(file("b.ply", binary<float, std::uint8_t, int>("float", "uchar", "int", false) + "12345"),
          {"5 bytes", "end of the file"});
}

TEST_F(ReadPly, SaysWhatIsWrongWithAHeader) {
  refuses(file("a.ply", "solid none\nendsolid\n"), {"'ply'"});
  refuses(file("b.ply", "ply\nformat ascii 1.0\nelement vertex 3\n"), {"line 4", "end_header"});
  refuses(file("c.ply", "ply\nformat binary 1.0\nend_header\n"), {"line 2", "'binary'"});
  refuses(file("d.ply", "ply\nformat ascii 1.0\nelement vertex many\nend_header\n"), {"line 3", "'many'"});
  refuses(file("e.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty real x\nend_header\n"),
          {"line 4", "'real'"});
  refuses(file("f.ply", "ply\nformat ascii 1.0\nproperty float x\nend_header\n"), {"line 3", "element"});
  refuses(file("g.ply", "ply\nformat ascii 1.0\nelement vertex 3\n" + coordinates + "end_header\n"),
          {"'face'"});
  refuses(file("h.ply",
               "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float z\n"
               "element face 1\n" +
                   corners + "end_header\n"),
          {"'y'"});
  refuses(file("i.ply", "ply\nformat ascii 1.0\nelement vertex 3\n" + coordinates +
                            "element face 1\nproperty int corners\nend_header\n"),
          {"vertex_indices"});
  refuses(file("j.ply", "ply\nelement vertex 3\n" + coordinates + "end_header\n"), {"'format'"});
  refuses(file("k.ply", "ply\nformat ascii 1.0\nelement none 999999999999999999\nelement vertex 3\n" +
                            coordinates + "element face 1\n" + corners + "end_header\n"),
          {"'none'", "no property"});
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
