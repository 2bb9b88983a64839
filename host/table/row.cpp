#include "table/row.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <muParser.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <set>

#include "error.hpp"
#include "table/columns.hpp"
#include "table/provenance_text.hpp"

namespace kreisel::core {
namespace {

using nlohmann::json;

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(' ');
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(' ') + 1 - first);
}

/// A value as conditions compare it.
std::string plain_text(const json& value) { return cell_of(value, "", ",").data; }

json named(const RecordedRun& run, const json& item, std::string_view name) {
  constexpr std::string_view of_item = "item.";
  return name.starts_with(of_item) ? value_in(item, name.substr(of_item.size())) : value_of(run, name);
}

struct Operand {
  std::string_view name, choice;
  bool converged = false;
};

Operand parsed(std::string_view text) {
  Operand operand;
  const std::size_t bracket = text.find('[');
  operand.name = text.substr(0, bracket);
  if (bracket != text.npos) operand.choice = text.substr(bracket + 1, text.size() - bracket - 2);
  constexpr std::string_view only = "converged.";
  if (operand.name.starts_with(only)) {
    operand.converged = true;
    operand.name.remove_prefix(only.size());
  }
  return operand;
}

/// "<formulation>.seconds" of a run by ray-reps: "rayrep.seconds".
std::string resolved(const RecordedRun& run, std::string_view path) {
  const std::size_t open = path.find('<'), close = path.find('>');
  if (open == path.npos || close == path.npos) return std::string(path);
  return fmt::format("{}{}{}", path.substr(0, open),
                     plain_text(value_of(run, path.substr(open + 1, close - open - 1))),
                     path.substr(close + 1));
}

json value_of_run(const Row& row, const RecordedRun& run, const Operand& operand) {
  if (operand.converged && !run.is_converged()) return nullptr;
  constexpr std::string_view of_paper = "published.";
  if (!operand.name.starts_with(of_paper)) return named(run, row.item, operand.name);
  const json* printed = row.published ? row.published->find(run) : nullptr;
  return printed ? value_in(*printed, resolved(run, operand.name.substr(of_paper.size()))) : json();
}

/// What is said of a whole table or block, not of a run.
json value_of_all(const Row& row, std::string_view name) {
  if (name == "provenance") return provenance_text(row.runs);
  if (!row.published) return nullptr;
  if (name == "paper") return fmt::format("{}; {}", row.published->source, row.published->machine);
  if (name == "published.source") return row.published->source;
  if (name == "published.machine") return row.published->machine;
  return nullptr;
}

/// The same of two runs that a ratio() compares.
std::string key_of_a_ratio(const RecordedRun& run) {
  std::string key;
  for (const std::string_view name : fields_of_a_ratio) key += plain_text(value_of(run, name)) + '\n';
  return key;
}

/// A value and the runs that it is made of.
struct Found {
  json value;
  Runs runs = {};
};

Found ratio_of(const Row& row, std::string_view arguments) {
  const std::size_t comma = arguments.find(',');
  if (comma == arguments.npos)
    throw InputError(
        fmt::format("ratio({}): expected a name and a field, as in ratio(seconds.solve, "
                    "formulation=voxel)",
                    arguments));
  if (row.runs.empty() || !row.group) return {};
  const std::string_view name = trimmed(arguments.substr(0, comma));
  const Condition choice{std::string(trimmed(arguments.substr(comma + 1)))};
  const RecordedRun& mine = *row.runs.front();
  for (const RecordedRun* other : row.group->like(mine)) {
    if (!choice.holds(*other)) continue;
    const json a = value_of(*other, name), b = value_of(mine, name);
    if (!a.is_number() || !b.is_number() || !other->is_converged() || !mine.is_converged()) return {};
    return {a.get<double>() / b.get<double>(), {&mine, other}};
  }
  return {};
}

/// As operand_of().
Found found_by(const Row& row, std::string_view text) {
  const Operand operand = parsed(text);
  if (json all = value_of_all(row, operand.name); !all.is_null()) return {std::move(all)};
  Found found;
  const Condition choice{std::string(operand.choice)};
  for (const RecordedRun* run : row.runs) {
    if (!choice.text.empty() && !choice.holds(*run)) continue;
    if (!choice.text.empty() || found.value.is_null()) found = {value_of_run(row, *run, operand), {run}};
  }
  return found;
}

bool begins_name(char c) { return std::isalpha(static_cast<unsigned char>(c)) || c == '_'; }
bool goes_on(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) ||
         std::string_view("_.<>").find(c) != std::string_view::npos;
}

