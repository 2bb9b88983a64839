// run_options.hpp - the fields of runs as options of a command line.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "run/run.hpp"

namespace kreisel::core::apps {

/// Collects what options say of a run; what set_field() refuses is refused when all is parsed.
class RunOptions {
 public:
  using Names = std::vector<std::string_view>;

  /// Options by the names of the fields of these kinds (option_of()), with the help that their table has, in
  /// its order.
  void add(CLI::App& app, const std::vector<const RunKind*>& kinds) { add_but(app, kinds, {}); }
  void add_some(CLI::App& app, const std::vector<const RunKind*>& kinds, const Names& some);
  void add_but(CLI::App& app, const std::vector<const RunKind*>& kinds, const Names& but);
  /// The field "model" as an argument without a name, too, and required.
  void add_model(CLI::App& app);
  /// An option of another name, or with other help.
  void add(CLI::App& app, const std::string& option, const std::string& field, const std::string& help);
  /// --set GROUP.NAME=VALUE, of the groups that the kind takes
  void add_settings(CLI::App& app, const RunKind& kind);

  void say(const std::string& field, const std::string& text) { given_.push_back({field, text}); }

  /// What was given: fields, then settings. @throws InputError  a setting that is not GROUP.NAME=VALUE
  [[nodiscard]] std::vector<GivenText> given() const;
  /// @throws InputError  as set_field()
  void apply(RunConfig& config) const;
  [[nodiscard]] Run make(const RunKind& kind) const { return make_run(given(), kind); }

 private:
  void add(CLI::App& app, const Field<Run>& field);

  std::vector<GivenText> given_;
  std::vector<std::string> settings_;
};

/// All kinds of nestings. @return  those of run_kinds()
[[nodiscard]] std::vector<const RunKind*> nesting_kinds();

}  // namespace kreisel::core::apps
