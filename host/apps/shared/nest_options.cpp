#include "apps/shared/nest_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "run/nest_config.hpp"

namespace kreisel::core::apps {

void add_nest_fields(CLI::App& app, std::vector<std::pair<std::string, std::string>>& given,
                     std::initializer_list<std::string_view> some) {
  for (const NestField& field : nest_fields()) {
    if (some.size() > 0 && std::ranges::find(some, field.name) == some.end()) continue;
    CLI::Option* option = app.add_option_function<std::vector<std::string>>(
        fmt::format("--{}", field.name),
        [&given, name = std::string(field.name)](const std::vector<std::string>& words) {
          given.emplace_back(name, fmt::format("{}", fmt::join(words, " ")));
        },
        std::string(field.help));
    if (field.words > 0)
      option->expected(field.words);
    else
      option->allow_extra_args(false);  // given once for each
  }
}

}  // namespace kreisel::core::apps
