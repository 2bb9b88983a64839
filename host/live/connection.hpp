// connection.hpp - what listener, requests and sockets share of Boost.Beast.
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <memory>
#include <mutex>
#include <utility>

#include "live/guard.hpp"
#include "live/tabs.hpp"

namespace kreisel::core::live {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using Tcp = asio::ip::tcp;
using HttpRequest = http::request<http::empty_body>;

/// The way from desks' threads to the one that answers, for as long as there is one.
class Gate {
 public:
  explicit Gate(asio::io_context& context) : context_(&context) {}

  template <class Work>
  void post(Work work) {
    const std::lock_guard lock(mutex_);
    if (context_) asio::post(*context_, std::move(work));
  }
  void shut() {
    const std::lock_guard lock(mutex_);
    context_ = nullptr;
  }

 private:
  std::mutex mutex_;
  asio::io_context* context_;
};

struct Served {
  Guard guard;
  std::shared_ptr<const Setup> setup;
  std::shared_ptr<Tabs> tabs;
  std::shared_ptr<Gate> gate;
  int connections = 0;  ///< of the one thread that answers
};

/// Answers one request after the other on a connection, until it becomes a socket or ends.
void answer_requests(Tcp::socket socket, const std::shared_ptr<Served>& served);

/// Opens a tab's socket. @param asked  to be upgraded
void open_socket(beast::tcp_stream stream, HttpRequest asked, const std::shared_ptr<Served>& served);

}  // namespace kreisel::core::live
