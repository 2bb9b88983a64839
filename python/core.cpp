// core.cpp - kreisel._core: the public headers in Python.
#include <pybind11/eigen.h>
#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <kreisel/kreisel.hpp>

#include "arrays.hpp"
#include "control.hpp"
#include "question.hpp"
#include "registered.hpp"

namespace py = pybind11;
using namespace kreisel;
using namespace kreisel::python;

namespace {

const char* name_of(Solution::End end) {
  switch (end) {
    case Solution::End::optimal:
      return "optimal";
    case Solution::End::acceptable:
      return "acceptable";
    case Solution::End::infeasible:
      return "infeasible";
    case Solution::End::failed:
      break;
  }
  return "failed";
}

/// What a callback of nest() is told.
struct Iteration {
  int iteration;
  double scale;
};

Mesh shape_of(const py::object& shape) {
  if (py::isinstance<Body>(shape)) return shape.cast<const Body&>().mesh();
  const auto pair = value_of<std::pair<Vertices, Faces>>("shape", shape, "a Body, or vertices and faces");
  return mesh_of(pair.first, pair.second);
}

Nesting nested(const py::object& outer, const py::object& inner, const py::object& on_iteration,
               const py::kwargs& fields) {
  std::map<std::string, std::string> text;
  for (const auto& [key, value] : fields) {
    std::string name = key.cast<std::string>();
    std::ranges::replace(name, '_', '-');
    text[name] = field_text(value);
  }
  const Mesh a = shape_of(outer), b = inner.is_none() ? a : shape_of(inner);
  std::function<bool(int, double)> told;
  if (!on_iteration.is_none())
    told = [&](int iteration, double scale) {
      const py::gil_scoped_acquire held;
      const py::object answer = on_iteration(Iteration{iteration, scale});
      return answer.is_none() || answer.cast<bool>();
    };
  return without_gil([&](const Control& control) { return nest(a, b, text, told, control); });
}

void add_errors(py::module_& m) {
  static py::exception<Error> error(m, "Error", PyExc_RuntimeError);
  static py::exception<InputError> input_error(m, "InputError",
                                               py::make_tuple(error, py::handle(PyExc_ValueError)));
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const InputError& e) {
      input_error(e.what());
    } catch (const Error& e) {
      error(e.what());
    }
  });
}

InsideOut way_inside_out(const std::string& word) {
  if (word == "refused") return InsideOut::refused;
  if (word == "solid") return InsideOut::solid;
  if (word == "void") return InsideOut::empty;
  throw InputError("inside_out '" + word + "'; expected refused, solid or void");
}

void add_bodies(py::module_& m) {
  py::class_<Verdict>(m, "Verdict", "Does a finished part do what was asked?")
      .def_readonly("ok", &Verdict::ok)
      .def_readonly("text", &Verdict::text, "One sentence.")
      .def_readonly("values", &Verdict::values, "The numbers behind it.")
      .def("__bool__", [](const Verdict& v) { return v.ok; })
      .def("__repr__", [](const Verdict& v) { return "Verdict(" + v.text + ")"; });

  py::class_<Device>(m, "Device", "An OpenCL device, shared by sessions.")
      .def(py::init<const std::string&>(), py::arg("selector") = "",
           "Opens it: an index or part of a name; empty: $KREISEL_DEVICE, a GPU, PoCL, the first there is.")
      .def_property_readonly("name", &Device::name);

  py::class_<Mending>(m, "Mending",
                      "How far a mesh may be mended to become a solid, beyond what changes nothing.")
      .def(py::init([](std::optional<double> weld, std::optional<double> close_holes,
                       const std::string& inside_out, const std::vector<int>& pieces) {
             return Mending{weld, close_holes, way_inside_out(inside_out), pieces};
           }),
           py::arg("weld") = py::none(), py::arg("close_holes") = py::none(),
           py::arg("inside_out") = "refused", py::arg("pieces") = std::vector<int>(),
           "weld: corners at open edges that are this near, mm, are one; None: as near as the file's numbers "
           "are "
           "precise. close_holes: those no larger across, mm, are closed by a patch. inside_out: what the "
           "surface "
           "encloses inside out is, solid, void or refused. pieces: of several that do not touch those that "
           "are "
           "meant, by weight from 1; [1] is the largest.");

  py::class_<Body>(m, "Body", "A solid, its mesh mended where that is safe, and checked. Lengths in mm.")
      .def(py::init([](const Vertices& v, const Faces& f, const Mending& mending) {
             return Body(mesh_of(v, f), mending);
           }),
           py::arg("vertices"), py::arg("faces"), py::arg("mending") = Mending(),
           "Of arrays (n, 3) and (m, 3). Raises InputError where they bound no solid.")
      .def_static(
          "read",
          [](const std::filesystem::path& file, double mm, const Mending& mending) {
            const py::gil_scoped_release released;
            return Body::read(file, mm, mending);
          },
          py::arg("file"), py::arg("mm_per_unit") = 1.0, py::arg("mending") = Mending(),
          "Reads OFF, OBJ, PLY, STL or 3MF. Raises InputError where it bounds no solid.")
      .def_static("model", &Body::model, py::arg("name"), "A model of `bench list`.")
      .def_property_readonly(
          "mesh", [](const py::object& self) { return views_of(self.cast<const Body&>().mesh(), self); },
          "Vertices (n, 3) float64 and faces (m, 3) uint32, views.")
      .def("moments", &Body::moments, "At density 1: 1 x y z xy yz xz xx yy zz, mm^3 to mm^5; (10,).")
      .def_property_readonly("repairs", &Body::repairs, "What was mended, one line each.");
}

