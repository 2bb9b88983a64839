#include "nest/search/layers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "error.hpp"
#include "geometry/moved.hpp"
#include "mesh/query/distance.hpp"
#include "mesh/solid/components.hpp"
#include "nest/decide/certify.hpp"
#include "offset/offset_surface.hpp"
#include "parallel.hpp"
#include "stopwatch.hpp"

namespace kreisel::core::nest {
namespace {

double longest_side(const TriangleMesh& mesh) { return bounding_box(mesh).extent().maxCoeff(); }

void require_valid(const std::vector<TriangleMesh>& shapes, const LayersSpec& spec) {
  if (shapes.empty()) throw InputError("layers of no shape; expected one at least");
  const auto& [accuracy, wall] = spec.tolerances;
  for (const auto& [name, value] :
       {std::pair{"size", spec.size}, std::pair{"printer's accuracy", accuracy}, std::pair{"wall", wall}})
    if (!std::isfinite(value) || value < 0)
      throw InputError(fmt::format("{} {} mm; expected a number >= 0", name, value));
  if (spec.most < 1) throw InputError(fmt::format("layers {}; expected one at least", spec.most));
  if (spec.cells < 8 || spec.cells > 1024)
    throw InputError(fmt::format("cells of the offset {}; expected 8 to 1024", spec.cells));
}

/// A shape as in its file: how long, and how deep its deepest point is.
struct Measures {
  double longest = 0, depth = 0;
};

/// How deep the deepest point of a solid is: of a lattice, and uphill from there. Nesting units.
double depth_of(const Nesting& nesting) {
  constexpr int lattice = 512;
  const std::vector<Vec3> deep = deep_points(nesting, lattice);
  if (deep.empty()) return 0;
  const SurfaceDistance distance(nesting.outer());
  Vec3 at = deep.front();
  double depth = distance(at, 2);
  for (double step = 0.1; step > 1e-4;) {
    const double before = depth;
    for (int axis = 0; axis < 3; ++axis)
      for (const double sign : {-1.0, 1.0}) {
        const Vec3 next = at + sign * std::min(step, 0.9 * depth) * Vec3::Unit(axis);  // still inside
        if (const double there = distance(next, 2); there > depth) {
          depth = there;
          at = next;
        }
      }
    if (!(depth > before)) step /= 2;
  }
  return depth;
}

Measures measure(const TriangleMesh& mesh) {
  const Nesting alone(mesh, mesh);
  return {longest_side(mesh), depth_of(alone) * alone.unit()};
}

/// A level set fills cavities, so that an offset would know nothing of their walls.
void require_no_cavity(const TriangleMesh& mesh) {
  for (const Shell& shell : shells(mesh))
    if (shell.volume < 0)
      throw InputError(
          fmt::format("a shape has a cavity of {:.4g} mm^3; expected a solid without, to offset it inwards",
                      -shell.volume));
}

/// The space that is left for an inner shape; offset by a little more than asked for, for the surface errs.
TriangleMesh space_inside(const TriangleMesh& mesh, const Tolerances& tolerances, double voxel) {
  if (!(tolerances.inset() > 0)) return mesh;
  return offset_surface(mesh, -(tolerances.inset() + voxel / 8), voxel);
}

/// Of the search for this layer: what is not free lies about the centroid of the space inside.
OptimiseSpec about_centroid(OptimiseSpec search, const Nesting& nesting) {
  Placement& given = search.freedom.given;
  given.pose.centroid = nesting.to_units(nesting.outer_centroid());
  given.cut.offset = given.cut.normal.dot(given.pose.centroid);
  return search;
}

/// What of the outermost shape the first cut is to leave alone. @param outside  as the balls, mm
void keep_out(OptimiseSpec& search, const Nesting& nesting, const TriangleMesh& outside) {
  for (KeepOut& ball : search.keep_outs) ball = {nesting.to_units(ball.centre), ball.radius / nesting.unit()};
  TriangleMesh surface = outside;
  for (Vec3& v : surface.vertices) v = nesting.to_units(v);
  search.surface = std::make_shared<const TriangleMesh>(std::move(surface));
}

/// From nesting units to the coordinates of the mesh outside, and on by a similarity without reflection.
Cut cut_in_world(const Cut& cut, const Nesting& nesting, const Eigen::Affine3d& to_world) {
  const Eigen::Matrix3d turn = to_world.linear() / std::cbrt(to_world.linear().determinant());
  Cut world;
  world.normal = turn * cut.normal;
  world.offset = world.normal.dot(to_world * nesting.to_file(cut.offset * cut.normal));
  world.plus = turn * cut.plus;
  world.minus = turn * cut.minus;
  return world;
}

Eigen::Affine3d affine(const Eigen::Matrix<double, 3, 4>& rows) {
  Eigen::Affine3d map;
  map.affine() = rows;
  return map;
}

class Builder {
 public:
  Builder(const std::vector<TriangleMesh>& shapes, device::Device& device, const LayersSpec& spec,
          const OnLayerIteration& on_iteration)
      : shapes_(shapes), device_(device), spec_(spec), on_iteration_(on_iteration) {
    for (const TriangleMesh& shape : shapes) {
      if (spec.tolerances.inset() > 0) require_no_cavity(shape);
      measures_.push_back(measure(shape));
    }
    const double scale = spec.size > 0 ? spec.size / measures_.front().longest : 1;
    result_.outermost = Eigen::Affine3d(Eigen::Scaling(scale));
  }

