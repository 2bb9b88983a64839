#include "mesh/io/read_3mf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>

#include "error.hpp"
#include "mesh/io/encode.hpp"
#include "mesh/io/threemf/model.hpp"
#include "mesh/io/threemf/package.hpp"
#include "mesh/io/threemf/settings.hpp"
#include "mesh/io/threemf/xml.hpp"

namespace kreisel::core {
namespace {

using threemf::Model;
using threemf::Object;
using threemf::Package;
using threemf::Placed;
using threemf::Role;
using threemf::Transform;

/// More than any printer takes; components that multiply each other reach any number from a small file.
constexpr std::size_t most_triangles = 100'000'000;
/// Components of components; more only where they go round in a circle.
constexpr int deepest = 64;

/// The part that the package's own relations call its model.
class RootOfPackage final : public threemf::XmlVisitor {
 public:
  void start(const threemf::Element& e) override {
    if (e.name == "Relationship" && e.get("Type").value_or("").ends_with("/3dmodel") && name.empty())
      name = threemf::part_name(e.get("Target").value_or(""));
  }
  std::string name;
};

class Reader {
 public:
  explicit Reader(const MeshFile& file) : file_(file), package_(threemf::unpack(file)) {
    RootOfPackage root;
    if (const auto relations = package_.find("_rels/.rels"); relations != package_.end())
      threemf::walk_xml(relations->second, fmt::format("{}: 3MF: {}", file.name, relations->first), root);
    root_ = root.name.empty() ? "3d/3dmodel.model" : root.name;
    settings_ = threemf::slicer_settings(package_, file.name);
  }

  /// A mesh for each build item that is material.
  std::vector<TriangleMesh> meshes() {
    std::vector<TriangleMesh> all;
    for (const Placed& item : model(root_).items) {
      mesh_ = {};
      if (!is_left_out(item.role)) add(item, root_, Transform::Identity(), 0);
      if (!mesh_.triangles.empty()) all.push_back(std::move(mesh_));
    }
    return all;
  }

  [[nodiscard]] std::vector<std::string> notes() const {
    std::vector<std::string> lines;
    for (const auto& [role, count] : left_out_)
      lines.push_back(fmt::format("left out what is no material: {}{}", role,
                                  count > 1 ? fmt::format(" ({} times)", count) : ""));
    for (const auto& [element, count] : passed_over_)
      lines.push_back(fmt::format("passed over {} of '{}', which an extension of 3MF adds", count, element));
    return lines;
  }

  /// What the digits cannot tell apart, mm.
  [[nodiscard]] double weld() const { return weld_; }

 private:
  [[nodiscard]] InputError error(const std::string& what) const {
    return InputError(fmt::format("{}: 3MF: {}", file_.name, what));
  }

  const Model& model(const std::string& name) {
    if (const auto known = models_.find(name); known != models_.end()) return known->second;
    const auto part = package_.find(name);
    if (part == package_.end())
      throw error(fmt::format("no part '{}' in the package, expected a model", shown(name)));
    return models_
        .emplace(name, threemf::read_model(part->second, fmt::format("{}: 3MF: {}", file_.name, name)))
        .first->second;
  }

  /// Whether what has this role is no material; then it is counted.
  bool is_left_out(const Role& role) {
    if (role == threemf::negative_volume)
      throw error(
          "a negative volume, which is not subtracted here, expected a part from which it has been cut "
          "already");
    if (!role.empty()) ++left_out_[role];
    return !role.empty();
  }

