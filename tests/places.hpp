#pragma once

namespace kreisel::core {

/// Where the programs of this build, and the sources, lie. Only places.cpp knows, so that all other tests
/// compile the same in every checkout (a compiler cache then serves them all).
extern const char* const bench_program;
extern const char* const design_program;
extern const char* const cgal_check_program;  ///< this and the next: absent where CGAL is
extern const char* const cgal_union_program;
extern const char* const source_folder;

}  // namespace kreisel::core
