#include "design/moulds.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "fabricate/verify.hpp"
#include "file/beside.hpp"
#include "mesh/solid/check.hpp"

namespace kreisel::core {

std::vector<MaterialPart> cast_of(const std::vector<MaterialPart>& parts, double shell_density,
                                  double least) {
  std::vector<MaterialPart> cast;
  for (const MaterialPart& part : parts) {
    if (!(part.density > shell_density)) continue;
    for (TriangleMesh& solid : castings_of(part, least))
      cast.push_back({part.name, part.density, {std::move(solid)}});
  }
  return cast;
}

std::vector<WrittenMould> write_moulds(const std::filesystem::path& file,
                                       const std::vector<MaterialPart>& cast) {
  std::vector<WrittenMould> moulds;
  for (const MaterialPart& solid : cast) {
    const auto alike = std::ranges::count(cast, solid.name, &MaterialPart::name);
    const auto before = std::ranges::count(moulds, solid.name, &WrittenMould::of);
    const std::string number = alike > 1 ? fmt::format("-{}", before + 1) : "";
    const std::filesystem::path path = beside(file, fmt::format("{}-mould{}", solid.name, number));
    WrittenMould written{solid.name, solid.density, mould_of(solid.surfaces.front()), {}};
    WrittenReader reader;
    for (WrittenMaterial& part : write_parts(path, written.mould.parts)) {
      require_solid(reader.next(part), part.file.filename().string());
      if (written.files.empty() || written.files.back() != part.file) written.files.push_back(part.file);
    }
    moulds.push_back(std::move(written));
  }
  return moulds;
}

}  // namespace kreisel::core
