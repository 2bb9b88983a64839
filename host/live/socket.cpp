#include <algorithm>
#include <boost/beast/websocket.hpp>
#include <iterator>
#include <list>
#include <string>
#include <utility>

#include "live/connection.hpp"

namespace kreisel::core::live {
namespace {

/// A tab's socket: what it asks goes to its desk, what the desk says goes out in order.
class Socket : public std::enable_shared_from_this<Socket> {
 public:
  Socket(beast::tcp_stream stream, std::shared_ptr<Served> served)
      : socket_(std::move(stream)), served_(std::move(served)) {}
  ~Socket() {
    if (desk_) served_->tabs->close(std::move(desk_));
  }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;

  void open(HttpRequest asked) {
    asked_ = std::move(asked);
    socket_.set_option(beast::websocket::stream_base::timeout::suggested(beast::role_type::server));
    socket_.auto_fragment(false);  // in small pieces a surface waits for a turn of the processor with each
    socket_.read_message_max(served_->setup->limits.mesh_bytes);
    socket_.async_accept(asked_, [self = shared_from_this()](beast::error_code error) {
      if (!error) self->begin();
    });
  }

 private:
  void begin() {
    // From the desk's threads to the one that answers. The desk ends with its socket, not the other way.
    desk_ = served_->tabs->open([weak = weak_from_this(), gate = served_->gate](Message message) {
      gate->post([weak, message = std::move(message)]() mutable {
        if (const auto self = weak.lock()) self->send(std::move(message));
      });
    });
    if (!desk_) {
      send(message({{"do", "error"}, {"id", nullptr}, {"text", "too many tabs are open; expected fewer"}}));
      closing_ = true;
      return;
    }
    read();
  }

  void read() {
    socket_.async_read(buffer_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (error) return self->end();
      self->take();
      self->read();
    });
  }

  void take() {
    std::string bytes = beast::buffers_to_string(buffer_.data());
    buffer_.clear();
    if (bytes.size() > most_kept) buffer_.shrink_to_fit();
    if (socket_.got_binary())
      desk_->take_bytes(std::move(bytes));
    else if (bytes.size() <= served_->setup->limits.request_bytes)
      desk_->take(bytes);
    else
      send(message({{"do", "error"}, {"id", nullptr}, {"text", "a request that is too long"}}));
  }

  void send(Message message) {
    if (ended_) return;
    const auto first = std::next(unsent_.begin(), writing_ ? 1 : 0);
    const auto same = std::find_if(first, unsent_.end(), [&](const Message& other) {
      return !message.kind.empty() && other.kind == message.kind;
    });
    unsent_bytes_ += message.bytes.size();
    if (same != unsent_.end()) {
      unsent_bytes_ -= same->bytes.size();
      unsent_.erase(same);
    }
    unsent_.push_back(std::move(message));
    if (unsent_bytes_ > served_->setup->limits.unsent_bytes) return end();  // it does not read
    if (!writing_) write();
  }

  void write() {
    if (unsent_.empty()) {
      if (closing_) end();
      return;
    }
    writing_ = true;
    socket_.binary(unsent_.front().binary);
    socket_.async_write(asio::buffer(unsent_.front().bytes),
                        [self = shared_from_this()](beast::error_code error, std::size_t) {
                          self->writing_ = false;
                          if (error || self->ended_) return self->end();
                          self->unsent_bytes_ -= self->unsent_.front().bytes.size();
                          self->unsent_.pop_front();
                          self->write();
                        });
  }

  void end() {
    if (ended_) return;
    ended_ = true;
    if (desk_) served_->tabs->close(std::move(desk_));
    if (!writing_) unsent_.clear();
    beast::get_lowest_layer(socket_).close();
  }

  static constexpr std::size_t most_kept = 1 << 20;

  beast::websocket::stream<beast::tcp_stream> socket_;
  std::shared_ptr<Served> served_;
  std::unique_ptr<Desk> desk_;
  HttpRequest asked_;
  beast::flat_buffer buffer_;
  std::list<Message> unsent_;
  std::size_t unsent_bytes_ = 0;
  bool writing_ = false, closing_ = false, ended_ = false;
};

}  // namespace

void open_socket(beast::tcp_stream stream, HttpRequest asked, const std::shared_ptr<Served>& served) {
  std::make_shared<Socket>(std::move(stream), served)->open(std::move(asked));
}

}  // namespace kreisel::core::live
