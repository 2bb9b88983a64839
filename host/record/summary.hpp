// summary.hpp - what a record says, packed: a table of a sweep holds a hundred thousand of them.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace kreisel::core {

/// An object of JSON as the bytes of each of its values (CBOR): a tenth of the memory of nlohmann's tree. A
/// value is unpacked when it is asked for.
class Summary {
 public:
  Summary() = default;
  /// @param object  an object; what is none has no values
  Summary(const nlohmann::json& object);

  /// The value at "seconds.solve" or "voids.0.volume"; null where there is nothing.
  [[nodiscard]] nlohmann::json at(std::string_view path) const;
  /// All of it.
  [[nodiscard]] nlohmann::json whole() const;

 private:
  struct Entry {
    const std::string* name;  ///< of all summaries together: they have the same
    std::uint32_t begin, end;
  };
  [[nodiscard]] nlohmann::json unpacked(const Entry& entry) const;

  std::vector<Entry> entries_;  ///< by name
  std::vector<std::uint8_t> bytes_;
};

/// What an object or list has at "voids.0.volume"; null where there is nothing.
[[nodiscard]] nlohmann::json value_in(const nlohmann::json& summary, std::string_view name);

}  // namespace kreisel::core
