#include "mesh/io/threemf/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "error.hpp"
#include "mesh/io/threemf/xml.hpp"
#include "parse.hpp"

namespace kreisel::core::threemf {
namespace {

constexpr std::string_view production = "http://schemas.microsoft.com/3dmanufacturing/production/2015/06";

/// Extensions whose files have their whole shape in meshes and components.
constexpr std::array<std::string_view, 4> understood = {
    production, "http://schemas.microsoft.com/3dmanufacturing/material/2015/02",
    "http://schemas.microsoft.com/3dmanufacturing/slice/2015/07",
    "http://schemas.microsoft.com/3dmanufacturing/trianglesets/2021/07"};

constexpr std::array<std::pair<std::string_view, double>, 6> units{{{"micron", 1e-3},
                                                                    {"millimeter", 1},
                                                                    {"centimeter", 10},
                                                                    {"inch", 25.4},
                                                                    {"foot", 304.8},
                                                                    {"meter", 1000}}};

class Visitor final : public XmlVisitor {
 public:
  explicit Visitor(std::string name) : name_(std::move(name)) {}

  Model model() && {
    if (!root_seen_) throw error("no element 'model', expected a 3MF model");
    return std::move(model_);
  }

  void prefix(std::string_view prefix, std::string_view space) override {
    spaces_[std::string(prefix)] = space;
  }

  void start(const Element& e) override {
    within_.emplace_back(e.space == core_ || !root_seen_ ? e.name : foreign);
    if (!root_seen_) {
      start_model(e);
    } else if (within_.back() == foreign) {
      start_foreign(e);
    } else if (e.name == "object") {
      start_object(e);
    } else if (e.name == "vertex" && object_) {
      object_->mesh.vertices.push_back({coordinate(e, "x"), coordinate(e, "y"), coordinate(e, "z")});
    } else if (e.name == "triangle" && object_) {
      object_->mesh.triangles.push_back({index(e, "v1"), index(e, "v2"), index(e, "v3")});
    } else if (e.name == "component" && object_) {
      object_->components.push_back(placed(e));
    } else if (e.name == "item") {
      model_.items.push_back(placed(e));
      const auto printable = e.get("printable");
      if (printable == "0" || printable == "false")
        model_.items.back().role = "item that is not to be printed";
    } else if (e.name == "metadata") {
      key_ = e.get("name").value_or("");
      value_.clear();
    }
  }

  void text(std::string_view text) override {
    if (!key_.empty()) value_ += text;
  }

  void end() override {
    const std::string ended = std::move(within_.back());
    within_.pop_back();
    if (!key_.empty() && (ended == "metadata" || ended == foreign)) {
      end_setting();
    } else if (ended == "object" && object_) {
      require_indices();
      object_ = nullptr;
    }
  }

 private:
  static constexpr std::string_view foreign = "*";

  [[nodiscard]] InputError error(const std::string& what) const {
    return InputError(fmt::format("{}: line {}: {}", name_, line, what));
  }

  /// The address without what all of the Consortium's have in front: "beamlattice/2017/02".
  static std::string extension_name(std::string_view address) {
    constexpr std::string_view base = "http://schemas.microsoft.com/3dmanufacturing/";
    if (address.starts_with(base)) address.remove_prefix(base.size());
    return shown(address);
  }

  void start_model(const Element& e) {
    if (e.name != "model") throw error(fmt::format("element '{}', expected 'model' of 3MF", shown(e.name)));
    root_seen_ = true;
    core_ = e.space;
    const std::string_view unit = e.get("unit").value_or("millimeter");
    const auto known = std::ranges::find(units, unit, [](const auto& u) { return u.first; });
    if (known == units.end())
      throw error(fmt::format("unit '{}', expected micron, millimeter, centimeter, inch, foot or meter",
                              shown(unit)));
    model_.millimetres = known->second;
    std::string_view required = e.get("requiredextensions").value_or("");
    for (std::string_view prefix; !(prefix = next_word(required)).empty();) {
      const auto space = spaces_.find(std::string(prefix));
      const std::string address = space == spaces_.end() ? "" : space->second;
      if (address != core_ && std::ranges::find(understood, address) == understood.end())
        throw error(
            fmt::format("the file requires the 3MF extension '{}' ({}), which is not read here, expected "
                        "meshes without it",
                        extension_name(address), shown(prefix)));
    }
  }