/// The end of the name that begins at `at`, with its choice.
std::size_t end_of_name(std::string_view text, std::size_t at) {
  while (at < text.size() && goes_on(text[at])) ++at;
  if (at == text.size() || text[at] != '[') return at;
  const std::size_t close = text.find(']', at);
  if (close == text.npos) throw InputError(fmt::format("'{}': expected ] after [FIELD=VALUE", text));
  return close + 1;
}

/// The end of a number that begins at `at`, as 1e-3; `at` where there is none.
std::size_t end_of_number(std::string_view text, std::size_t at) {
  const auto digit = [&](std::size_t i) {
    return i < text.size() && std::isdigit(static_cast<unsigned char>(text[i]));
  };
  if (!digit(at)) return at;
  while (digit(at) || (at < text.size() && text[at] == '.')) ++at;
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    const std::size_t sign = at + 1 < text.size() && (text[at + 1] == '-' || text[at + 1] == '+') ? 2 : 1;
    if (digit(at + sign)) {
      at += sign;
      while (digit(at)) ++at;
    }
  }
  return at;
}

/// Names become variables of the arithmetic, which mu::Parser does.
class Arithmetic {
 public:
  Arithmetic(const Row& row, std::string_view text) : row_(row) {
    for (std::size_t at = 0; at < text.size();) {
      if (const std::size_t number = end_of_number(text, at); number > at) {
        formula_ += text.substr(at, number - at);
        at = number;
        continue;
      }
      if (!begins_name(text[at])) {
        formula_ += text[at++];
        continue;
      }
      const std::size_t end = end_of_name(text, at);
      const std::string_view name = text.substr(at, end - at);
      at = end;
      if (end == text.size() || text[end] != '(') {
        names_.emplace_back(name);
        variable(name, found_by(row_, name));
      } else if (name == "ratio") {
        const std::size_t close = text.find(')', end);
        if (close == text.npos) throw InputError(fmt::format("'{}': expected ) after ratio(", text));
        const std::string_view arguments = text.substr(end + 1, close - end - 1);
        names_.emplace_back(trimmed(arguments.substr(0, arguments.find(','))));
        variable(names_.back(), ratio_of(row_, arguments));
        at = close + 1;
      } else {
        formula_ += name;
      }
    }
  }

  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  [[nodiscard]] const Runs& timed() const { return timed_; }

  [[nodiscard]] json value() {
    try {
      parser_.SetExpr(formula_);
      const double value = parser_.Eval();
      return known_ && std::isfinite(value) ? json(value) : json();
    } catch (const mu::Parser::exception_type& error) {
      throw InputError(fmt::format("'{}': {}", formula_, error.GetMsg()));
    }
  }

 private:
  void variable(std::string_view of, const Found& found) {
    const json& value = found.value;
    if (of.find("seconds") != of.npos) std::ranges::copy(found.runs, std::back_inserter(timed_));
    known_ = known_ && value.is_number();
    const std::string name = fmt::format("v{}", values_.size());
    values_.push_back(value.is_number() ? value.get<double>() : 0);
    parser_.DefineVar(name, &values_.back());
    formula_ += name;
  }

  const Row& row_;
  mu::Parser parser_;
  std::string formula_;
  std::vector<std::string> names_;  ///< of its operands
  Runs timed_;                      ///< those whose times they are
  std::deque<double> values_;
  bool known_ = true;
};

}  // namespace

const Runs& RunGroup::like(const RecordedRun& run) const {
  if (alike_.empty())
    for (const RecordedRun* each : runs_) alike_[key_of_a_ratio(*each)].push_back(each);
  return alike_[key_of_a_ratio(run)];
}

bool Condition::holds(const RecordedRun& run, const json& item) const {
  std::string_view left = text;
  const bool turned = left.starts_with("not ");
  if (turned) left = trimmed(left.substr(4));
  const std::size_t at = left.find_first_of("!=~");
  bool holds = false;
  if (at == left.npos) {
    const json value = named(run, item, left);
    holds = value.is_structured() ? !value.empty() : !plain_text(value).empty();
  } else {
    const bool unequal = left[at] == '!';
    if (unequal && left.substr(at, 2) != "!=")
      throw InputError(fmt::format("condition '{}'; expected NAME=VALUE, NAME!=VALUE or NAME~VALUE", text));
    const std::string value = plain_text(named(run, item, left.substr(0, at)));
    const std::string_view wanted = left.substr(at + (unequal ? 2 : 1));
    holds = left[at] == '~' ? value.find(wanted) != value.npos : (value == wanted) != unequal;
  }
  return holds != turned;
}

