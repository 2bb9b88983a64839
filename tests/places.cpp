#include "places.hpp"

namespace kreisel::core {

const char* const bench_program = KREISEL_BUILD "/bench";
const char* const design_program = KREISEL_BUILD "/design";
const char* const cgal_check_program = KREISEL_BUILD "/tests/outside/cgal_check";
const char* const cgal_union_program = KREISEL_BUILD "/tests/outside/cgal_union";
const char* const source_folder = KREISEL_SOURCE;

}  // namespace kreisel::core
