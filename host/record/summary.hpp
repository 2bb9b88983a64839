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
  using Names = std::vector<std::string>;
  [[nodiscard]] nlohmann::json unpacked(std::size_t index) const;

  const Names* names_ = nullptr;       ///< of the values, sorted; one for all summaries that have the same
  std::vector<std::uint32_t> begins_;  ///< of each value's bytes, and their end
  std::vector<std::uint8_t> bytes_;
};

/// What an object or list has at "voids.0.volume"; null where there is nothing.
[[nodiscard]] nlohmann::json value_in(const nlohmann::json& summary, std::string_view name);

}  // namespace kreisel::core
