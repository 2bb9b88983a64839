// kept.hpp - a value that is made again only when what it is made of has changed.
#pragma once

#include <memory>
#include <optional>
#include <utility>

namespace kreisel::core {

/// What was made last, and of which key. Those who hold the value keep it when another takes its place.
template <class Key, class Value>
class Kept {
 public:
  [[nodiscard]] bool holds(const Key& key) const { return key_ && *key_ == key; }
  [[nodiscard]] const std::shared_ptr<Value>& value() const { return value_; }
  [[nodiscard]] const std::optional<Key>& key() const { return key_; }

  /// The value of that key; `make()` makes it where another is kept. Nothing is kept of one that throws.
  template <class Make>
  const std::shared_ptr<Value>& get(Key key, const Make& make) {
    if (holds(key)) return value_;
    key_.reset();
    value_.reset();  // first, so that two large ones need not fit into memory
    value_ = make();
    key_ = std::move(key);
    return value_;
  }

 private:
  std::optional<Key> key_;
  std::shared_ptr<Value> value_;
};

}  // namespace kreisel::core
