#include "record/from_hdf5.hpp"

namespace kreisel::core::fields {

const hdf5::Group& FromHdf5::at_group(std::string_view path) {
  if (path.empty()) return root_;
  if (const auto known = groups_.find(path); known != groups_.end()) return known->second;
  return groups_.emplace(std::string(path), root_.group(std::string(path))).first->second;
}

std::pair<const hdf5::Group&, std::string> FromHdf5::at(std::string_view file) {
  const std::size_t slash = file.rfind('/');
  if (slash == file.npos) return {root_, std::string(file)};
  return {at_group(file.substr(0, slash)), std::string(file.substr(slash + 1))};
}

bool FromHdf5::there(std::string_view file) {
  for (std::size_t slash = file.find('/'); slash != file.npos; slash = file.find('/', slash + 1)) {
    const std::string_view group = file.substr(0, slash);
    if (!groups_.contains(group) && !root_.contains(std::string(group))) return false;
  }
  const auto [group, name] = at(file);
  return group.has(name) || group.contains(name);
}

}  // namespace kreisel::core::fields
