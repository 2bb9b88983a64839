#include "apps/shared/manual.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/shared/exit_code.hpp"
#include "session/build_info.hpp"

namespace kreisel::core::apps {
namespace {

/// Text that roff prints as it stands; what is between ` and ` in bold.
std::string escaped(std::string_view text) {
  std::string out;
  bool bold = false;
  for (const char c : text) switch (c) {
      case '\\':
        out += "\\e";
        break;
      case '-':
        out += "\\-";
        break;
      case '\'':
        out += "\\(aq";
        break;
      case '`':
        out += (bold = !bold) ? "\\fB" : "\\fR";
        break;
      default:
        out += c;
    }
  return out.starts_with('.') ? "\\&" + out : out;
}

std::string capitals(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

/// An entry: what is typed, and what that does.
std::string entry(const std::string& typed, const std::string& does) {
  return fmt::format(".TP\n{}\n{}\n", typed, does);
}

std::string option_entry(const CLI::Option& option) {
  std::string typed = option.get_positional() && !option.nonpositional()
                          ? fmt::format("\\fI{}\\fR", escaped(option.get_name(true)))
                          : fmt::format("\\fB{}\\fR", escaped(option.get_name(false, true)));
  const std::string value = option.get_type_name();
  if (option.get_items_expected_max() > 0 && !value.empty())
    typed += fmt::format(" \\fI{}\\fR", escaped(value));
  std::string does = option.get_description();
  if (!option.get_default_str().empty()) does += fmt::format("; default {}", option.get_default_str());
  if (option.get_required()) does += "; required";
  return entry(typed, escaped(does));
}

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

/// In the groups of the help; a group of one kind stands under its name.
std::string options_of(const CLI::App& app) {
  std::string out;
  std::vector<std::string> groups;
  for (const CLI::Option* option : app.get_options())
    if (std::ranges::find(groups, option->get_group()) == groups.end()) groups.push_back(option->get_group());
  for (const std::string& group : groups) {
    if (group.empty()) continue;  // hidden
    out += fmt::format(".PP\n\\fI{}\\fR\n", escaped(group));
    for (const CLI::Option* option : app.get_options())
      if (option->get_group() == group) out += option_entry(*option);
  }
  return out;
}

/// Lines as they stand: what a footer gives as examples.
std::string as_typed(const std::string& footer) {
  if (footer.empty()) return "";
  std::string out = ".PP\n.nf\n";
  std::size_t begin = 0;
  while (begin < footer.size()) {
    const std::size_t end = std::min(footer.find('\n', begin), footer.size());
    out += escaped(footer.substr(begin, end - begin)) + "\n";
    begin = end + 1;
  }
  return out + ".fi\n";
}

std::string exit_codes() {
  const std::array<std::pair<ExitCode, std::string_view>, 7> codes = {
      {{done, "done"},
       {slower_than_allowed, "slower than `bench compare --fail-above` allows"},
       {bad_input, "bad input or use: one line says what was expected"},
       {infeasible, "no interior does what was asked: by how much it is missed is said"},
       {not_converged, "the solver did not converge, or memory ran out"},
       {not_as_asked, "the part of `design` was written, and does not do what was asked"},
       {was_interrupted, "interrupted"}}};
  std::string out;
  for (const auto& [code, meaning] : codes)
    out += entry(fmt::format("\\fB{}\\fR", int{code}), escaped(meaning));
  return out;
}

}  // namespace

std::string manual(const CLI::App& app) {
  const std::string name = app.get_name();
  std::string out =
      fmt::format(".TH {} 1 \"\" \"kreisel {}\" \"User Commands\"\n", capitals(name), build_info::version);
  out += fmt::format(".SH NAME\n{} \\- {}\n", name, escaped(app.get_description()));
  out += fmt::format(
      ".SH SYNOPSIS\n\\fB{0}\\fR [\\fIOPTIONS\\fR]\n.br\n\\fB{0}\\fR \\fICOMMAND\\fR [\\fIOPTIONS\\fR] ...\n",
      name);
  out += ".SH OPTIONS\n" + options_of(app);
  out += ".SH COMMANDS\n";
  for (const CLI::App* command : commands_of(app)) {
    out += fmt::format(".SS {} {}\n{}\n", name, command->get_name(), escaped(command->get_description()));
    out += options_of(*command) + as_typed(command->get_footer());
  }
  if (!app.get_footer().empty()) out += ".SH EXAMPLES\n" + as_typed(app.get_footer());
  return out + ".SH EXIT STATUS\n" + exit_codes();
}

bool prints_manual(const CLI::App& app, int argc, char** argv) {
  if (argc != 2 || std::string_view(argv[1]) != "manual") return false;
  fmt::print("{}", manual(app));
  return true;
}

}  // namespace kreisel::core::apps