void add_questions(py::module_& m) {
  const std::string doc = doc_of_questions();
  py::class_<Question> question(m, "Question", doc.c_str());
  question
      .def(py::init([](const py::object& problem, const py::kwargs& fields) {
             return question_of(problem, fields);
           }),
           py::arg("problem") = "spin", "A problem's name, or a Question; keywords: see the class.")
      .def(
          "replace", [](const Question& q, const py::kwargs& fields) { return replaced(q, fields); },
          "The same but for the fields given.")
      .def_property_readonly(
          "cells", [](const Question& q) { return q.domain.cells; },
          "Along the longest side; or the whole grid, three numbers.")
      .def("__eq__", [](const Question& a, const Question& b) { return a == b; })
      .def("__repr__", &repr_of);
  for (const QuestionField& field : question_fields())
    if (field.keyword != "cells")
      question.def_property_readonly(
          field.keyword.c_str(),
          [name = field.name](const Question& q) { return value_of_text(text_of(q, name)); },
          help_of(field).c_str());
}

void add_solutions(py::module_& m) {
  py::class_<Deformation>(m, "Deformation", "What became of a body whose shape was free to change; mm.")
      .def_readonly("reached", &Deformation::reached, "all (that was asked), constraints or nothing.")
      .def_readonly("largest_mm", &Deformation::largest_mm, "Largest displacement of a vertex.")
      .def_readonly("largest_percent", &Deformation::largest_percent, "The same, of the longest side.")
      .def_readonly("where", &Deformation::where, "Where that vertex was.")
      .def_readonly("volume_before_mm3", &Deformation::volume_before_mm3)
      .def_readonly("volume_after_mm3", &Deformation::volume_after_mm3)
      .def_readonly("least_determinant", &Deformation::least_determinant,
                    "Of the motion: how much space shrinks anywhere.")
      .def_property_readonly(
          "before",
          [](const py::object& self) { return views_of(self.cast<const Deformation&>().before, self); },
          "(vertices, triangles): (n, 3) float64 and (m, 3) uint32, read-only.")
      .def_property_readonly(
          "after",
          [](const py::object& self) { return views_of(self.cast<const Deformation&>().after, self); },
          "The same after: vertex i was vertex i of before.");
  py::class_<Solution>(m, "Solution", "The answer to a question, before anything is meshed.")
      .def_readonly("question", &Solution::question)
      .def_property_readonly(
          "end", [](const Solution& s) { return name_of(s.end); },
          "optimal, acceptable, infeasible or failed.")
      .def_property_readonly("feasible", &Solution::feasible)
      .def_readonly("message", &Solution::message, "The solver's own words.")
      .def_readonly("objective", &Solution::objective)
      .def_readonly("violation", &Solution::violation, "Largest of the constraints, body units.")
      .def_property_readonly(
          "moments",
          [](const py::object& self) { return view_of(self.cast<const Solution&>().moments, self); },
          "Of the whole solid: g, g mm, g mm^2; (10,).")
      .def_property_readonly(
          "quadric_body",
          [](const py::object& self) -> py::object {
            const auto& q = self.cast<const Solution&>().quadric_body;
            if (!q) return py::none();
            return view_of(*q, self);
          },
          "Negative where the heavier material goes, body frame and units; (10,), or None.")
      .def_property_readonly("variables",
                             [](const py::object& self) {
                               const auto& x = self.cast<const Solution&>().variables;
                               py::array_t<double> view(
                                   std::vector<py::ssize_t>{static_cast<py::ssize_t>(x.size())}, x.data(),
                                   self);
                               view.attr("flags").attr("writeable") = false;
                               return view;
                             })
      .def_readonly("bound", &Solution::bound,
                    "No interior of the domain has less; None where not asked for.")
      .def_readonly("deformation", &Solution::deformation,
                    "Deformation, where the question asked for one (deform=\"least\" or \"5%\"); else None.")
      .def_readonly("unmet", &Solution::unmet, "Where infeasible: what cannot be met.")
      .def_readonly("verdict", &Solution::verdict, "Of these moments; not of a mesh.")
      .def_readonly("rotation", &Solution::rotation, "x_body = rotation (x - origin) / length_mm")
      .def_readonly("origin", &Solution::origin)
      .def_readonly("length_mm", &Solution::length_mm)
      .def_readonly("setup_seconds", &Solution::setup_seconds)
      .def_readonly("solve_seconds", &Solution::solve_seconds)
      .def("__repr__", [](const Solution& s) {
        return std::string("Solution(") + name_of(s.end) + ", objective=" + std::to_string(s.objective) + ")";
      });
}

