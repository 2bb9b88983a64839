// run_options.hpp - the fields of a run as options of a command line.
#pragma once

#include <CLI/CLI.hpp>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "session/config.hpp"

namespace kreisel::core::apps {

/// Collects what options say of a run; what set_field() refuses is refused when all is parsed.
class RunOptions {
 public:
  /// @param field  as set_field() takes it
  void add(CLI::App& app, const std::string& option, const std::string& field, const std::string& help);
  /// Options by the names of these fields (of problem.NAME by the name alone, with - for _), in the order in
  /// which --help lists them; no names: all there are. Among a few, "model" is an argument without a name,
  /// too, and required.
  void add(CLI::App& app, std::initializer_list<std::string_view> fields = {});
  /// --set GROUP.NAME=VALUE
  void add_settings(CLI::App& app, const std::string& help);

  void say(const std::string& field, const std::string& text) { given_.emplace_back(field, text); }

  /// @throws InputError  as set_field(); a setting that is not GROUP.NAME=VALUE
  void apply(RunConfig& config) const;

 private:
  std::vector<std::pair<std::string, std::string>> given_;  ///< field, text
  std::vector<std::string> settings_;
};

}  // namespace kreisel::core::apps
