#include "design/nested.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "body/mesh_moments.hpp"
#include "body/source.hpp"
#include "device/device.hpp"
#include "error.hpp"
#include "fabricate/cut_part.hpp"
#include "fabricate/lay_flat.hpp"
#include "fabricate/swept_void.hpp"
#include "fabricate/wall.hpp"
#include "geometry/moved.hpp"
#include "mesh/solid/check.hpp"
#include "mesh/solid/components.hpp"
#include "nest/search/layers.hpp"
#include "run/nest_parts.hpp"
#include "stop.hpp"
#include "stopwatch.hpp"

namespace kreisel::core {
namespace {

/// How finely voids are carved; the height field reaches up to three pixels further than asked for.
double pixel_of(const NestedSpec& spec, double size) {
  return std::max(spec.layers().tolerances.accuracy / 4, size / 1024);
}

struct Shapes {
  std::vector<TriangleMesh> meshes;  ///< the outermost first, a shape in itself once
  std::vector<std::string> repairs;
  double size = 0;          ///< longest side of the outermost, mm
  Vec3 up = Vec3::UnitZ();  ///< of the outermost
};

/// @throws InputError  a shape that is no solid; before all else, an outermost one whose unit must be said
Shapes load(const NestedSpec& asked) {
  const NestConfig& config = asked.config;
  const std::vector<std::string>& within = std::get<NestLayers>(config.kind).within;
  std::vector<std::string> names = {config.outer};
  if (!config.inner.empty() && (config.inner != config.outer || !within.empty()))
    names.push_back(config.inner);
  names.insert(names.end(), within.begin(), within.end());
  Shapes shapes;
  for (const std::string& name : names) {
    BodySpec spec;
    spec.model = name;
    if (config.fineness > 0) spec.fineness = config.fineness;
    const bool outermost = shapes.meshes.empty();
    if (outermost) {  // those inside it are scaled anyway
      spec.unit = asked.unit;
      spec.size = config.outer_size;
    }
    Source solid = load_solid(spec);
    if (outermost) require_unit_said(spec, solid);
    const double longest = bounding_box(solid.mesh).extent().maxCoeff();
    if (outermost) {
      shapes.up = solid.up;
      shapes.size = config.outer_size ? *config.outer_size : solid.size.value_or(longest * solid.millimetres);
    }
    for (const std::string& line : solid.repairs) shapes.repairs.push_back(fmt::format("{}: {}", name, line));
    shapes.meshes.push_back(std::move(solid.mesh));
  }
  return shapes;
}

nest::Layers search(const NestedSpec& spec, const Shapes& shapes, device::Device& device,
                    const Control& control) {
  nest::LayersSpec layers;
  layers.size = shapes.size;
  layers.tolerances = spec.layers().tolerances;
  layers.tolerances.accuracy += 3 * pixel_of(spec, shapes.size);
  layers.most = spec.layers().layers;
  layers.cells = spec.layers().cells;
  layers.search = search_of(spec.layers(), spec.layers());
  layers.search.freedom.given = unplaced(spec.layers());
  layers.search.keep_outs = spec.layers().keep_outs;
  nest::Layers found =
      nest::nest_layers(shapes.meshes, device, layers, [&](int layer, const nest::SearchState& state) {
        control.tell(fmt::format("layer {}, iteration {} of {}, scale {:.4f}", layer, state.trace.size(),
                                 spec.layers().search.swarm.iterations, state.scale));
        return !control.stopped();
      });
  if (found.interrupted) throw Interrupted();
  return found;
}

class Builder {
 public:
  Builder(Nested& nested, const Shapes& shapes, const nest::Layers& found, const Control& control)
      : nested_(nested), shapes_(shapes), found_(found), control_(control) {}

  /// The halves of all layers, and the innermost shape.
  std::vector<MaterialPart> parts() {
    const NestedSpec& spec = nested_.spec;
    std::vector<MaterialPart> all;
    for (std::size_t k = 0; k < found_.layers.size(); ++k) {
      control_.stop_if_asked();
      for (MaterialPart& part : halves(found_.layers[k], shape(k))) {
        add_place(k, part.name == "upper" ? 0 : part.name == "lower" ? 1 : -1);
        part.name = fmt::format("layer-{}-{}", k + 1, part.name);
        all.push_back(std::move(part));
      }
    }
    add_place(found_.layers.size(), -1);
    all.push_back({"innermost", spec.density, {shape(found_.layers.size())}});
    if (spec.lay_flat) lay_flat(all);
    return all;
  }

  /// Reads what was written, and measures it. @return  what is wrong, if anything
  std::string verify(std::vector<WrittenMaterial> written) {
    std::string wrong;
    WrittenReader reader;
    for (std::size_t i = 0; i < written.size(); ++i) {
      WrittenMaterial& material = written[i];
      TriangleMesh mesh = reader.next(material);
      try {
        require_solid(mesh, material.name);
      } catch (const InputError& error) {
        if (wrong.empty()) wrong = fmt::format("the written mesh is not a solid: {}", error.what());
      }
      material.grams = 1e-3 * material.density * reference::mesh_moments(mesh).value[S1];
      NestedPart& part = nested_.parts[i];
      part.shells = shells(mesh).size();
      part.written = std::move(material);
      part.mesh = std::move(mesh);
    }
    for (std::size_t k = 0; k < nested_.layers.size(); ++k) measure(k);
    return wrong;
  }

 private:
  void add_place(std::size_t layer, int half) {
    NestedPart& part = nested_.parts.emplace_back();
    part.layer = layer;
    part.half = half;
  }

