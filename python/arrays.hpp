// arrays.hpp - meshes and moments as numpy arrays.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstdint>
#include <kreisel/kreisel.hpp>

namespace kreisel::python {

namespace py = pybind11;

using Vertices = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Faces = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

/// Of (n, 3) and (m, 3). @throws InputError  another shape, a face of a vertex that is not there
[[nodiscard]] Mesh mesh_of(const Vertices& vertices, const Faces& faces);

/// Read-only views of a mesh that `owner` holds: (n, 3) float64 and (m, 3) uint32.
[[nodiscard]] py::tuple views_of(const Mesh& mesh, const py::object& owner);

/// A read-only view of ten numbers that `owner` holds.
[[nodiscard]] py::array view_of(const Moments& moments, const py::object& owner);

}  // namespace kreisel::python
