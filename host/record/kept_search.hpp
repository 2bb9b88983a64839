// kept_search.hpp - a search's checkpoint on disk, and those of other islands beside it.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "run/nest_run.hpp"

namespace kreisel::core {

/// A search over placements that is kept on its way. Islands are such searches that differ in their seed
/// alone and keep their checkpoints in one folder, with one extension. Of the others' files those that cannot
/// be read, or are of other searches, are passed over.
class KeptSearch {
 public:
  explicit KeptSearch(std::filesystem::path file) : file_(std::move(file)) {}

  /// What is there of this search; nothing where there is no file, or it has come to its end.
  /// @throws InputError  a file that cannot be read
  [[nodiscard]] std::optional<NestCheckpoint> begun(const NestConfig& config) const;

  /// The file appears whole or not at all. @throws InputError  the folder cannot be written
  void keep(const NestCheckpoint& checkpoint) const;

  /// The best position of the other islands, where it is better than this one's; else nothing.
  [[nodiscard]] std::vector<double> better_elsewhere(const NestCheckpoint& mine) const;

  void remove() const;

 private:
  std::filesystem::path file_;
};

/// Where the runner keeps a search: beside its record, islands in a folder of their own.
[[nodiscard]] std::filesystem::path checkpoint_of(const std::filesystem::path& record,
                                                  const NestConfig& config);

}  // namespace kreisel::core
