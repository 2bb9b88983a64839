#include "record/kept_search.hpp"

#include <fmt/format.h>

#include <new>
#include <stdexcept>
#include <system_error>

#include "error.hpp"
#include "record/nest_record.hpp"

namespace kreisel::core {
namespace fs = std::filesystem;
namespace {

/// What islands have in common.
std::map<std::string, std::string> without_seed(const NestConfig& config) {
  auto fields = describe(config);
  fields.erase("seed");
  return fields;
}

/// @throws InputError  whatever is wrong with it, a table of more numbers than there is memory for included
NestCheckpoint read_safely(const fs::path& file) {
  try {
    return read_checkpoint(file);
  } catch (const std::bad_alloc&) {
    throw InputError(fmt::format("{}: more numbers than there is memory for", file.string()));
  } catch (const std::length_error&) {
    throw InputError(fmt::format("{}: more numbers than any memory holds", file.string()));
  }
}

std::optional<NestCheckpoint> read_if_sound(const fs::path& file) {
  try {
    return read_safely(file);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

}  // namespace

std::optional<NestCheckpoint> KeptSearch::begun(const NestConfig& config) const {
  std::error_code ignored;
  if (!fs::exists(file_, ignored)) return std::nullopt;
  NestCheckpoint found = read_safely(file_);
  const bool same = describe(found.config) == describe(config);
  if (!same || found.state.phase == nest::SearchState::over) return std::nullopt;
  return found;
}

void KeptSearch::keep(const NestCheckpoint& checkpoint) const { write_checkpoint(file_, checkpoint); }

std::vector<double> KeptSearch::better_elsewhere(const NestCheckpoint& mine) const {
  const auto search = without_seed(mine.config);
  std::vector<double> best;
  double scale = mine.state.scale;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(file_.parent_path(), ignored)) {
    if (entry.path().extension() != file_.extension() || entry.path().filename() == file_.filename())
      continue;
    const std::optional<NestCheckpoint> other = read_if_sound(entry.path());
    if (!other || !(other->state.scale > scale) || without_seed(other->config) != search) continue;
    scale = other->state.scale;
    best = other->state.best;
  }
  return best;
}

void KeptSearch::remove() const {
  std::error_code ignored;
  fs::remove(file_, ignored);
}

fs::path checkpoint_of(const fs::path& record, const NestConfig& config) {
  constexpr const char* extension = ".checkpoint";  // no record's
  const auto* search = part_of<NestSwarm>(config);
  if (!search || search->exchange == 0) return fs::path(record).replace_extension(extension);
  NestConfig any_seed = config;
  part_of<NestSwarm>(any_seed)->search.swarm.seed = 0;
  return record.parent_path() / (run_name(any_seed) + ".islands") /
         fmt::format("{}{}", seed_of(config), extension);
}

}  // namespace kreisel::core
