#include "body/models/debian_meshes.hpp"

#include <archive.h>
#include <archive_entry.h>
#include <fmt/format.h>

#include <memory>

#include "error.hpp"
#include "mesh/io/read_off.hpp"

namespace kreisel::core {
namespace {

using Reader = std::unique_ptr<archive, decltype(&archive_read_free)>;

[[noreturn]] void fail(const std::filesystem::path& path, std::string_view what) {
  throw InputError(
      fmt::format("{}: {}; expected the archive of Debian's package libcgal-demo "
                  "(apt install --reinstall libcgal-demo)",
                  path.string(), what));
}

Reader open(const std::filesystem::path& path) {
  Reader reader(archive_read_new(), &archive_read_free);
  archive_read_support_filter_all(reader.get());
  archive_read_support_format_tar(reader.get());
  if (archive_read_open_filename(reader.get(), path.c_str(), 1 << 16) != ARCHIVE_OK)
    fail(path, archive_error_string(reader.get()));
  return reader;
}

/// The bytes of one entry; stops reading there.
std::string extract(const std::filesystem::path& path, const std::string& wanted) {
  const Reader reader = open(path);
  archive_entry* entry = nullptr;
  int status = ARCHIVE_OK;
  while ((status = archive_read_next_header(reader.get(), &entry)) == ARCHIVE_OK) {
    if (archive_entry_pathname(entry) != wanted) continue;
    std::string bytes(std::size_t(archive_entry_size(entry)), '\0');
    const la_ssize_t got = archive_read_data(reader.get(), bytes.data(), bytes.size());
    if (got < 0) fail(path, archive_error_string(reader.get()));
    if (std::size_t(got) != bytes.size()) fail(path, fmt::format("'{}' is cut off", wanted));
    return bytes;
  }
  if (status != ARCHIVE_EOF) fail(path, archive_error_string(reader.get()));
  fail(path, fmt::format("no entry '{}'", wanted));
}

}  // namespace

const std::vector<DebianMesh>& debian_meshes() {
  // `up` was found by looking at each.
  static const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  static const std::vector<DebianMesh> all = {
      {"bunny", "bunny00.off", "the Stanford bunny, its base closed", y},
      {"armadillo", "armadillo.off", "the Stanford armadillo", y},
      {"elephant", "elephant.off", "elephant with raised trunk, three holes through it", y},
      {"dino", "dino.off", "dinosaur on two legs", z},
      {"triceratops", "triceratops.off", "triceratops", y},
      {"diplodocus", "diplodocus.off", "long-necked dinosaur; some triangles cross", y},
      {"bear", "bear.off", "sitting teddy bear", y},
      {"walking-bear", "bear_bis.off", "teddy bear on one leg", y},
      {"bull", "bull.off", "charging bull; some triangles cross", y},
      {"cow", "cow.off", "cow; some triangles cross", y},
      {"camel", "camel.off", "camel; some triangles cross", y},
      {"homer", "homer.off", "a stout man in cartoon proportions", y},
      {"man", "man.off", "standing man; many triangles cross", z},
      {"elk", "elk.off", "elk on four balls, a toy with a handle; some triangles cross", y},
      {"hand", "hand.off", "fist on its wrist", z},
      {"helmet", "helmet.off", "motorcycle helmet, filled", z},
      {"cactus", "cactus.off", "cactus with two arms", y},
      {"femur", "femur.off", "upper end of a thigh bone", -z},
      {"knot1", "knot1.off", "round trefoil knot", z},
      {"knot2", "knot2.off", "two linked rings of rope: two pieces", z},
      {"cheese", "cheese.off", "cube drilled in every direction, genus 133", z},
      {"turbine", "turbine.off", "flared pipe with a flange of many bolt holes", -x},
      {"couplingdown", "couplingdown.off", "flat coupling with bolt holes", z},
      {"anchor", "anchor_dense.off", "bracket with a slanted bore", z},
      {"spool", "spool.off", "spool", x},
      {"fandisk", "fandisk_large.off", "mechanical part with sharp edges", z},
      {"retinal", "retinal.off", "surface of a molecule of retinal", z},
      {"blobby", "blobby.off", "smooth blob", z},
      {"handle", "handle.off", "rounded grip", z},
      {"oblong", "oblong.off", "machined block", z},
  };
  return all;
}

const DebianMesh* find_debian_mesh(std::string_view name) {
  for (const DebianMesh& mesh : debian_meshes())
    if (mesh.name == name) return &mesh;
  return nullptr;
}

std::filesystem::path debian_archive() { return "/usr/share/doc/libcgal-dev/data.tar.gz"; }

bool debian_meshes_installed() { return std::filesystem::exists(debian_archive()); }

TriangleMesh read_debian_mesh(const DebianMesh& mesh, const std::filesystem::path& archive) {
  if (!std::filesystem::exists(archive))
    throw InputError(
        fmt::format("model '{}' comes with Debian's package libcgal-demo, and {} is not there; expected the "
                    "package to be installed (apt install libcgal-demo)",
                    mesh.name, archive.string()));
  const std::string entry = fmt::format("data/meshes/{}", mesh.file);
  return read_off({fmt::format("{}:{}", archive.string(), entry), extract(archive, entry)}).mesh;
}

}  // namespace kreisel::core
