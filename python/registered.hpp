// registered.hpp - the parts of kreisel._core that have files of their own.
#pragma once

#include <pybind11/pybind11.h>

namespace kreisel::python {

void add_inspections(pybind11::module_& m);
void add_problems(pybind11::module_& m);

}  // namespace kreisel::python