void add_parts(py::module_& m) {
  py::class_<Part>(m, "Part", "What is printed or cast, in memory.")
      .def_property_readonly(
          "meshes",
          [](const py::object& self) {
            py::list all;
            for (const Mesh& mesh : self.cast<const Part&>().meshes) all.append(views_of(mesh, self));
            return all;
          },
          "Vertices and faces of each closed solid, views.")
      .def_readonly("names", &Part::names)
      .def_readonly("densities", &Part::densities, "g/cm^3")
      .def_property_readonly(
          "moments", [](const py::object& self) { return view_of(self.cast<const Part&>().moments, self); },
          "Of all solids: g, g mm, g mm^2; (10,).")
      .def_readonly("voids", &Part::voids)
      .def_readonly("wall_mm", &Part::wall_mm)
      .def_readonly("thinnest", &Part::thinnest, "mm")
      .def_readonly("verdict", &Part::verdict)
      .def("write", &Part::write, py::arg("file"), py::call_guard<py::gil_scoped_release>(),
           "Writes STL, OFF, OBJ, PLY or 3MF whole or not at all; returns the files.");

  py::class_<Map>(m, "Map", "Where a body can spin, or float.")
      .def_property_readonly("axes", [](const Map& map) { return map.axes; })
      .def_property_readonly("contacts", [](const Map& map) { return map.contacts; })
      .def_property_readonly("feasible", [](const Map& map) { return map.feasible; })
      .def_property_readonly("ok", [](const Map& map) { return map.ok; })
      .def_property_readonly("objective", [](const Map& map) { return map.objective; })
      .def_readonly("best_index", &Map::best)
      .def("question", &Map::question, py::arg("i"), "The question of one axis.");
}

