#include "apps/shared/run_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

#include "apps/shared/completion.hpp"
#include "error.hpp"
#include "words.hpp"

namespace kreisel::core::apps {
namespace {

/// What its help and shells say of its value.
void describe(const Field<Run>& field, CLI::Option* option) {
  if (field.shapes)
    option->type_name("NAME|FILE");
  else if (!field.unit.empty())
    option->type_name(std::string(field.unit));
  offer(option, field.choices);
  std::string group(field.group);
  if (group.empty()) return;
  group[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(group[0])));
  option->group(group);
}

bool among(const RunOptions::Names& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

/// Those of all kinds, each once.
Fields<Run> fields_of(const std::vector<const RunKind*>& kinds) {
  Fields<Run> all;
  for (const RunKind* kind : kinds)
    for (const Field<Run>& field : kind->fields)
      if (!find_field(all, field.name)) all.push_back(field);
  return all;
}

}  // namespace

void RunOptions::add(CLI::App& app, const std::string& option, const std::string& field,
                     const std::string& help) {
  const auto kind = std::ranges::find_if(
      run_kinds(), [&](const RunKind& one) { return find_field(one.fields, field) != nullptr; });
  describe(*find_field(kind->fields, field),
           app.add_option_function<std::string>(
               option, [this, field](const std::string& text) { say(field, text); }, help));
}

void RunOptions::add_model(CLI::App& app) {
  const Field<Run>* model = find_field(find_run_kind("solve").fields, "model");
  const std::string help(model->help.substr(0, model->help.find("; default")));  // here it must be named
  add(app, "model,--model", "model", help);
  app.get_option("--model")->required();
}

void RunOptions::add(CLI::App& app, const Field<Run>& field) {
  const std::string option = "--" + option_of(field), help(field.help), name(field.name);
  CLI::Option* added = nullptr;
  if (field.words == 1) {
    added = app.add_option_function<std::string>(
        option,
        [this, name, alone = std::string(field.alone)](const std::string& text) {
          say(name, text.empty() || text == "true" ? alone : text);  // as CLI11 calls no value
        },
        help);
    if (!field.alone.empty()) added->expected(0, 1);
  } else {
    added = app.add_option_function<std::vector<std::string>>(
        option, [this, name](const std::vector<std::string>& words) { say(name, joined_words(words)); },
        help);
    if (field.words > 1) added->expected(field.words);
  }
  describe(field, added);
}

void RunOptions::add_some(CLI::App& app, const std::vector<const RunKind*>& kinds, const Names& some) {
  for (const Field<Run>& field : fields_of(kinds))
    if (among(some, field.name)) add(app, field);
}

void RunOptions::add_but(CLI::App& app, const std::vector<const RunKind*>& kinds, const Names& but) {
  for (const Field<Run>& field : fields_of(kinds))
    if (!among(but, field.name)) add(app, field);
}

void RunOptions::add_settings(CLI::App& app, const RunKind& kind) {
  offer(app.add_option("--set", settings_,
                       fmt::format("a setting that has no option of its own; groups: {}",
                                   fmt::join(kind.groups, ", ")))
            ->allow_extra_args(false)
            ->group("Settings")
            ->type_name("GROUP.NAME=VALUE"),
        [groups = kind.groups] {
          std::vector<std::string> begun;
          for (const std::string& name : setting_names(groups)) begun.push_back(name + "=");
          return begun;
        });
}

std::vector<GivenText> RunOptions::given() const {
  std::vector<GivenText> all = given_;
  for (const std::string& setting : settings_) {
    const auto equals = setting.find('=');
    const auto dot = setting.find('.');
    if (equals == std::string::npos || dot == std::string::npos || dot > equals)
      throw InputError(fmt::format("--set {}; expected GROUP.NAME=VALUE", setting));
    all.push_back({setting.substr(0, equals), setting.substr(equals + 1)});
  }
  return all;
}

void RunOptions::apply(RunConfig& config) const {
  for (const GivenText& field : given()) set_field(config, field.name, field.text);
  require_settings(config);
}

std::vector<const RunKind*> nesting_kinds() {
  std::vector<const RunKind*> all;
  for (const RunKind& kind : run_kinds())
    if (std::holds_alternative<NestConfig>(kind.empty)) all.push_back(&kind);
  return all;
}

}  // namespace kreisel::core::apps
