// settings.hpp - what slicers say of the parts of a 3MF package beside its models.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "mesh/io/threemf/package.hpp"

namespace kreisel::core::threemf {

/// What a part is that is no material, in words ("support blocker"); empty for material.
using Role = std::string;
inline const Role negative_volume = "negative volume";

/// Triangles of a mesh that have a role, from `first` to `last`.
struct RoleRange {
  std::size_t first, last;
  Role role;
};

/// By the object of the root model, by its number.
struct SlicerSettings {
  std::map<std::string, std::vector<RoleRange>> ranges;  ///< PrusaSlicer
  std::map<std::string, std::map<std::string, Role>>
      components;  ///< BambuStudio: by the object each one is of

  /// Of a component of an object.
  [[nodiscard]] Role of_component(const std::string& object, const std::string& part) const;
};

/// Of PrusaSlicer and its kin (Metadata/*_model.config), and of BambuStudio and OrcaSlicer
/// (Metadata/model_settings.config).
/// @throws InputError  not well-formed; a kind of volume that is not known, says which
[[nodiscard]] SlicerSettings slicer_settings(const Package& package, const std::string& file);

/// What the setting `key` of Cura makes of an object, where it is on: "support mesh" and the like.
[[nodiscard]] Role cura_role(std::string_view key, std::string_view value);

}  // namespace kreisel::core::threemf
