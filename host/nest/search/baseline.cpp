#include "nest/search/baseline.hpp"

#include "unknown_name.hpp"

namespace kreisel::core::nest {

const BaselineEntry& find_baseline(std::string_view name) {
  for (const BaselineEntry& entry : baselines)
    if (entry.name == name) return entry;
  throw unknown_name("variant", name, names_of(baselines));
}

}  // namespace kreisel::core::nest
