#include "problem/spin.hpp"

#include <fmt/format.h>

#include "error.hpp"
#include "parse.hpp"

namespace kreisel::core {

std::unique_ptr<Problem> make_spin(const ProblemSettings& settings, const Body&) {
  SpinOptions options;
  for (const auto& [name, text] : settings) {
    const double value = parse<double>(text).value_or(-1);
    if (name == "lambda" && value >= 0)
      options.lambda = value;
    else if (name == "gamma_i" && value > 0)
      options.gamma_i = value;
    else
      throw InputError(
          fmt::format("problem.{} = {} for spin; expected lambda >= 0 or gamma_i > 0", name, text));
  }
  return std::make_unique<Spin>(options);
}

}  // namespace kreisel::core
