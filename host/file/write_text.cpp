#include "file/write_text.hpp"

#include <fmt/format.h>

#include <fstream>

#include "error.hpp"
#include "file/replace_file.hpp"

namespace kreisel::core {

void write_text(const std::filesystem::path& path, const std::string& text) {
  replace_file(path, [&](const std::filesystem::path& temporary) {
    std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
    if (!out)
      throw InputError(
          fmt::format("{}: its folder refuses a new file, expected write permission", path.string()));
    out.write(text.data(), static_cast<std::streamsize>(text.size()));
    out.close();
    if (!out)
      throw InputError(
          fmt::format("{}: writing {} bytes failed, expected room for them", path.string(), text.size()));
  });
}

}  // namespace kreisel::core