  Layers build() {
    Eigen::Affine3d outer_to_world = result_.outermost;
    while (std::ssize(result_.layers) < spec_.most) {
      std::optional<Layer> layer = next_layer(outer_to_world);
      if (!layer) return result_;
      outer_to_world = layer->inner_to_world;
      result_.layers.push_back(std::move(*layer));
      if (result_.interrupted) break;
    }
    result_.ended = result_.interrupted ? "stopped" : fmt::format("{} layers were asked for", spec_.most);
    return result_;
  }

 private:
  std::optional<Layer> end(std::string why) {
    result_.ended = std::move(why);
    return std::nullopt;
  }

  /// @return  nothing when there are no more, with the reason in the result
  std::optional<Layer> next_layer(const Eigen::Affine3d& outer_to_world) {
    const std::size_t depth = result_.layers.size(), last = shapes_.size() - 1;
    Layer layer;
    layer.outer = std::min(depth, last);
    layer.inner = std::min(depth + 1, last);
    const Measures& outer = measures_[layer.outer];
    const double outer_scale = std::cbrt(outer_to_world.linear().determinant());
    const double voxel = outer.longest * outer_scale / spec_.cells, inset = spec_.tolerances.inset();
    // With less than a voxel left there is no surface worth the name.
    if (inset > 0 && outer.depth * outer_scale < inset + voxel)
      return end(
          fmt::format("the shape inside is nowhere deeper than {:.3g} mm, the walls and the printer's "
                      "accuracy take {:.3g} mm on every side",
                      outer.depth * outer_scale, inset));
    const Eigen::Affine3d to_size(Eigen::Scaling(outer_scale));
    const TriangleMesh outside = moved(shapes_[layer.outer], to_size);
    const Stopwatch offset;
    TriangleMesh space = space_inside(outside, spec_.tolerances, voxel);
    if (space.triangles.empty())
      throw InputError(
          fmt::format("shape {} has no inside at cells of {:.3g} mm; expected a mesh without holes, or "
                      "more cells",
                      layer.outer + 1, voxel));
    const Nesting nesting(std::move(space), shapes_[layer.inner]);
    layer.offset_seconds = offset.seconds();

    OptimiseSpec search = about_centroid(spec_.search, nesting);
    if (depth == 0 && !search.keep_outs.empty())
      keep_out(search, nesting, outside);
    else
      search.keep_outs.clear();
    const OptimiseResult found = spec_.optimise(
        nesting, device_, search,
        [&](const SearchState& state) {
          return !on_iteration_ || on_iteration_(static_cast<int>(depth) + 1, state);
        },
        nullptr);
    layer.search_seconds = found.setup_seconds + found.search_seconds;
    layer.evaluations = found.state.evaluations();
    result_.interrupted = found.ended_early && !(found.search_seconds >= spec_.search.seconds);
    if (!found.best) return end(result_.interrupted ? "stopped" : "nothing that nests was found");
    layer.scale = found.best->pose.scale;
    const double inner_thickness = 2 * measures_[layer.inner].depth * layer.scale;
    if (inner_thickness < spec_.tolerances.wall)
      return end(fmt::format(
          "the next shape would be at most {:.3g} mm thick, less than the least wall of {:.3g} mm",
          inner_thickness, spec_.tolerances.wall));

    const Stopwatch certify;
    layer.certified_scale = certify_scale(nesting, *found.best, spec_.search.tolerance).scale;
    layer.certify_seconds = certify.seconds();

    const Eigen::Affine3d inner_to_outer = affine(nesting.transform(found.best->pose));
    const Eigen::Affine3d to_world = outer_to_world * to_size.inverse();
    layer.inner_to_world = to_world * inner_to_outer;
    layer.cut = cut_in_world(found.best->cut, nesting, to_world);
    layer.longest = layer.scale * measures_[layer.inner].longest;
    layer.ratio = layer.longest / (outer_scale * outer.longest);
    layer.thickness = clearance(outside, moved(shapes_[layer.inner], inner_to_outer),
                                cut_in_world(found.best->cut, nesting, Eigen::Affine3d::Identity()), voxel) -
                      spec_.tolerances.accuracy;
    return layer;
  }

