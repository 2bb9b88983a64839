#include "record/to_hdf5.hpp"

#include "body/moments.hpp"

namespace kreisel::core::fields {

hdf5::Group& ToHdf5::at_group(std::string_view path) {
  if (path.empty()) return root_;
  if (const auto known = groups_.find(path); known != groups_.end()) return known->second;
  const std::size_t slash = path.rfind('/');
  hdf5::Group& parent = at_group(slash == path.npos ? std::string_view() : path.substr(0, slash));
  const std::string name(path.substr(slash == path.npos ? 0 : slash + 1));
  return groups_.emplace(std::string(path), parent.new_group(name)).first->second;
}

std::pair<hdf5::Group*, std::string> ToHdf5::at(std::string_view file) {
  const std::size_t slash = file.rfind('/');
  if (slash == file.npos) return {&root_, std::string(file)};
  return {&at_group(file.substr(0, slash)), std::string(file.substr(slash + 1))};
}

void ToHdf5::write_matrix(hdf5::Group& group, const std::string& name, const std::vector<double>& values,
                          Eigen::Index rows, Eigen::Index columns, const char* units) {
  static const std::vector<std::string> axes = {"x", "y", "z", "shift"};
  const auto n = static_cast<std::size_t>(rows), m = static_cast<std::size_t>(columns);
  std::vector<std::string> labels;
  if (columns == 1 && n == moment_names.size())
    labels.assign(moment_names.begin(), moment_names.end());
  else
    labels.assign(axes.begin(), axes.begin() + static_cast<std::ptrdiff_t>(columns == 1 ? n : m));
  group.write(name, values, columns == 1 ? hdf5::Shape{n} : hdf5::Shape{n, m}, {units, labels});
}

}  // namespace kreisel::core::fields
