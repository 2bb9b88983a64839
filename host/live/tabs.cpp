#include "live/tabs.hpp"

#include <malloc.h>

#include <thread>
#include <utility>

namespace kreisel::core::live {

std::unique_ptr<Desk> Tabs::open(Send send) {
  if (count_ >= setup_->limits.tabs) return nullptr;
  ++count_;
  return std::make_unique<Desk>(setup_, std::move(send));
}

void Tabs::close(std::unique_ptr<Desk> desk) {
  desk->close();
  std::thread([tabs = shared_from_this(), desk = std::move(desk)]() mutable {
    desk.reset();
    --tabs->count_;
    ::malloc_trim(0);  // what it had goes back to the system
  }).detach();
}

}  // namespace kreisel::core::live
