#include "error.hpp"
#include "experiment/experiment.hpp"
#include "fuzz/feed.hpp"

namespace kreisel::core::fuzz {

void feed_experiment(const std::string& text) try {
  (void)parse_experiment(text, "fed.toml");
} catch (const InputError&) {
}

}  // namespace kreisel::core::fuzz
