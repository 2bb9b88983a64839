#include <fmt/format.h>

#include <boost/beast/websocket/rfc6455.hpp>
#include <chrono>
#include <optional>
#include <string>
#include <utility>

#include "live/connection.hpp"
#include "live/pages.hpp"

namespace kreisel::core::live {
namespace {

constexpr std::chrono::seconds patience{15};  // with a client that sends nothing
constexpr std::uint32_t most_header = 16384;

using Response = http::response<http::span_body<const char>>;

/// One connection, while it is asked for pages.
class Requests : public std::enable_shared_from_this<Requests> {
 public:
  Requests(Tcp::socket socket, std::shared_ptr<Served> served)
      : stream_(std::move(socket)), served_(std::move(served)) {
    ++served_->connections;
  }
  ~Requests() { --served_->connections; }
  Requests(const Requests&) = delete;
  Requests& operator=(const Requests&) = delete;

  void read() {
    parser_.emplace();
    parser_->header_limit(most_header);
    parser_->body_limit(0);
    stream_.expires_after(patience);
    http::async_read(stream_, buffer_, *parser_,
                     [self = shared_from_this()](beast::error_code error, std::size_t) {
                       if (!error) return self->answer();
                       if (error == http::error::end_of_stream || error == asio::error::eof)
                         return self->close();
                       // A header or body that is too long, or no HTTP: it is told, and that is the end.
                       if (error.category() == http::make_error_code(http::error::bad_target).category())
                         self->refuse(http::status::bad_request, "no request as it is expected here", true);
                     });
  }

 private:
  void answer() {
    HttpRequest request = parser_->release();
    const auto origin = request.find(http::field::origin);
    const auto view = [](auto text) { return std::string_view(text.data(), text.size()); };
    Asking asking{view(request.target()), view(request[http::field::host]), {}};
    if (origin != request.end()) asking.origin = view(origin->value());
    const std::optional<std::string_view> path = served_->guard.path_of(asking);
    if (!path)
      return refuse(http::status::forbidden, "expected the address that `design live` printed",
                    !request.keep_alive());
    if (beast::websocket::is_upgrade(request)) {
      if (*path != "socket") return refuse(http::status::not_found, "no such socket", true);
      stream_.expires_never();
      return open_socket(std::move(stream_), std::move(request), served_);
    }
    if (request.method() != http::verb::get && request.method() != http::verb::head)
      return refuse(http::status::method_not_allowed, "expected GET", !request.keep_alive());
    const PageFile* file = find_page(*path);
    if (!file) return refuse(http::status::not_found, "no such page", !request.keep_alive());
    send(http::status::ok, file->type, file->text, request.method() == http::verb::head,
         !request.keep_alive());
  }

  void refuse(http::status status, std::string_view text, bool last) {
    send(status, "text/plain; charset=utf-8", text, false, last);
  }

  void send(http::status status, std::string_view type, std::string_view text, bool head, bool last) {
    response_.emplace(status, 11);
    Response& r = *response_;
    r.set(http::field::content_type, beast::string_view(type.data(), type.size()));
    r.set(http::field::cache_control, "no-store");
    r.set("Referrer-Policy", "no-referrer");
    r.set("X-Content-Type-Options", "nosniff");
    r.set("Cross-Origin-Resource-Policy", "same-origin");
    r.set("Content-Security-Policy",
          "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: "
          "blob:; "
          "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'");
    r.keep_alive(!last);
    r.content_length(text.size());
    if (!head) r.body() = {text.data(), text.size()};
    stream_.expires_after(patience);
    const auto sent = [self = shared_from_this(), last](beast::error_code error, std::size_t) {
      self->serializer_.reset();
      if (error) return;
      last ? self->close() : self->read();
    };
    serializer_.emplace(r);
    if (head)
      http::async_write_header(stream_, *serializer_, sent);
    else
      http::async_write(stream_, *serializer_, sent);
  }

  void close() {
    beast::error_code ignored;
    stream_.socket().shutdown(Tcp::socket::shutdown_send, ignored);
  }

  beast::tcp_stream stream_;
  std::shared_ptr<Served> served_;
  beast::flat_buffer buffer_{std::size_t{2} * most_header};
  std::optional<http::request_parser<http::empty_body>> parser_;
  std::optional<Response> response_;
  std::optional<http::response_serializer<http::span_body<const char>>> serializer_;
};

}  // namespace

void answer_requests(Tcp::socket socket, const std::shared_ptr<Served>& served) {
  std::make_shared<Requests>(std::move(socket), served)->read();
}

}  // namespace kreisel::core::live
