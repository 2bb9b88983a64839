// part_fields.hpp - how a part is finished, as fields: by the names of `design`'s options.
#pragma once

#include "design/design.hpp"
#include "settings/field.hpp"

namespace kreisel::core::live {

struct PartSpec : DesignSpec {
  std::string format = "stl";  ///< of the files that are sent
};

[[nodiscard]] const Fields<PartSpec>& part_fields();

}  // namespace kreisel::core::live