  /// The outermost shape, or that in layer k - 1; mm.
  [[nodiscard]] TriangleMesh shape(std::size_t k) const {
    if (k == 0) return moved(shapes_.meshes.front(), found_.outermost);
    const nest::Layer& layer = found_.layers[k - 1];
    return moved(shapes_.meshes[layer.inner], layer.inner_to_world);
  }

  std::vector<MaterialPart> halves(const nest::Layer& layer, const TriangleMesh& outer) {
    const NestedSpec& spec = nested_.spec;
    const TriangleMesh inner = moved(shapes_.meshes[layer.inner], layer.inner_to_world);
    const double pixel = pixel_of(spec, shapes_.size);
    const double below = 1e-2 * bounding_box(outer).extent().norm();  // more than the cut may be moved
    TriangleMesh voids[2];
    for (int half = 0; half < 2; ++half)
      voids[half] = swept_void(inner, {layer.cut.into(half), layer.cut.removal(half)},
                               spec.layers().tolerances.accuracy, pixel, below);
    nested_.layers.push_back({layer});
    return cut_in_halves(outer, {std::move(voids[0]), std::move(voids[1])}, layer.cut, spec.density,
                         {spec.peg_radius});
  }

  void measure(std::size_t k) {
    NestedLayer& layer = nested_.layers[k];
    const TriangleMesh outer = shape(k), inner = shape(k + 1);
    const double step = nested_.spec.layers().tolerances.accuracy / 2;
    // Files are in single precision; what lies that near to the outer surface is that surface.
    const double skin = 1e-5 * nested_.size;
    for (const NestedPart& part : nested_.parts) {
      if (part.layer != k || part.half < 0) continue;
      layer.wall = std::min(layer.wall, least_wall_within(outer, part.mesh, skin));
      layer.gap =
          std::min(layer.gap, nest::clearance_of_half(part.mesh, inner, layer.found.cut, part.half, step));
    }
  }

  Nested& nested_;
  const Shapes& shapes_;
  const nest::Layers& found_;
  const Control& control_;
};

double wall_of(const Wall& wall, double size) {
  if (wall.unit == Wall::cells)
    throw InputError(
        fmt::format("--wall {}; expected a number of mm, or percent of the longest side", to_string(wall)));
  return wall.unit == Wall::percent ? 0.01 * wall.value * size : wall.value;
}

void require_printable(const nest::Tolerances& tolerances) {
  if (!(tolerances.accuracy > 0))
    throw InputError(
        fmt::format("a printer's accuracy of {} mm; expected more than 0, for the parts to come apart",
                    tolerances.accuracy));
  if (tolerances.wall < tolerances.accuracy)
    throw InputError(
        fmt::format("a wall of {:.3g} mm is thinner than the printer's accuracy of {:.3g} mm; expected a "
                    "thicker --wall, a larger --size or a finer --printer-accuracy",
                    tolerances.wall, tolerances.accuracy));
}

void judge(Nested& nested, const std::string& wrong) {
  const nest::Tolerances& asked = nested.spec.layers().tolerances;
  double gap = std::numeric_limits<double>::infinity(), wall = gap;
  for (const NestedLayer& layer : nested.layers) {
    gap = std::min(gap, layer.gap);
    wall = std::min(wall, layer.wall);
  }
  nested.text = wrong;
  if (!wrong.empty()) return;
  // Files are in single precision.
  const double rounding = 1e-6 * nested.size;
  nested.ok = gap >= asked.accuracy - rounding && wall >= asked.wall - rounding;
  nested.text =
      fmt::format("{}: {} layer{} come{} apart with {:.3f} mm of play, the thinnest wall is {:.3f} mm",
                  nested.ok ? "nests" : "does not nest as asked", nested.layers.size(),
                  nested.layers.size() == 1 ? "" : "s", nested.layers.size() == 1 ? "s" : "", gap, wall);
}

}  // namespace

Vec3 Nested::apart(const NestedPart& part) const {
  if (part.half < 0) return Vec3::Zero();
  const double way = 0.5 * size * static_cast<double>(layers.size() - part.layer);
  return way * layers[part.layer].found.cut.removal(part.half);
}

Nested make_nested(const NestedSpec& spec, const Control& control) {
  if (!(spec.density > 0)) throw InputError(fmt::format("density {}; expected a number > 0", spec.density));
  require_valid(spec.config);
  Nested nested;
  nested.spec = spec;
  Shapes shapes = load(spec);
  nested.repairs = shapes.repairs;
  nested.size = shapes.size;
  nested.up = shapes.up;
  nest::Tolerances& tolerances = nested.spec.layers().tolerances;
  tolerances.wall = wall_of(spec.wall, shapes.size);
  require_printable(tolerances);
  device::Device device(spec.config.device);
  nested.provenance = make_provenance(device);
  const Stopwatch searching;
  const nest::Layers found = search(nested.spec, shapes, device, control);
  nested.search_seconds = searching.seconds();
  nested.ended = found.ended;
  nested.text = found.ended;
  if (found.layers.empty()) return nested;
  control.tell("carve, cut, write, verify");
  const Stopwatch making;
  const StopScope scope(control.stop);
  Builder builder(nested, shapes, found, control);
  const std::vector<MaterialPart> parts = builder.parts();
  control.stop_if_asked();
  judge(nested, builder.verify(write_parts(spec.file, parts)));
  nested.parts_seconds = making.seconds();
  return nested;
}

}  // namespace kreisel::core
