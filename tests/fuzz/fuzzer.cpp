// fuzzer.cpp - one reader under libFuzzer, which learns from coverage what to feed it: KREISEL_FED says
// which.
#include <cstddef>
#include <cstdint>

#include "fuzz/feed.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
#ifdef KREISEL_FED_EXPERIMENT
  kreisel::core::fuzz::feed_experiment(bytes);
#elif defined(KREISEL_FED_GCODE)
  kreisel::core::fuzz::feed_gcode(bytes);
#else
  kreisel::core::fuzz::feed_mesh(KREISEL_FED, bytes);
#endif
  return 0;
}
