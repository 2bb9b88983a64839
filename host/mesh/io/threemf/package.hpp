// package.hpp - the files of a 3MF package that say something of its shape.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "mesh/io/mesh_file.hpp"

namespace kreisel::core::threemf {

/// Contents by name within the package, as part_name() writes it: models, relations and settings of slicers;
/// pictures are left packed.
using Package = std::map<std::string, std::string>;

/// A name as all of its spellings have it: small letters, no slash in front, no backslashes.
[[nodiscard]] std::string part_name(std::string_view name);

/// @throws InputError  no ZIP archive, or a broken or encrypted one, or more than 4 GiB of text in it
[[nodiscard]] Package unpack(const MeshFile& file);

/// The bytes of a package with these parts, in their order; the same every time. @param parts  name, content
[[nodiscard]] std::string pack(const std::vector<std::pair<std::string, std::string>>& parts);

}  // namespace kreisel::core::threemf
