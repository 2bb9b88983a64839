// server.hpp - HTTP and WebSockets on this machine alone.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>

#include "live/setup.hpp"

namespace kreisel::core::live {

/// Serves until it is asked to stop. One thread answers, and each tab works in threads of its own.
/// @param port   0: any that is free
/// @param ready  told the address, once it is answered there
/// @throws InputError  the port is taken, or no port to be had
void serve(std::shared_ptr<const Setup> setup, std::uint16_t port,
           const std::function<void(const std::string& url)>& ready, const std::stop_token& stop);

}  // namespace kreisel::core::live
