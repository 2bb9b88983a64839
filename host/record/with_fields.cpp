#include "record/with_fields.hpp"

#include <string_view>

#include "session/build_info.hpp"

namespace kreisel::core::fields {
namespace {

constexpr const char* name = "summary";
constexpr std::size_t longest = 1 << 15;  // bytes; of a solve 6000

/// A commit names one program, but for changes that are not in it.
bool is_this_program(const nlohmann::json& summary) {
  const std::string_view commit = build_info::commit;
  return commit != "unknown" && !commit.ends_with("-dirty") && value_in(summary, "commit") == commit &&
         value_in(summary, "provenance.version") == build_info::version;
}

}  // namespace

void keep_summary(ToHdf5& file, const nlohmann::json& summary) {
  if (std::string text = summary.dump(); text.size() <= longest) file.stored(name, text);
}

nlohmann::json kept_summary(const hdf5::File& file) {
  if (!file.has(name)) return nullptr;
  nlohmann::json summary = nlohmann::json::parse(file.text(name), nullptr, false);
  return summary.is_object() && is_this_program(summary) ? summary : nlohmann::json();
}

}  // namespace kreisel::core::fields