  /// Settings of Cura's earlier versions; else something of an extension, counted where it may be of shape.
  void start_foreign(const Element& e) {
    const std::string_view parent = within_[within_.size() - 2];
    if (e.name == "setting" && e.get("key")) {
      key_ = "cura:" + std::string(*e.get("key"));
      value_.clear();
    } else if (object_ && (parent == "object" || parent == "mesh") && e.name != "settings") {
      ++object_->passed_over[shown(e.name)];
    }
  }

  void start_object(const Element& e) {
    const std::string id(required(e, "id"));
    const auto [at, fresh] = model_.objects.try_emplace(id);
    if (!fresh)
      throw error(fmt::format("two objects with the id {}, expected an id of its own for each", shown(id)));
    object_ = &at->second;
    const std::string_view type = e.get("type").value_or("model");
    if (type != "model") object_->role = "object of the type " + shown(type);
  }

  /// Cura's word for it, on an object or an item.
  void end_setting() {
    constexpr std::string_view cura = "cura:";
    if (key_.starts_with(cura))
      if (Role role = cura_role(std::string_view(key_).substr(cura.size()), value_); !role.empty()) {
        const bool of_item = std::ranges::find(within_, "item") != within_.end();
        if (object_)
          object_->role = std::move(role);
        else if (of_item && !model_.items.empty())
          model_.items.back().role = std::move(role);
      }
    key_.clear();
  }

  void require_indices() const {
    const TriangleMesh& mesh = object_->mesh;
    for (const Triangle& t : mesh.triangles)
      for (const std::uint32_t v : t)
        if (v >= mesh.vertices.size())
          throw error(fmt::format("vertex index {} in the object that ends here, expected 0 to {}", v,
                                  std::int64_t(mesh.vertices.size()) - 1));
  }

  [[nodiscard]] std::string_view required(const Element& e, std::string_view attribute) const {
    const auto value = e.get(attribute);
    if (!value)
      throw error(fmt::format("element '{}' without its attribute '{}', expected one with it", shown(e.name),
                              attribute));
    return trimmed(*value);
  }

  static std::string_view trimmed(std::string_view text) {
    std::string_view rest = text;
    const std::string_view word = next_word(rest);
    return next_word(rest).empty() ? word : text;
  }

  [[nodiscard]] double coordinate(const Element& e, std::string_view axis) {
    const std::string_view word = required(e, axis);
    const auto value = parse<double>(word);
    if (!value)
      throw error(fmt::format("coordinate {} = '{}' of vertex {}, expected a finite number", axis,
                              shown(word), object_->mesh.vertices.size() + 1));
    model_.digits.see(word, *value);
    return *value;
  }

  [[nodiscard]] std::uint32_t index(const Element& e, std::string_view corner) const {
    const std::string_view word = required(e, corner);
    const auto value = parse<std::uint32_t>(word);
    if (!value)
      throw error(fmt::format("vertex index {} = '{}' of triangle {}, expected a whole number, 0 or more",
                              corner, shown(word), object_->mesh.triangles.size() + 1));
    return *value;
  }

  [[nodiscard]] Placed placed(const Element& e) const {
    Placed p{std::string(required(e, "objectid")), part_name(e.get("path", production).value_or(""))};
    const std::string_view text = e.get("transform").value_or("1 0 0 0 1 0 0 0 1 0 0 0");
    std::string_view rest = text;
    for (int i = 0; i < 12; ++i) {  // the images of x, y and z, then the offset
      const auto value = parse<double>(next_word(rest));
      if (!value) throw bad_transform(text);
      p.transform.matrix()(i % 3, i / 3) = *value;
    }
    if (!next_word(rest).empty()) throw bad_transform(text);
    return p;
  }

  [[nodiscard]] InputError bad_transform(std::string_view text) const {
    return error(fmt::format("transform '{}', expected 12 finite numbers", shown(text)));
  }

  std::string name_;
  std::string core_;  ///< the namespace of the root
  bool root_seen_ = false;
  std::map<std::string, std::string> spaces_;  ///< by prefix
  std::vector<std::string> within_;            ///< names of the elements around
  Model model_;
  Object* object_ = nullptr;
  std::string key_, value_;  ///< of a setting
};

}  // namespace

Model read_model(std::string_view text, const std::string& name) {
  Visitor visitor(name);
  walk_xml(text, name, visitor);
  return std::move(visitor).model();
}

}  // namespace kreisel::core::threemf