  /// The object at its place, in the frame that `outer` (in mm) lays. @param part  the model that says so
  void add(const Placed& placed, const std::string& part, const Transform& outer, int depth) {
    const std::string& home = placed.path.empty() ? part : placed.path;
    const Model& there = model(home);
    const auto found = there.objects.find(placed.object);
    if (found == there.objects.end())
      throw error(fmt::format("Object {} is not in '{}', expected one that is", shown(placed.object), home));
    if (depth > deepest)
      throw error(fmt::format("Object {} has components within components {} deep, expected fewer",
                              shown(placed.object), depth));
    const Object& object = found->second;
    if (is_left_out(object.role)) return;
    for (const auto& [element, count] : object.passed_over) passed_over_[element] += count;
    Transform inner = placed.transform;
    inner.translation() *= model(part).millimetres;
    const Transform transform = outer * inner;
    add_mesh(object, placed.object, home, transform * Eigen::Scaling(there.millimetres));
    for (const Placed& component : object.components) {
      require_few(1);
      const Role role = home == root_ ? settings_.of_component(placed.object, component.object) : Role{};
      if (!is_left_out(role)) add(component, home, transform, depth + 1);
    }
  }

  void require_few(std::size_t more) {
    if ((read_ += more) > most_triangles)
      throw error(fmt::format("components add up to more than {} triangles, expected fewer", most_triangles));
  }

  void add_mesh(const Object& object, const std::string& id, const std::string& home,
                const Transform& to_mm) {
    const std::vector<bool> material = material_of(object, id, home);
    require_few(object.mesh.triangles.size());
    const auto offset = std::uint32_t(mesh_.vertices.size());
    for (std::size_t v = 0; v < object.mesh.vertices.size(); ++v) {
      const Vec3 p = to_mm * object.mesh.vertices[v];
      if (!p.allFinite())
        throw error(fmt::format("vertex {} is ({}, {}, {}), expected finite coordinates", v + 1, p.x(), p.y(),
                                p.z()));
      mesh_.vertices.push_back(p);
    }
    const bool mirrors = to_mm.linear().determinant() < 0;
    for (std::size_t t = 0; t < object.mesh.triangles.size(); ++t) {
      if (!material[t]) continue;
      const auto& [a, b, c] = object.mesh.triangles[t];
      mesh_.triangles.push_back(mirrors ? Triangle{offset + a, offset + c, offset + b}
                                        : Triangle{offset + a, offset + b, offset + c});
    }
    const double largest = largest_coordinate(object.mesh);
    weld_ = std::max(weld_, model(home).digits.weld(largest) * to_mm.linear().colwise().norm().maxCoeff());
  }

  /// Which triangles of its mesh are, by PrusaSlicer's volumes.
  std::vector<bool> material_of(const Object& object, const std::string& id, const std::string& home) {
    std::vector<bool> material(object.mesh.triangles.size(), true);
    const auto ranges = settings_.ranges.find(id);
    if (home != root_ || ranges == settings_.ranges.end()) return material;
    for (const threemf::RoleRange& range : ranges->second) {
      if (range.first > range.last || range.last >= material.size())
        throw error(fmt::format("a volume of the triangles {} to {} of object {}, expected some of 0 to {}",
                                range.first, range.last, id, std::int64_t(material.size()) - 1));
      if (is_left_out(range.role))
        std::fill(material.begin() + std::ptrdiff_t(range.first),
                  material.begin() + std::ptrdiff_t(range.last) + 1, false);
    }
    return material;
  }

  const MeshFile& file_;
  Package package_;
  std::string root_;  ///< the model that is built
  threemf::SlicerSettings settings_;
  std::map<std::string, Model> models_;
  TriangleMesh mesh_;     ///< of the build item under way
  std::size_t read_ = 0;  ///< triangles and components of all of them
  double weld_ = 0;
  std::map<Role, std::size_t> left_out_;
  std::map<std::string, std::size_t> passed_over_;
};

}  // namespace

MeshReading read_3mf(const MeshFile& file) {
  Reader reader(file);
  TriangleMesh mesh = joined(reader.meshes(), file.name);
  return {std::move(mesh), reader.weld(), reader.notes()};
}

std::vector<TriangleMesh> read_3mf_objects(const MeshFile& file) { return Reader(file).meshes(); }

}  // namespace kreisel::core
