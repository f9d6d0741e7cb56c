// net_session.cpp -- the only file that includes Boost.Beast's WebSockets, which take half a minute to compile.

#include "serve/net/net_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>

#include "serve/net/http_answers.h"
#include "serve/net/out_queue.h"

namespace insonify {
namespace {

namespace net = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using boost::system::error_code;
using net::ip::tcp;

constexpr std::size_t kMostConnections = 256;
constexpr std::uint32_t kLongestHeader = 16 * 1024;  // [bytes]
constexpr std::size_t kLongestFrame = 1'000'000;     // Longest frame of a client [bytes].
constexpr std::chrono::seconds kRequestTime{10};     // For receiving a whole request.
constexpr std::chrono::seconds kIdleTime{30};        // Timeout of a silent WebSocket.
constexpr std::size_t kLongestReason = 120;          // Longest reason in a close frame [bytes].

class Session : public std::enable_shared_from_this<Session>, public NetSession {
 public:
  Session(tcp::socket socket, std::shared_ptr<NetShared> shared)
      : shared_(std::move(shared)), websocket_(std::move(socket)), closing_(websocket_.get_executor()) {
    shared_->sessions.push_back(this);
  }
  ~Session() override { std::erase(shared_->sessions, this); }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  void start() override {
    if (shared_->sessions.size() > kMostConnections && !make_room()) {
      respond(response_to_none(http::status::service_unavailable, "too many connections\n"));
      return;
    }
    read_request();
  }

  void send(OutMessage message) override {
    if (!open_ || ending_) {
      return;
    }
    if (queue_.push(std::move(message))) {
      write_next();
    } else {
      cut_off();
    }
  }

  void close(std::uint16_t code, std::string_view reason) override {
    if (!open_ || ending_) {
      return;
    }
    ending_ = true;
    queue_.drop_pings();
    close_code_ = code;
    close_reason_ = reason.substr(0, kLongestReason);
    closing_.expires_after(std::chrono::seconds(2));
    closing_.async_wait([self = shared_from_this()](error_code failure) {
      if (!failure) {
        self->cut_off();
      }
    });
    write_next();
  }

  [[nodiscard]] std::uint64_t dropped() const override { return queue_.dropped(); }

  void forget_client() override { client_.reset(); }

  void shut() override {
    if (open_) {
      close(websocket::close_code::going_away, "the server ends");
    } else {
      cut_off();
    }
  }

  void cut_off() override {
    waits_for_request_ = false;
    beast::get_lowest_layer(websocket_).close();
  }

  [[nodiscard]] bool waits_for_request() const override { return waits_for_request_; }

 private:
  // Disconnects the oldest connection without a complete request, so that idle connections do not keep others
  // out.
  [[nodiscard]] bool make_room() const {
    const auto found = std::ranges::find_if(shared_->sessions, &NetSession::waits_for_request);
    if (found == shared_->sessions.end()) {
      return false;
    }
    (*found)->cut_off();
    return true;
  }

  void read_request() {
    waits_for_request_ = true;
    parser_.emplace();
    parser_->header_limit(kLongestHeader);
    parser_->body_limit(kLongestHeader);
    beast::get_lowest_layer(websocket_).expires_after(kRequestTime);
    http::async_read(websocket_.next_layer(), buffer_, *parser_,
                     [self = shared_from_this()](error_code failure, std::size_t) { self->on_request(failure); });
  }

  void on_request(error_code failure) {
    waits_for_request_ = false;
    if (failure) {
      on_bad_request(failure);
      return;
    }
    const HttpRequest& request = parser_->get();
    if (websocket::is_upgrade(request)) {
      open(request);
      return;
    }
    respond(answer(request, shared_->options));
  }

  void on_bad_request(error_code failure) {
    if (failure == http::error::end_of_stream || failure == beast::error::timeout ||
        failure.category() != make_error_code(http::error::bad_method).category()) {
      cut_off();
      return;
    }
    const bool too_long = failure == http::error::header_limit || failure == http::error::body_limit ||
                          failure == http::error::buffer_overflow;
    respond(response_to_none(too_long ? http::status::request_header_fields_too_large : http::status::bad_request,
                             fmt::format("{}\n", failure.message())));
  }

  void respond(HttpResponse response) {
    response_ = std::make_shared<HttpResponse>(std::move(response));
    beast::get_lowest_layer(websocket_).expires_after(kRequestTime);
    http::async_write(
        websocket_.next_layer(), *response_, [self = shared_from_this()](error_code failure, std::size_t) {
          if (failure || !self->response_->keep_alive()) {
            error_code ignored;
            beast::get_lowest_layer(self->websocket_).socket().shutdown(tcp::socket::shutdown_send, ignored);
            return;
          }
          self->read_request();
        });
  }

