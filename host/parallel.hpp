// parallel.hpp - a loop over independent pieces of work on all hardware threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include "stop.hpp"

namespace kreisel::core {

/// Calls body(i) once for every i < count, in any order, on as many threads as the machine has. The pieces
/// share nothing they write to, so the result depends on none of that. The first exception is thrown again
/// when all threads are done; pieces not begun by then are left out. Asks for a stop ahead of every piece
/// (stop.hpp), and its threads are in the StopScope of the one that calls it.
template <class Body>
void parallel_for(std::size_t count, Body&& body) {
  std::atomic<std::size_t> next = 0;
  std::exception_ptr failure;
  std::mutex failing;
  const std::stop_token stop = StopScope::current();
  const auto work = [&] {
    const StopScope scope(stop);
    for (std::size_t i = next++; i < count; i = next++) try {
        stop_here();
        body(i);
      } catch (...) {
        const std::scoped_lock lock(failing);
        if (!failure) failure = std::current_exception();
        next = count;
      }
  };
  {
    const std::size_t threads =
        std::min<std::size_t>(count, std::max(1u, std::thread::hardware_concurrency()));
    std::vector<std::jthread> others;
    try {
      for (std::size_t t = 1; t < threads; ++t) others.emplace_back(work);
    } catch (const std::system_error&) {
      // No more threads to be had, as where memory is short: those there are do the work.
    }
    work();
  }
  if (failure) std::rethrow_exception(failure);
}

/// The same for work that is too little for a piece of its own: `block` of them make one.
template <class Body>
void parallel_for(std::size_t count, std::size_t block, Body&& body) {
  parallel_for((count + block - 1) / block, [&](std::size_t b) {
    for (std::size_t i = b * block; i < std::min((b + 1) * block, count); ++i) body(i);
  });
}

}  // namespace kreisel::core