bool Condition::any(const Runs& runs) const {
  constexpr std::string_view turned = "not ";
  if (text.starts_with(turned)) return !Condition{text.substr(turned.size())}.any(runs);
  return std::ranges::any_of(runs, [&](const RecordedRun* run) { return holds(*run); });
}

json operand_of(const Row& row, std::string_view text) { return found_by(row, text).value; }

std::vector<json> operands_of(const Row& row, std::string_view text) {
  const Operand operand = parsed(text);
  if (json all = value_of_all(row, operand.name); !all.is_null()) return {std::move(all)};
  std::vector<json> found;
  std::set<json> known;
  const Condition choice{std::string(operand.choice)};
  for (const RecordedRun* run : row.runs) {
    if (!choice.text.empty() && !choice.holds(*run)) continue;
    json value = value_of_run(row, *run, operand);
    if (!value.is_null() && known.insert(value).second) found.push_back(std::move(value));
  }
  return found;
}

bool is_operand(std::string_view expression) {
  constexpr std::string_view asked = "asked.";
  const std::string_view field = expression.substr(expression.starts_with(asked) ? asked.size() : 0);
  if (field.find('-') != field.npos && is_field(field)) return true;  // a name, not a difference
  return !expression.empty() && begins_name(expression.front()) &&
         end_of_name(expression, 0) == expression.size();
}

std::vector<std::string> names_in(const std::string& expression) {
  if (is_operand(expression)) return {expression};
  Arithmetic arithmetic(Row{}, expression);
  (void)arithmetic.value();
  return arithmetic.names();
}

Runs runs_in(const Row& row, const std::string& expression) { return Arithmetic(row, expression).timed(); }

json value_of(const Row& row, const std::string& expression) {
  return is_operand(expression) ? operand_of(row, expression) : Arithmetic(row, expression).value();
}

namespace {

/// One of "label|shapes|'none'", with a format behind a colon.
std::optional<std::string> text_in_place(const Row& row, std::string_view place) {
  const std::size_t colon = place.rfind(':');
  const std::string format(colon == place.npos ? "" : place.substr(colon + 1));
  (void)fmt::format(fmt::runtime("{:" + format + "}"), 1.0);  // whether or not there is a value to show
  std::string_view names = place.substr(0, colon);
  while (!names.empty()) {
    const std::size_t bar = std::min(names.find('|'), names.size());
    const std::string_view name = trimmed(names.substr(0, bar));
    names.remove_prefix(std::min(bar + 1, names.size()));
    if (name.starts_with('\'')) {
      if (name.size() < 2 || !name.ends_with('\''))
        throw InputError(fmt::format("{{{}}}: words that do not end; expected '", place));
      return std::string(name.substr(1, name.size() - 2));
    }
    std::vector<std::string> texts;
    if (is_operand(name)) {
      for (const json& value : operands_of(row, name)) texts.push_back(cell_of(value, format, ", ").text);
    } else if (const json value = value_of(row, std::string(name)); !value.is_null()) {
      texts.push_back(cell_of(value, format, ", ").text);
    }
    std::sort(texts.begin(), texts.end());
    if (!texts.empty() && !(texts.size() == 1 && texts[0] == "-"))
      return fmt::format("{}", fmt::join(texts, " | "));
  }
  return std::nullopt;
}

/// @throws InputError  a format that is none of its value's
std::optional<std::string> text_of_place(const Row& row, std::string_view place) {
  try {
    return text_in_place(row, place);
  } catch (const fmt::format_error& error) {
    throw InputError(
        fmt::format("{{{}}}: {}; expected a format of a number, such as :.3f", place, error.what()));
  }
}

}  // namespace

std::optional<std::string> text_of(const Row& row, const std::string& pattern) {
  if (const std::size_t or_else = pattern.find(" || "); or_else != pattern.npos) {
    const auto first = text_of(row, pattern.substr(0, or_else));
    return first ? first : text_of(row, pattern.substr(or_else + 4));
  }
  std::string text;
  for (std::size_t at = 0; at < pattern.size();) {
    const std::size_t open = std::min(pattern.find('{', at), pattern.size());
    text += pattern.substr(at, open - at);
    if (open == pattern.size()) break;
    const std::size_t close = pattern.find('}', open);
    if (close == pattern.npos)
      throw InputError(fmt::format("'{}': a place that does not end; expected a closing brace", pattern));
    const auto place = text_of_place(row, std::string_view(pattern).substr(open + 1, close - open - 1));
    if (!place) return std::nullopt;
    text += *place;
    at = close + 1;
  }
  return text;
}

}  // namespace kreisel::core
