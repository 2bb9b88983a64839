// outputs.hpp - the files that `design` writes.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

namespace kreisel::core::apps {

struct DesignOutputs {
  std::string part, json, html;  ///< json "-" is standard output
  std::string gcode;             ///< of a part that is sliced
  bool force = false;

  /// @param what  that --output holds
  void add(CLI::App& app, const std::string& what);
  /// Before the work. @throws InputError  a file that cannot be written, or that exists
  void require_writable() const;
  /// Writes the report, or prints it in place of everything else. @return  whether there is more to print
  [[nodiscard]] bool write_report(const std::string& json) const;
};

/// @throws InputError  it exists, and is not to be written over
void require_new(const std::filesystem::path& file, const char* option, bool force);

}  // namespace kreisel::core::apps
