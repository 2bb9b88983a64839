#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "body/body.hpp"
#include "domain/columns.hpp"
#include "domain/crossings.hpp"
#include "mesh/query/distance.hpp"
#include "micro.hpp"

namespace kreisel::core::micro {
namespace {

/// The peer of column_crossings: Embree's watertight rays, single precision, every hit along each column.
class EmbreeRays {
 public:
  explicit EmbreeRays(const TriangleMesh& mesh)
      : device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
    rtcSetSceneFlags(
        scene_, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.vertices.size()));
    for (const Vec3& v : mesh.vertices)
      for (int k = 0; k < 3; ++k) *vertices++ = static_cast<float>(v[k]);
    auto* triangles = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), mesh.triangles.size()));
    for (const Triangle& t : mesh.triangles) triangles = std::copy(t.begin(), t.end(), triangles);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  ~EmbreeRays() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  EmbreeRays(const EmbreeRays&) = delete;
  EmbreeRays& operator=(const EmbreeRays&) = delete;

  [[nodiscard]] std::vector<std::vector<Crossing>> operator()(const Grid& grid) const {
    std::vector<std::vector<Crossing>> columns(static_cast<std::size_t>(grid.n[0]) * grid.n[1]);
    for (int iy = 0; iy < grid.n[1]; ++iy)
      for (int ix = 0; ix < grid.n[0]; ++ix) {
        auto& column = columns[ix + static_cast<std::size_t>(grid.n[0]) * iy];
        Collector collector;
        collector.column = &column;
        rtcInitIntersectContext(&collector.context);
        collector.context.filter = collect;
        RTCRayHit ray{};
        ray.ray.org_x = static_cast<float>(grid.centre(0, ix));
        ray.ray.org_y = static_cast<float>(grid.centre(1, iy));
        ray.ray.org_z = static_cast<float>(grid.face(2, -1));
        ray.ray.dir_z = 1;
        ray.ray.tfar = static_cast<float>(grid.h * (grid.n[2] + 2));
        ray.ray.mask = ~0u;
        ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(scene_, &collector.context, &ray);
        std::ranges::sort(column, {}, &Crossing::z);
      }
    return columns;
  }

 private:
  struct Collector {
    RTCIntersectContext context;  // first: the filter is handed its address
    std::vector<Crossing>* column;
  };

  /// Notes a hit and refuses it, so that the ray goes on.
  static void collect(const RTCFilterFunctionNArguments* a) {
    const auto* ray = reinterpret_cast<const RTCRay*>(a->ray);
    const auto* hit = reinterpret_cast<const RTCHit*>(a->hit);
    reinterpret_cast<Collector*>(a->context)
        ->column->push_back({double(ray->org_z) + double(ray->tfar), hit->Ng_z < 0 ? 1 : -1});
    a->valid[0] = 0;
  }

  RTCDevice device_;
  RTCScene scene_;
};

using Crossings = std::vector<std::vector<Crossing>>;

/// Columns in which Embree finds another number of crossings, or one more than a tenth of a cell away.
double columns_apart(const ColumnCrossings& ours, const Crossings& theirs, double h) {
  double apart = 0;
  for (std::size_t i = 0; i < ours.size(); ++i)
    apart += !std::ranges::equal(ours[i], theirs[i], [&](const Crossing& a, const Crossing& b) {
      return std::abs(a.z - b.z) < 0.1 * h && a.winding == b.winding;
    });
  return apart;
}

}  // namespace

void register_domain(Machine& machine, const std::string& model) {
  const auto spec = [=] {
    BodySpec body;
    body.model = model;
    return body;
  }();
  const auto body = std::make_shared<Body>(make_body(spec, machine.device));
  const auto add = [&](const std::string& name, auto loop) {
    benchmark::RegisterBenchmark(name.c_str(),
                                 [loop](benchmark::State& state) {
                                   for ([[maybe_unused]] auto _ : state) loop();
                                 })
        ->Unit(benchmark::kMillisecond)
        ->MeasureProcessCPUTime()
        ->UseRealTime();
  };
  add(fmt::format("make_body/{}", body->name),
      [spec, &machine] { benchmark::DoNotOptimize(make_body(spec, machine.device)); });
  add(fmt::format("surface_distance/build/{}", body->name),
      [body] { SurfaceDistance distance(body->local); });
  add(fmt::format("crossings/embree_build/{}", body->name), [body] { EmbreeRays rays(body->local); });
  const auto embree = std::make_shared<EmbreeRays>(body->local);
  for (const int resolution : {100, 256}) {
    GridSpec fine;
    fine.resolution = resolution;
    const Grid grid = make_grid(bounding_box(body->local), fine);
    const double apart = columns_apart(column_crossings(body->local, grid), (*embree)(grid), grid.h);
    fmt::print(stderr, "crossings of {} at {}: Embree differs in {} of {} columns\n", body->name, resolution,
               apart, grid.n[0] * grid.n[1]);
    add(fmt::format("crossings/kreisel/{}/{}", body->name, resolution),
        [body, grid] { benchmark::DoNotOptimize(column_crossings(body->local, grid)); });
    add(fmt::format("crossings/embree/{}/{}", body->name, resolution),
        [embree, grid] { benchmark::DoNotOptimize((*embree)(grid)); });
    for (const char* wall : {"2%", "1.5h"})
      add(fmt::format("mesh_to_domain/{}/{}/{}", body->name, resolution, wall),
          [body, fine, wall = parse_wall(wall)] {
            benchmark::DoNotOptimize(make_columns(*body, fine, wall));
          });
  }
}

}  // namespace kreisel::core::micro
