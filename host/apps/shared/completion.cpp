#include "apps/shared/completion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "apps/shared/completion_scripts.hpp"
#include "unknown_name.hpp"

namespace kreisel::core::apps {
namespace {

struct Script {
  std::string_view name;
  const char* text;
};

/// Not constants: the texts are of another file.
std::array<Script, 3> scripts() {
  return {{{"bash", completion_bash}, {"zsh", completion_zsh}, {"fish", completion_fish}}};
}

/// CLI11's options have no room for it.
std::map<const CLI::Option*, Choices>& offers() {
  static std::map<const CLI::Option*, Choices> all;
  return all;
}

constexpr const char* files = "/";

std::vector<std::string> values_of(const CLI::Option& option) {
  std::vector<std::string> values;
  if (const auto found = offers().find(&option); found != offers().end()) values = found->second();
  const std::string type = option.get_type_name();
  if (type.find("FILE") != std::string::npos || type.find("FOLDER") != std::string::npos)
    values.emplace_back(files);
  return values;
}

std::vector<std::string> names_of_options(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

/// Reads a line word by word, as the parser would, but takes what it has no value for yet.
class Line {
 public:
  explicit Line(const CLI::App& app) : app_(&app) {}

  void read(std::span<const std::string> words) {
    for (std::size_t i = 0; i < words.size(); ++i) {
      if (words[i] == ":")
        ++i;  // and the rest of a value
      else if (words[i] != "=")
        read(words[i]);
    }
  }

  /// What may come, before it is known how it begins.
  [[nodiscard]] std::vector<std::string> next(const std::string& begun) const {
    if (begun.starts_with('-')) {
      const std::size_t equals = begun.find('=');
      const CLI::Option* option =
          equals == std::string::npos ? nullptr : app_->get_option_no_throw(begun.substr(0, equals));
      if (!option) return names_of_options(*app_);
      std::vector<std::string> values = values_of(*option);
      std::erase(values, files);
      for (std::string& value : values) value.insert(0, begun, 0, equals + 1);
      return values;
    }
    if (open_) return values_of(*open_);
    std::vector<std::string> all;
    if (arguments_ == 0)
      for (const CLI::App* command : app_->get_subcommands(nullptr)) all.push_back(command->get_name());
    if (const CLI::Option* argument = next_argument())
      std::ranges::copy(values_of(*argument), std::back_inserter(all));
    return all.empty() ? names_of_options(*app_) : all;
  }

 private:
  void read(const std::string& word) {
    if (word.starts_with('-') && word.size() > 1) {
      const std::size_t equals = word.find('=');
      const CLI::Option* option = app_->get_option_no_throw(word.substr(0, equals));
      left_ = option && equals == std::string::npos ? option->get_items_expected_max() : 0;
      open_ = left_ > 0 ? option : nullptr;
    } else if (open_) {
      if (--left_ == 0) open_ = nullptr;
    } else if (const CLI::App* command = command_of(word); command && arguments_ == 0) {
      app_ = command;
    } else {
      ++arguments_;
    }
  }

  [[nodiscard]] const CLI::App* command_of(const std::string& name) const {
    for (const CLI::App* command : app_->get_subcommands(nullptr))
      if (command->get_name() == name) return command;
    return nullptr;
  }

  /// The argument without a name that is due.
  [[nodiscard]] const CLI::Option* next_argument() const {
    int before = arguments_;
    for (const CLI::Option* option : app_->get_options()) {
      if (!option->get_positional()) continue;
      if (before < option->get_items_expected_max()) return option;
      before -= option->get_items_expected_max();
    }
    return nullptr;
  }

  const CLI::App* app_;
  const CLI::Option* open_ = nullptr;  ///< an option that takes the next word
  int left_ = 0;                       ///< of such words
  int arguments_ = 0;                  ///< without a name, so far
};

}  // namespace

void offer(CLI::Option* option, Choices choices) {
  if (choices) offers()[option] = std::move(choices);
}

std::vector<std::string> candidates(const CLI::App& app, std::span<const std::string> words) {
  const std::string begun = words.empty() ? "" : words.back();
  Line line(app);
  line.read(words.first(words.empty() ? 0 : words.size() - 1));
  std::vector<std::string> all = line.next(begun);
  std::erase_if(all, [&](const std::string& word) { return word != files && !word.starts_with(begun); });
  return all;
}

CLI::App* add_completion(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("completion", "print a script that lets bash, zsh or fish complete words");
  offer(command
            ->add_option_function<std::string>(
                "shell",
                [program = app.get_name()](const std::string& shell) {
                  const auto all = scripts();
                  const auto script = std::ranges::find(all, shell, &Script::name);
                  if (script == all.end()) throw unknown_name("shell", shell, names_of(all));
                  std::string text = script->text;
                  const std::string_view name = "@program@";
                  for (std::size_t at; (at = text.find(name)) != std::string::npos;)
                    text.replace(at, name.size(), program);
                  fmt::print("{}", text);
                },
                "bash, zsh or fish")
            ->required(),
        names_in(scripts));
  return command;
}

bool completes(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || std::string_view(argv[1]) != "complete") return false;
  for (const std::string& word : candidates(app, std::vector<std::string>(argv + 2, argv + argc)))
    fmt::print("{}\n", word);
  return true;
}

}  // namespace kreisel::core::apps
