#include "record/with_fields.hpp"

#include <string_view>

#include "session/build_info.hpp"

namespace kreisel::core::fields {
namespace {

constexpr const char* name = "summary";
constexpr std::size_t longest = 1 << 15;  // bytes; of a solve 6000

/// A commit names one program, but for changes that are not in it.
bool is_this_program(const Summary& summary) {
  const std::string_view commit = build_info::commit;
  return commit != "unknown" && !commit.ends_with("-dirty") && summary.at("commit") == commit &&
         summary.at("provenance.version") == build_info::version;
}

}  // namespace

void keep_summary(ToHdf5& file, const nlohmann::json& summary) {
  if (std::string text = summary.dump(); text.size() <= longest) file.stored(name, text);
}

Summary kept_summary(const hdf5::File& file) {
  if (!file.has(name)) return {};
  Summary summary = Summary::of_text(file.text(name));
  return is_this_program(summary) ? summary : Summary();
}

}  // namespace kreisel::core::fields
