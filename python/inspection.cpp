// inspection.cpp - kreisel.inspect().
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <kreisel/inspection.hpp>
#include <utility>

#include "arrays.hpp"
#include "registered.hpp"

namespace kreisel::python {

void add_inspections(py::module_& m) {
  py::class_<ShellReport>(m, "Shell", "Connected triangles, after the repairs.")
      .def_readonly("triangles", &ShellReport::triangles)
      .def_readonly("closed", &ShellReport::closed)
      .def_readonly("euler", &ShellReport::euler)
      .def_readonly("genus", &ShellReport::genus, "Where it is closed.")
      .def_readonly("volume", &ShellReport::volume, "Units of the file; negative: inside out.")
      .def_readonly("depth", &ShellReport::depth, "How many shells are around it.");
  py::class_<RestReport>(m, "Rest", "A stable way of lying.")
      .def_readonly("up", &RestReport::up)
      .def_readonly("probability", &RestReport::probability,
                    "That it ends so, dropped anyhow without a bounce.")
      .def_readonly("tilt_degrees", &RestReport::tilt_degrees, "By which it topples.")
      .def_readonly("area", &RestReport::area, "Of what carries it, mm^2.");
  py::class_<SolidReport>(m, "Solid", "A solid at rest in model coordinates: mm, g.")
      .def_readonly("extent", &SolidReport::extent)
      .def_readonly("centre", &SolidReport::centre, "Of mass.")
      .def_readonly("volume", &SolidReport::volume)
      .def_readonly("mass", &SolidReport::mass)
      .def_readonly("principal", &SolidReport::principal, "Moments of inertia, g mm^2, ascending.")
      .def_readonly("axes", &SolidReport::axes, "(3, 3), a column each.")
      .def_readonly("pieces", &SolidReport::pieces,
                    "Mass of each that touches no other, g, the heaviest first.")
      .def_readonly("rests", &SolidReport::rests, "Stable ways of lying, the most probable first.")
      .def_readonly("verdicts", &SolidReport::verdicts, "What each problem says of it as it is.");
  py::class_<Inspection>(m, "Inspection", "Everything about a mesh.")
      .def_readonly("format", &Inspection::format)
      .def_readonly("vertices", &Inspection::vertices, "As read.")
      .def_readonly("triangles", &Inspection::triangles, "As read.")
      .def_readonly("checks", &Inspection::checks, "How many of each fault.")
      .def_readonly("first_crossing", &Inspection::first_crossing,
                    "Two triangles that run through each other, after the repairs; or None.")
      .def_readonly("repairs", &Inspection::repairs, "What was mended, one line each.")
      .def_readonly("shells", &Inspection::shells)
      .def_readonly("error", &Inspection::error, "Why it bounds no solid; empty: it does.")
      .def_readonly("solid", &Inspection::solid, "Where it does, else None.")
      .def("__bool__", [](const Inspection& seen) { return seen.solid.has_value(); })
      .def("__repr__", [](const Inspection& seen) {
        return "Inspection(" +
               (seen.solid ? "a solid of " + std::to_string(seen.solid->volume) + " mm^3" : seen.error) + ")";
      });
  m.def(
      "inspect",
      [](const std::filesystem::path& file, double mm_per_unit, double density, const Mending& mending) {
        const py::gil_scoped_release released;
        return inspect(file, mm_per_unit, density, mending);
      },
      py::arg("file"), py::arg("mm_per_unit") = 1.0, py::arg("density") = 1.0, py::arg("mending") = Mending(),
      "Checks, repairs, shells; as a solid its mass properties. That it is no solid is an answer, no error.");
  m.def(
      "inspect",
      [](const Vertices& vertices, const Faces& faces, double density, const Mending& mending) {
        Mesh mesh = mesh_of(vertices, faces);
        const py::gil_scoped_release released;
        return inspect(std::move(mesh), density, mending);
      },
      py::arg("vertices"), py::arg("faces"), py::arg("density") = 1.0, py::arg("mending") = Mending());
}

}  // namespace kreisel::python