  const std::vector<TriangleMesh>& shapes_;
  device::Device& device_;
  const LayersSpec& spec_;
  const OnLayerIteration& on_iteration_;
  std::vector<Measures> measures_;
  Layers result_;
};

}  // namespace

Layers nest_layers(const std::vector<TriangleMesh>& shapes, device::Device& device, const LayersSpec& spec,
                   const OnLayerIteration& on_iteration) {
  require_valid(shapes, spec);
  return Builder(shapes, device, spec, on_iteration).build();
}

double clearance(const TriangleMesh& outer, const TriangleMesh& inner, const Cut& cut, double step) {
  return std::min(clearance_of_half(outer, inner, cut, 0, step),
                  clearance_of_half(outer, inner, cut, 1, step));
}

double clearance_of_half(const TriangleMesh& outer, const TriangleMesh& inner, const Cut& cut, int half,
                         double step) {
  const SurfaceDistance distance(outer);
  const Vec3& removal = cut.removal(half);
  const double across = std::abs(cut.normal.dot(removal));
  constexpr std::size_t block = 256;
  std::vector<double> least((inner.vertices.size() + block - 1) / block);
  // Of each block of vertices, none farther than is known already: distances to far surfaces are dear.
  const auto least_of_all = [&](double known, auto&& of_vertex) {
    parallel_for(least.size(), [&](std::size_t b) {
      least[b] = known;
      const std::size_t end = std::min(inner.vertices.size(), (b + 1) * block);
      for (std::size_t i = b * block; i < end; ++i) of_vertex(inner.vertices[i], least[b]);
    });
    return *std::ranges::min_element(least);
  };
  const double far = 2 * bounding_box(outer).extent().norm() + bounding_box(inner).extent().norm();
  const double at_rest = least_of_all(
      far, [&](const Vec3& v, double& so_far) { so_far = std::min(so_far, distance(v, so_far)); });
  return least_of_all(at_rest, [&](const Vec3& v, double& so_far) {
    const double way = cut.beyond(half, v) / across;
    for (double t = 0; t < way;) {
      const double d = distance(v - t * removal, so_far + 4 * step);
      so_far = std::min(so_far, d);
      t += std::max(step, d - so_far);  // nothing on the next d - least can be nearer than the least
    }
    if (way > 0) so_far = std::min(so_far, distance(v - way * removal, so_far));
  });
}

}  // namespace kreisel::core::nest
