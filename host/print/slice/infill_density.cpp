#include "print/slice/infill_density.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "device/program.hpp"
#include "error.hpp"
#include "file/write_text.hpp"

namespace kreisel::core {
namespace {

namespace fs = std::filesystem;

constexpr std::array<double, 3> edges = {16, 32, 48};  // mm, of cores; each in some layers of what is full
constexpr double around = 4;

TriangleMesh cube(const Vec3& middle, double edge) {
  TriangleMesh mesh;
  for (int corner = 0; corner < 8; ++corner)
    mesh.vertices.push_back(middle +
                            edge / 2 * Vec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1));
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {1, 3, 7}, {1, 7, 5}, {3, 2, 6}, {3, 6, 7}, {2, 0, 4}, {2, 4, 6}};
  return mesh;
}

/// Share against surface over volume, by least squares.
void fit(InfillDensity& density) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (const InfillBlock& block : density.blocks) {
    const double x = 6 / block.edge;
    n += 1;
    sx += x;
    sy += block.share;
    sxx += x * x;
    sxy += x * block.share;
  }
  density.skin = (n * sxy - sx * sy) / (n * sxx - sx * sx);
  density.bulk = (sy - density.skin * sx) / n;
}

/// FNV-1a, 64 bits.
std::uint64_t hash(std::string_view text) {
  std::uint64_t h = 0xcbf29ce484222325ull;
  for (const char c : text) h = (h ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
  return h;
}

constexpr const char* ends = "whole";  // what was cut off lacks it

/// The whole key, then an edge and a share a line. Nothing: not there, or of another key.
std::vector<InfillBlock> remembered(const fs::path& file, const std::string& key) {
  std::ifstream in(file, std::ios::binary);
  std::string seen(key.size(), '\0');
  std::vector<InfillBlock> blocks;
  if (!in.read(seen.data(), std::streamsize(seen.size())) || seen != key) return blocks;
  InfillBlock block;
  while (in >> block.edge >> block.share) blocks.push_back(block);
  in.clear();
  std::string last;
  if (blocks.size() != edges.size() || !(in >> last) || last != ends) blocks.clear();
  return blocks;
}

/// Best effort: a cache that cannot be written only costs time.
void remember(const fs::path& file, const std::string& key, const std::vector<InfillBlock>& blocks) {
  std::string text = key;
  for (const InfillBlock& block : blocks) text += fmt::format("{} {}\n", block.edge, block.share);
  try {
    write_text(file, text + ends);
  } catch (const InputError&) {
  }
}

}  // namespace

InfillDensity measure_infill(const SliceSpec& spec, const Control& control) {
  const MeshSlicer slice(spec);
  const Infill infill = spec.infill.value();
  const auto print = [&](double edge, double core) {
    Filled block{cube(Vec3::Zero(), edge), {}};
    if (core > 0) block.sparse = cube(Vec3::Zero(), core);
    return slice(block, Vec3::UnitZ(), 1.0, control).print;
  };
  InfillDensity density;
  control.tell("measure the infill");
  const double least = edges[0] + 2 * around;
  const Print first = print(least, 0);  // also says what version it is
  density.slicer = first.slicer;
  const std::string key =
      fmt::format("kreisel infill 1\n{}\n{}\n{}\n", to_string(infill), first.slicer, slice.identity());
  const fs::path file = device::cache_folder() / "infill" / fmt::format("{:016x}.txt", hash(key));
  density.blocks = remembered(file, key);
  density.remembered = !density.blocks.empty();
  for (std::size_t k = 0; !density.remembered && k < edges.size(); ++k) {
    const double edge = edges[k], volume = edge * edge * edge;
    const double full = k == 0 ? first.part_volume() : print(edge + 2 * around, 0).part_volume();
    const double cored = print(edge + 2 * around, edge).part_volume();
    density.blocks.push_back({edge, 1 - (full - cored) / volume});
  }
  fit(density);
  if (!(density.bulk > 0) || !(density.share(edges[0], 6) < 1))
    throw InputError(fmt::format(
        "--infill {} by {}: its test blocks hold {:.3g} of what is full, expected between 0 and 1: "
        "does the slicer open the project that it is given?",
        to_string(infill), spec.slicer, density.bulk));
  if (!density.remembered) remember(file, key, density.blocks);
  return density;
}

}  // namespace kreisel::core
