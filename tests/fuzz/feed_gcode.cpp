#include <cmath>
#include <cstdlib>

#include "error.hpp"
#include "fuzz/feed.hpp"
#include "print/gcode/read.hpp"

namespace kreisel::core::fuzz {

void feed_gcode(const std::string& text) try {
  // In two blocks, as a line may lie in both.
  GcodeReader reader("fed.gcode");
  reader.feed(std::string_view(text).substr(0, text.size() / 2));
  reader.feed(std::string_view(text).substr(text.size() / 2));
  const Print print = reader.finish();
  // What is read has a mass.
  if (!print.part_mass().allFinite() || !(print.part_volume() > 0)) std::abort();
} catch (const InputError&) {
}

}  // namespace kreisel::core::fuzz
