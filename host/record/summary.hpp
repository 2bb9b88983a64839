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
  /// Of an object as text, which is packed as it is read: no tree of it is made.
  /// @return  without values where it is no object, or not whole
  [[nodiscard]] static Summary of_text(std::string_view text);

  [[nodiscard]] bool empty() const { return !names_; }

  /// The value at "seconds.solve" or "voids.0.volume"; null where there is nothing.
  [[nodiscard]] nlohmann::json at(std::string_view path) const;
  /// All of it.
  [[nodiscard]] nlohmann::json whole() const;

 private:
  using Names = std::vector<std::string>;
  struct Value {
    std::string name;
    std::uint32_t begins, ends;  ///< in the bytes
  };
  class Packing;
  Summary(std::vector<Value> values, const std::vector<std::uint8_t>& bytes);
  [[nodiscard]] nlohmann::json unpacked(std::size_t index) const;

  const Names* names_ = nullptr;       ///< of the values, sorted; one for all summaries that have the same
  std::vector<std::uint32_t> begins_;  ///< of each value's bytes, and their end
  std::vector<std::uint8_t> bytes_;
};

/// What an object or list has at "voids.0.volume"; null where there is nothing.
[[nodiscard]] nlohmann::json value_in(const nlohmann::json& summary, std::string_view name);

}  // namespace kreisel::core
