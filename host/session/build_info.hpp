// build_info.hpp - what this program was built from; written by cmake/build_info.cmake at every build.
#pragma once

namespace kreisel::core::build_info {

extern const char* const version;
extern const char* const commit;
extern const char* const compiler;
extern const char* const build_type;

}  // namespace kreisel::core::build_info
