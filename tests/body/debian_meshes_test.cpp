#include "body/models/debian_meshes.hpp"

#include <archive.h>
#include <archive_entry.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include "body/models.hpp"
#include "error.hpp"
#include "installed.hpp"
#include "mesh/solid/check.hpp"

namespace kreisel::core {
namespace THIS_FILE {

const DebianMesh tetrahedron{"tetrahedron", "tetra.off", "for this test"};
const std::string tetrahedron_off =
    "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";

class DebianArchive : public ::testing::Test {
 protected:
  /// A tar.gz with the given name and bytes after another entry.
  void write(const std::string& name, const std::string& bytes) {
    archive* out = archive_write_new();
    archive_write_add_filter_gzip(out);
    archive_write_set_format_ustar(out);
    ASSERT_EQ(archive_write_open_filename(out, path_.c_str()), ARCHIVE_OK);
    for (const auto& [entry_name, content] : {std::pair<std::string, std::string>{"data/README", "meshes"},
                                              std::pair<std::string, std::string>{name, bytes}}) {
      archive_entry* entry = archive_entry_new();
      archive_entry_set_pathname(entry, entry_name.c_str());
      archive_entry_set_size(entry, la_int64_t(content.size()));
      archive_entry_set_filetype(entry, AE_IFREG);
      archive_entry_set_perm(entry, 0644);
      archive_write_header(out, entry);
      archive_write_data(out, content.data(), content.size());
      archive_entry_free(entry);
    }
    archive_write_free(out);
  }

  void refuses(const std::string& part) {
    try {
      (void)read_debian_mesh(tetrahedron, path_);
      FAIL() << "no error; expected one with: " << part;
    } catch (const InputError& error) {
      const std::string what = error.what();
      EXPECT_NE(what.find(part), std::string::npos) << what;
      EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    }
  }

  void TearDown() override { std::filesystem::remove(path_); }

  std::string path_ =
      (std::filesystem::path(::testing::TempDir()) /
       ("meshes_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) + ".tar.gz"))
          .string();
};

TEST_F(DebianArchive, GivesAMeshAsItIsInItsFile) {
  write("data/meshes/tetra.off", tetrahedron_off);
  const TriangleMesh mesh = read_debian_mesh(tetrahedron, path_);
  EXPECT_EQ(mesh.vertices.size(), 4u);
  EXPECT_NO_THROW(require_solid(mesh, "tetrahedron"));
}

TEST_F(DebianArchive, ThatIsNotThereSaysWhatToInstall) { refuses("apt install libcgal-demo"); }

TEST_F(DebianArchive, WithoutTheMeshSaysWhichIsMissing) {
  write("data/meshes/other.off", tetrahedron_off);
  refuses("no entry 'data/meshes/tetra.off'");
}

TEST_F(DebianArchive, ThatIsCutOffIsRefused) {
  std::string bytes = tetrahedron_off;
  for (int i = 0; i < 40000; ++i)
    bytes += "# " + std::to_string(i * 7919 % 65537) + "\n";  // beyond one block
  write("data/meshes/tetra.off", bytes);
  std::filesystem::resize_file(path_, std::filesystem::file_size(path_) / 2);
  refuses("expected the archive");
}

TEST_F(DebianArchive, ThatIsNoneIsRefused) {
  std::ofstream(path_) << "not an archive";
  refuses("expected the archive");
}

TEST_F(DebianArchive, NamesTheMeshWithAFaultyLine) {
  write("data/meshes/tetra.off", "OFF\n4 4 0\n0 0 zero\n");
  refuses("data/meshes/tetra.off: line 3");
}

TEST(DebianMeshes, HaveNamesOfTheirOwn) {
  std::set<std::string_view> names;
  for (const Model& m : models()) names.insert(m.name);
  for (const DebianMesh& m : debian_meshes()) {
    EXPECT_TRUE(names.insert(m.name).second) << m.name;
    EXPECT_EQ(find_debian_mesh(m.name), &m);
  }
  EXPECT_EQ(find_debian_mesh("nosuch"), nullptr);
}

TEST(DebianMeshes, AreAllSolids) {
  KREISEL_NEEDS(debian_meshes_installed(), "libcgal-demo");
  for (const DebianMesh& m : debian_meshes())
    EXPECT_NO_THROW(require_solid(read_debian_mesh(m), m.name)) << m.name;
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
