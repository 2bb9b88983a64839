// fragment_reference.hpp - the published rules on sorted fragments, in double, without any envelope.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "nest/decide/views.hpp"

namespace kreisel::core::nest::reference {

struct Fragment {
  double w;
  bool inner, front;
};

/// Adds what of a mesh lies beyond the cut on the line at (u, v) of a view.
inline void cast(const TriangleMesh& mesh, const Pose& pose, const View& view, const Cut& cut, int half,
                 bool inner, double u, double v, std::vector<Fragment>& out) {
  for (const Triangle& t : mesh.triangles) {
    Vec3 p[3];
    for (int k = 0; k < 3; ++k)
      p[k] = view.axes * (pose.scale * (pose.rotation * mesh.vertices[t[std::size_t(k)]]) + pose.centroid);
    const auto cross = [&](const Vec3& a, const Vec3& b) {
      return (a[0] - u) * (b[1] - v) - (b[0] - u) * (a[1] - v);
    };
    const double e0 = cross(p[1], p[2]), e1 = cross(p[2], p[0]), e2 = cross(p[0], p[1]), area = e0 + e1 + e2;
    if (area == 0 || !((e0 >= 0 && e1 >= 0 && e2 >= 0) || (e0 <= 0 && e1 <= 0 && e2 <= 0))) continue;
    const double w = (e0 * p[0][2] + e1 * p[1][2] + e2 * p[2][2]) / area;
    if (cut.beyond(half, view.axes.transpose() * Vec3(u, v, w)) > 0) out.push_back({w, inner, area < 0});
  }
}

/// [Nest, s. 5], word for word; nothing where two fragments of A and B, or two of A that face apart, lie
/// closer than `tie`.
inline std::optional<bool> bad_fragments(std::vector<Fragment> f, double tie) {
  std::sort(f.begin(), f.end(), [](const Fragment& a, const Fragment& b) { return a.w < b.w; });
  bool bad = false;
  for (std::size_t i = 0; i < f.size(); ++i) {
    const bool last = i + 1 == f.size();
    if (!last && f[i + 1].w - f[i].w < tie && (f[i].inner != f[i + 1].inner || f[i].front != f[i + 1].front))
      return std::nullopt;
    if (!f[i].inner)
      bad |= !last && f[i + 1].inner;
    else
      bad |= last || (!f[i + 1].inner && f[i + 1].front);
  }
  return bad;
}

/// Whether a pixel of a half's view is bad; nothing where that changes within 1/100 of a pixel or 1e-5 of
/// depth, which is what rounding vertices to 1/256 of a pixel and depths to floats can do.
inline std::optional<bool> bad_pixel(const Nesting& nesting, const Placement& placement, const View& view,
                                     int half, int x, int y) {
  std::optional<bool> answer;
  for (const auto& [dx, dy] : {std::pair{0.0, 0.0}, {0.01, 0.0}, {-0.01, 0.0}, {0.0, 0.01}, {0.0, -0.01}}) {
    const double u = view.x0 + view.pixel * (x + 0.5 + dx), v = view.y0 + view.pixel * (y + 0.5 + dy);
    std::vector<Fragment> fragments;
    cast(nesting.outer(), {}, view, placement.cut, half, false, u, v, fragments);
    cast(nesting.inner(), placement.pose, view, placement.cut, half, true, u, v, fragments);
    const auto bad = bad_fragments(fragments, 1e-5);
    if (!bad || (answer && *answer != *bad)) return std::nullopt;
    answer = bad;
  }
  return answer;
}

}  // namespace kreisel::core::nest::reference
