// mesh_file.hpp - a whole file and the name it goes by in messages.
#pragma once

#include <string>

namespace kreisel::core {

struct MeshFile {
  std::string name;
  std::string bytes;
};

}  // namespace kreisel::core