void add_sessions(py::module_& m) {
  py::class_<Session>(m, "Session", "A body with its domain, kept between questions. One thread at a time.")
      .def(
          py::init([](const Body& body, const std::string& device) { return Session(body, Device(device)); }),
          py::arg("body"), py::arg("device") = "")
      .def(py::init([](const Body& body, const Device& device) { return Session(body, device); }),
           py::arg("body"), py::arg("device"))
      .def(
          "solve",
          [](Session& s, const py::object& question, const py::kwargs& fields) {
            const Question asked = question_of(question, fields);
            return without_gil([&](const Control& control) { return s.solve(asked, control); });
          },
          py::arg("question") = "spin",
          "Solves a Question, or the problem of that name; keywords are fields of Question.")
      .def(
          "part",
          [](Session& s, const Solution& solution, double accuracy, const std::string& cut, double pegs,
             double drain, bool lay_flat, std::optional<double> tolerance) {
            const PartSpec spec{accuracy, cut == "none" ? "" : cut, pegs, drain, lay_flat, tolerance};
            return without_gil([&](const Control& control) { return s.part(solution, spec, control); });
          },
          py::arg("solution"), py::kw_only(), py::arg("accuracy") = 0.4, py::arg("cut") = "none",
          py::arg("pegs") = 0.0, py::arg("drain") = 0.0, py::arg("lay_flat") = false,
          py::arg("tolerance") = py::none(), "Meshes, finishes and judges the part; lengths in mm.")
      .def(
          "remedies",
          [](Session& s, const Solution& solution) {
            return without_gil([&](const Control& control) { return s.remedies(solution, control); });
          },
          py::arg("solution"), "Of an infeasible solution: what would help.")
      .def(
          "_map",
          [](Session& s, const py::object& question, int axes, bool centre, const py::kwargs& fields) {
            const Question asked = question_of(question, fields);
            return without_gil([&](const Control& control) { return s.map(asked, axes, centre, control); });
          },
          py::arg("question"), py::arg("axes"), py::arg("centre"))
      .def_property_readonly("made", &Session::made, "The stages that the last question made anew.");

  m.def(
      "verify",
      [](const std::vector<std::filesystem::path>& files, const Body& body, const py::object& question,
         const py::kwargs& fields) {
        const Question asked = question_of(question, fields);
        const py::gil_scoped_release released;
        return verify(files, body, asked);
      },
      py::arg("files"), py::arg("body"), py::arg("question") = "spin",
      "Reads the files of a part again and judges them; keywords are fields of Question.");
  m.def(
      "question_fields",
      [] {
        py::dict all;
        for (const QuestionField& field : question_fields()) all[py::str(field.keyword)] = help_of(field);
        return all;
      },
      "The keywords of Question, with what each says.");
}

void add_nests(py::module_& m) {
  py::class_<Iteration>(m, "Iteration", "What the callback of nest() is told.")
      .def_readonly("iteration", &Iteration::iteration)
      .def_readonly("scale", &Iteration::scale, "The best so far.");
  py::class_<Nesting>(m, "Nesting", "One shape in another, a cut and the ways out.")
      .def_readonly("valid", &Nesting::valid)
      .def_readonly("scale", &Nesting::scale)
      .def_readonly("certified_scale", &Nesting::certified_scale)
      .def_readonly("transform", &Nesting::transform, "(3, 4): the inner mesh's coordinates to the outer's.")
      .def_readonly("plane_point", &Nesting::plane_point)
      .def_readonly("plane_normal", &Nesting::plane_normal)
      .def_readonly("plus", &Nesting::plus)
      .def_readonly("minus", &Nesting::minus)
      .def_readonly("text", &Nesting::text)
      .def_readonly("seconds", &Nesting::seconds)
      .def("__repr__", [](const Nesting& n) { return "Nesting(" + n.text + ")"; });
  m.def("nest", &nested, py::arg("outer"), py::arg("inner") = py::none(),
        py::arg("on_iteration") = py::none(),
        "How large a copy nests inside, and can be taken out. Keywords are the fields of `bench nest`: "
        "free=\"all\", seconds=10, scale=0.5. The callback's False ends a search and keeps the best.");
}

}  // namespace

PYBIND11_MODULE(_core, m) {
  m.doc() = "Kreisel's compiled part. Use the package kreisel.";
  add_errors(m);
  add_bodies(m);
  add_questions(m);
  add_solutions(m);
  add_parts(m);
  add_sessions(m);
  add_nests(m);
  add_inspections(m);
  add_problems(m);
}
