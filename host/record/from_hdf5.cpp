#include "record/from_hdf5.hpp"

namespace kreisel::core::fields {

hdf5::Group FromHdf5::at_group(std::string_view path) const {
  return root_.group(path.empty() ? "." : std::string(path));
}

std::pair<hdf5::Group, std::string> FromHdf5::at(std::string_view file) const {
  const std::size_t slash = file.rfind('/');
  if (slash == file.npos) return {at_group(""), std::string(file)};
  return {at_group(file.substr(0, slash)), std::string(file.substr(slash + 1))};
}

bool FromHdf5::there(std::string_view file) const {
  for (std::size_t slash = file.find('/'); slash != file.npos; slash = file.find('/', slash + 1))
    if (!root_.contains(std::string(file.substr(0, slash)))) return false;
  const auto [group, name] = at(file);
  return group.has(name) || group.contains(name);
}

}  // namespace kreisel::core::fields
