// tabs.hpp - how many tabs there are, and where their desks go when they close.
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>

#include "live/desk.hpp"

namespace kreisel::core::live {

/// A desk whose tab has closed is ended in a thread of its own: what it works on may take a while to stop,
/// and the server answers the others meanwhile. It counts until then.
class Tabs : public std::enable_shared_from_this<Tabs> {
 public:
  explicit Tabs(std::shared_ptr<const Setup> setup) : setup_(std::move(setup)) {}

  /// Nothing: there are as many as may be.
  [[nodiscard]] std::unique_ptr<Desk> open(Send send);
  void close(std::unique_ptr<Desk> desk);

 private:
  std::shared_ptr<const Setup> setup_;
  std::atomic<std::size_t> count_ = 0;
};

}  // namespace kreisel::core::live
