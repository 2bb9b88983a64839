#include "live/server.hpp"

#include <fmt/format.h>

#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <utility>

#include "error.hpp"
#include "live/connection.hpp"

namespace kreisel::core::live {
namespace {

constexpr int most_connections = 512;

Tcp::acceptor acceptor_at(asio::io_context& context, std::uint16_t port) {
  try {
    return {context, Tcp::endpoint(asio::ip::address_v4::loopback(), port)};
  } catch (const boost::system::system_error& error) {
    throw InputError(fmt::format("--port {}: {}; expected one that is free", port, error.code().message()));
  }
}

void accept(Tcp::acceptor& acceptor, const std::shared_ptr<Served>& served) {
  acceptor.async_accept([&acceptor, served](beast::error_code error, Tcp::socket socket) {
    if (!error) {
      socket.set_option(Tcp::no_delay(true), error);
      if (served->connections < most_connections) answer_requests(std::move(socket), served);
    }
    if (acceptor.is_open()) accept(acceptor, served);
  });
}

/// A signal's handler may do no more than ask for the stop, so it is looked for.
void watch(asio::steady_timer& timer, asio::io_context& context, const std::stop_token& stop) {
  timer.expires_after(std::chrono::milliseconds(50));
  timer.async_wait([&timer, &context, stop](beast::error_code) {
    stop.stop_requested() ? context.stop() : watch(timer, context, stop);
  });
}

}  // namespace

void serve(std::shared_ptr<const Setup> setup, std::uint16_t port,
           const std::function<void(const std::string&)>& ready, const std::stop_token& stop) {
  asio::io_context context(1);
  Tcp::acceptor acceptor = acceptor_at(context, port);
  const auto gate = std::make_shared<Gate>(context);
  const auto served = std::make_shared<Served>(Served{Guard(acceptor.local_endpoint().port(), random_token()),
                                                      setup, std::make_shared<Tabs>(setup), gate, 0});
  accept(acceptor, served);
  asio::steady_timer timer(context);
  watch(timer, context, stop);
  ready(served->guard.url());
  context.run();
  gate->shut();
}

}  // namespace kreisel::core::live