  void open(const HttpRequest& request) {
    const AccessRequest access = access_of(request);
    if (const std::string reason = refused_connection(shared_->options.access, access); !reason.empty()) {
      respond(refusal(request, shared_->options.access, reason));
      return;
    }
    const std::vector<std::string>& known = shared_->options.protocols;
    const auto chosen = std::ranges::find_if(
        access.protocols, [&](std::string_view offered) { return std::ranges::find(known, offered) != known.end(); });
    if (chosen == access.protocols.end()) {
      respond(response_to(request, http::status::bad_request,
                          fmt::format("the subprotocol must be {}\n", fmt::join(known, " or "))));
      return;
    }
    protocol_ = *chosen;
    beast::get_lowest_layer(websocket_).expires_never();
    websocket_.set_option(websocket::stream_base::timeout{
        .handshake_timeout = kRequestTime, .idle_timeout = kIdleTime, .keep_alive_pings = true});
    websocket_.set_option(websocket::stream_base::decorator([protocol = protocol_](websocket::response_type& response) {
      response.set(http::field::server, "insonify");
      response.set(http::field::sec_websocket_protocol, protocol);
    }));
    websocket_.read_message_max(0);
    websocket_.auto_fragment(false);
    error_code ignored;
    beast::get_lowest_layer(websocket_).socket().set_option(tcp::no_delay(true), ignored);
    websocket_.async_accept(request, [self = shared_from_this()](error_code failure) { self->on_open(failure); });
  }

  void on_open(error_code failure) {
    if (failure) {
      return;
    }
    open_ = true;
    guarded([this] { client_ = shared_->options.client(*this, protocol_); });
    buffer_.consume(buffer_.size());
    read_frame();
  }

  // Ends the connection if the client's handler fails.
  template <typename Function>
  void guarded(Function&& function) {
    try {
      function();
    } catch (const std::exception& failure) {
      close(websocket::close_code::policy_error, failure.what());
    }
  }

  // The size of messages is limited here, not by Beast: Beast resets the connection while the client still sends, so
  // that the client never reads the reason.
  void read_frame() {
    websocket_.async_read_some(buffer_, kLongestFrame, [self = shared_from_this()](error_code failure, std::size_t) {
      if (failure) {
        self->on_end();
        return;
      }
      self->on_part();
      self->read_frame();
    });
  }

  void on_part() {
    if (!ending_ && buffer_.size() > kLongestFrame) {
      close(websocket::close_code::too_big, fmt::format("messages are at most {} bytes", kLongestFrame));
    }
    if (!ending_ && websocket_.is_message_done()) {
      const std::string_view bytes(static_cast<const char*>(buffer_.data().data()), buffer_.size());
      guarded([&] {
        if (websocket_.got_text()) {
          client_->on_text(bytes);
        } else {
          client_->on_binary(bytes);
        }
      });
    }
    if (ending_ || websocket_.is_message_done()) {
      buffer_.consume(buffer_.size());
    }
  }

  void on_end() {
    open_ = false;
    queue_.clear();
    closing_.cancel();
    client_.reset();
  }

  void write_next() {
    if (queue_.sending()) {
      return;
    }
    if (queue_.empty()) {
      send_close();
      return;
    }
    const OutMessage& message = queue_.begin_sending();
    websocket_.binary(message.binary);
    const std::array<net::const_buffer, 2> buffers = {net::buffer(message.head), net::buffer(*message.bytes)};
    websocket_.async_write(buffers, [self = shared_from_this()](error_code failure, std::size_t) {
      self->queue_.end_sending();
      if (!failure) {
        self->write_next();
      }
    });
  }

  // Once everything queued before is sent.
  void send_close() {
    if (!ending_ || !open_ || close_sent_) {
      return;
    }
    close_sent_ = true;
    websocket_.async_close(websocket::close_reason(static_cast<websocket::close_code>(close_code_),
                                                   beast::string_view(close_reason_.data(), close_reason_.size())),
                           [self = shared_from_this()](error_code) { self->on_end(); });
  }

  std::shared_ptr<NetShared> shared_;
  websocket::stream<beast::tcp_stream> websocket_;
  net::steady_timer closing_;
  beast::flat_buffer buffer_{3 * kLongestFrame};
  std::optional<http::request_parser<http::string_body>> parser_;
  std::shared_ptr<HttpResponse> response_;
  std::unique_ptr<Client> client_;
  std::string protocol_, close_reason_;
  std::uint16_t close_code_ = 0;
  bool waits_for_request_ = false, open_ = false, ending_ = false, close_sent_ = false;
  OutQueue queue_;
};

}  // namespace

std::shared_ptr<NetSession> make_session(tcp::socket socket, std::shared_ptr<NetShared> shared) {
  return std::make_shared<Session>(std::move(socket), std::move(shared));
}

}  // namespace insonify
