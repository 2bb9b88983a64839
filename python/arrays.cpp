#include "arrays.hpp"

#include <string>
#include <vector>

namespace kreisel::python {
namespace {

void require_rows_of_three(const py::array& array, const char* what) {
  if (array.ndim() == 2 && array.shape(1) == 3) return;
  std::string shape;
  for (py::ssize_t i = 0; i < array.ndim(); ++i) shape += (i ? " x " : "") + std::to_string(array.shape(i));
  throw InputError(std::string(what) + " of shape " + shape + "; expected n x 3");
}

}  // namespace

Mesh mesh_of(const Vertices& vertices, const Faces& faces) {
  require_rows_of_three(vertices, "vertices");
  require_rows_of_three(faces, "faces");
  Mesh mesh;
  const auto v = vertices.unchecked<2>();
  const auto f = faces.unchecked<2>();
  for (py::ssize_t i = 0; i < v.shape(0); ++i) mesh.vertices.emplace_back(v(i, 0), v(i, 1), v(i, 2));
  for (py::ssize_t i = 0; i < f.shape(0); ++i) {
    Triangle t{};
    for (py::ssize_t k = 0; k < 3; ++k) {
      if (f(i, k) < 0 || f(i, k) >= v.shape(0))
        throw InputError("face " + std::to_string(i) + " of the vertex " + std::to_string(f(i, k)) +
                         "; expected one of " + std::to_string(v.shape(0)) + ", counted from 0");
      t[static_cast<std::size_t>(k)] = static_cast<std::uint32_t>(f(i, k));
    }
    mesh.triangles.push_back(t);
  }
  return mesh;
}

py::tuple views_of(const Mesh& mesh, const py::object& owner) {
  const auto rows = [](std::size_t n) { return std::vector<py::ssize_t>{static_cast<py::ssize_t>(n), 3}; };
  py::array_t<double> vertices(rows(mesh.vertices.size()),
                               mesh.vertices.empty() ? nullptr : mesh.vertices.front().data(), owner);
  py::array_t<std::uint32_t> faces(rows(mesh.triangles.size()),
                                   mesh.triangles.empty() ? nullptr : mesh.triangles.front().data(), owner);
  vertices.attr("flags").attr("writeable") = false;
  faces.attr("flags").attr("writeable") = false;
  return py::make_tuple(vertices, faces);
}

py::array view_of(const Moments& moments, const py::object& owner) {
  py::array_t<double> view(std::vector<py::ssize_t>{10}, moments.data(), owner);
  view.attr("flags").attr("writeable") = false;
  return view;
}

}  // namespace kreisel::python
