// net_server.cpp -- the only file that includes Boost.Beast, which takes half a minute to compile.

#include "serve/net_server.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <csignal>
#include <deque>
#include <set>

#include "console/outcome.h"
#include "insonify/error.h"
#include "insonify/printable.h"

namespace insonify {
namespace {

namespace net = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using boost::system::error_code;
using net::ip::tcp;

constexpr std::size_t kMostConnections = 256;
constexpr std::uint32_t kLongestHeader = 16 * 1024;     // [bytes]
constexpr std::size_t kLongestFrame = 1'000'000;        // Of a client [bytes].
constexpr std::size_t kMostWaiting = 64 * 1024 * 1024;  // Besides pings [bytes].
constexpr std::chrono::seconds kRequestTime{10};        // For a whole request to come in.
constexpr std::chrono::seconds kIdleTime{30};           // Without a sign of life of a WebSocket.
constexpr std::chrono::milliseconds kClosingTime{500};  // For connections at the end.
constexpr std::size_t kLongestReason = 120;             // Of a close frame [bytes].

class Session;

// What sessions share.
struct Shared {
  NetServerOptions options;
  std::set<Session*> sessions;
  std::size_t connections = 0;
};

using Request = http::request<http::string_body>;

http::response<http::string_body> response_to(const Request& request, http::status status, std::string body,
                                              std::string_view type = "text/plain; charset=utf-8") {
  http::response<http::string_body> response(status, request.version());
  response.set(http::field::server, "insonify");
  response.set(http::field::content_type, beast::string_view(type.data(), type.size()));
  response.set(http::field::cache_control, "no-store");
  response.set("X-Content-Type-Options", "nosniff");
  response.set("Referrer-Policy", "no-referrer");
  response.set("X-Frame-Options", "DENY");
  response.set("Content-Security-Policy",
               "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; "
               "font-src 'self'; connect-src 'self' ws: wss:; base-uri 'none'; form-action 'none'; frame-ancestors "
               "'none'");
  response.keep_alive(request.keep_alive());
  response.body() = std::move(body);
  const std::size_t size = response.body().size();
  if (request.method() == http::verb::head) {
    response.body().clear();
  }
  response.content_length(size);
  return response;
}

std::string_view view_of(beast::string_view text) {
  return {text.data(), text.size()};
}

// One connection: requests, until one of them opens a WebSocket.
class Session : public std::enable_shared_from_this<Session>, public Connection {
 public:
  Session(tcp::socket socket, std::shared_ptr<Shared> shared)
      : shared_(std::move(shared)), websocket_(std::move(socket)), closing_(websocket_.get_executor()) {
    ++shared_->connections;
    shared_->sessions.insert(this);
  }
  ~Session() override {
    --shared_->connections;
    shared_->sessions.erase(this);
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  void start() {
    if (shared_->connections > kMostConnections) {
      Request none;
      none.version(11);
      none.keep_alive(false);
      respond(response_to(none, http::status::service_unavailable, "too many connections\n"));
      return;
    }
    read_request();
  }

  void send(OutMessage message) override {
    if (!open_ || ending_) {
      return;
    }
    if (message.droppable) {
      // The one that is being sent stays.
      const auto first = queue_.begin() + (writing_ ? 1 : 0);
      const auto is_alike = [&](const OutMessage& one) { return one.droppable && one.stream == message.stream; };
      if (static_cast<std::size_t>(std::count_if(first, queue_.end(), is_alike)) >= kQueuedPings) {
        queue_.erase(std::find_if(first, queue_.end(), is_alike));
        ++dropped_;
      }
    } else {
      waiting_bytes_ += message.bytes->size();
      if (waiting_bytes_ > kMostWaiting) {
        beast::get_lowest_layer(websocket_).close();
        return;
      }
    }
    queue_.push_back(std::move(message));
    write_next();
  }

  void close(std::uint16_t code, std::string_view reason) override {
    if (!open_ || ending_) {
      return;
    }
    ending_ = true;
    std::erase_if(queue_, [this, first = true](const OutMessage& one) mutable {
      const bool stays = !one.droppable || (writing_ && first);
      first = false;
      return !stays;
    });
    close_code_ = code;
    close_reason_ = reason.substr(0, kLongestReason);
    closing_.expires_after(std::chrono::seconds(2));
    closing_.async_wait([self = shared_from_this()](error_code failure) {
      if (!failure) {
        beast::get_lowest_layer(self->websocket_).close();
      }
    });
    write_next();
  }

  [[nodiscard]] std::uint64_t dropped() const override { return dropped_; }

  void forget_client() { client_.reset(); }

  // At the end of the server.
  void shut() {
    if (open_) {
      close(websocket::close_code::going_away, "the server ends");
    } else {
      beast::get_lowest_layer(websocket_).close();
    }
  }

 private:
  void read_request() {
    parser_.emplace();
    parser_->header_limit(kLongestHeader);
    parser_->body_limit(kLongestHeader);
    beast::get_lowest_layer(websocket_).expires_after(kRequestTime);
    http::async_read(websocket_.next_layer(), buffer_, *parser_,
                     [self = shared_from_this()](error_code failure, std::size_t) { self->on_request(failure); });
  }

  void on_request(error_code failure) {
    if (failure) {
      on_bad_request(failure);
      return;
    }
    const Request& request = parser_->get();
    if (websocket::is_upgrade(request)) {
      open(request);
      return;
    }
    respond(answer(request));
  }

  void on_bad_request(error_code failure) {
    if (failure == http::error::end_of_stream || failure == beast::error::timeout ||
        failure.category() != make_error_code(http::error::bad_method).category()) {
      beast::get_lowest_layer(websocket_).close();
      return;
    }
    const bool too_long = failure == http::error::header_limit || failure == http::error::body_limit ||
                          failure == http::error::buffer_overflow;
    Request none;
    none.version(11);
    none.keep_alive(false);
    respond(response_to(none, too_long ? http::status::request_header_fields_too_large : http::status::bad_request,
                        fmt::format("{}\n", failure.message())));
  }

  [[nodiscard]] http::response<http::string_body> answer(const Request& request) const {
    if (const std::string reason = refused_host(shared_->options.access, view_of(request[http::field::host]));
        !reason.empty()) {
      return response_to(request, http::status::forbidden, reason + "\n");
    }
    if (request.method() != http::verb::get && request.method() != http::verb::head) {
      auto response = response_to(request, http::status::method_not_allowed, "only GET and HEAD are served\n");
      response.set(http::field::allow, "GET, HEAD");
      return response;
    }
    if (std::optional<ServedFile> file = shared_->options.file(decoded_path(view_of(request.target())))) {
      return response_to(request, http::status::ok, std::move(file->bytes), file->type);
    }
    return response_to(request, http::status::not_found, "there is no such file\n");
  }

  void respond(http::response<http::string_body> response) {
    response_ = std::make_shared<http::response<http::string_body>>(std::move(response));
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

  void open(const Request& request) {
    AccessRequest access{.host = view_of(request[http::field::host]),
                         .origin = view_of(request[http::field::origin]),
                         .authorization = view_of(request[http::field::authorization]),
                         .query = query_of(view_of(request.target())),
                         .protocols = list_items(view_of(request[http::field::sec_websocket_protocol]))};
    if (const std::string reason = refused_connection(shared_->options.access, access); !reason.empty()) {
      const bool token = !shared_->options.access.token.empty();
      respond(response_to(request, token ? http::status::unauthorized : http::status::forbidden, reason + "\n"));
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

  // Ends the connection where the client's handler fails.
  template <typename Function>
  void guarded(Function&& function) {
    try {
      function();
    } catch (const std::exception& failure) {
      close(websocket::close_code::policy_error, failure.what());
    }
  }

  // The limit of messages is kept here, not by Beast: that resets a connection whose client still sends, which then
  // does not get to read the reason.
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
    if (writing_) {
      return;
    }
    if (queue_.empty()) {
      if (ending_ && open_ && !close_sent_) {
        close_sent_ = true;
        websocket_.async_close(websocket::close_reason(static_cast<websocket::close_code>(close_code_),
                                                       beast::string_view(close_reason_.data(), close_reason_.size())),
                               [self = shared_from_this()](error_code) { self->on_end(); });
      }
      return;
    }
    writing_ = true;
    websocket_.binary(queue_.front().binary);
    sending_ = queue_.front();  // Stays alive, whatever happens to the queue.
    const std::array<net::const_buffer, 2> buffers = {net::buffer(sending_.head), net::buffer(*sending_.bytes)};
    websocket_.async_write(buffers, [self = shared_from_this()](error_code failure, std::size_t) {
      self->writing_ = false;
      if (failure || self->queue_.empty()) {
        return;
      }
      if (!self->queue_.front().droppable) {
        self->waiting_bytes_ -= self->queue_.front().bytes->size();
      }
      self->queue_.pop_front();
      self->write_next();
    });
  }

  std::shared_ptr<Shared> shared_;
  websocket::stream<beast::tcp_stream> websocket_;
  net::steady_timer closing_;
  beast::flat_buffer buffer_{3 * kLongestFrame};
  std::optional<http::request_parser<http::string_body>> parser_;
  std::shared_ptr<http::response<http::string_body>> response_;
  std::unique_ptr<Client> client_;
  std::string protocol_, close_reason_;
  std::uint16_t close_code_ = 0;
  bool open_ = false, ending_ = false, writing_ = false, close_sent_ = false;
  std::deque<OutMessage> queue_;
  OutMessage sending_;
  std::size_t waiting_bytes_ = 0;
  std::uint64_t dropped_ = 0;
};

}  // namespace

struct NetServer::State {
  explicit State(NetServerOptions options) : acceptor(context), signals(context), shared(std::make_shared<Shared>()) {
    shared->options = std::move(options);
  }

  void accept() {
    acceptor.async_accept([this](error_code failure, tcp::socket socket) {
      if (failure == net::error::operation_aborted) {
        return;
      }
      if (!failure) {
        std::make_shared<Session>(std::move(socket), shared)->start();
        accept();
        return;
      }
      // Out of file descriptors, perhaps: tries again, but not at once.
      retry.expires_after(std::chrono::milliseconds(100));
      retry.async_wait([this](error_code) { accept(); });
    });
  }

  void repeat(std::chrono::milliseconds interval, const std::shared_ptr<net::steady_timer>& timer,
              const std::function<void()>& function) {
    timer->expires_after(interval);
    timer->async_wait([this, interval, timer, function](error_code failure) {
      if (!failure && !ending) {
        function();
        repeat(interval, timer, function);
      }
    });
  }

  void end() {
    if (std::exchange(ending, true)) {
      return;
    }
    error_code ignored;
    acceptor.close(ignored);
    signals.cancel(ignored);
    for (Session* session : std::set<Session*>(shared->sessions)) {
      session->shut();
    }
    last.expires_after(kClosingTime);
    last.async_wait([this](error_code) { context.stop(); });
    watch_end();
  }

  // Ends as soon as the last connection has.
  void watch_end() {
    if (shared->sessions.empty()) {
      context.stop();
      return;
    }
    retry.expires_after(std::chrono::milliseconds(10));
    retry.async_wait([this](error_code) { watch_end(); });
  }

  net::io_context context{1};
  tcp::acceptor acceptor;
  net::signal_set signals;
  net::steady_timer retry{context}, last{context};
  std::shared_ptr<Shared> shared;
  bool ending = false;
};

NetServer::NetServer(NetServerOptions options) : state_(std::make_unique<State>(std::move(options))) {
  State& state = *state_;
  const NetServerOptions& chosen = state.shared->options;
  error_code failure;
  const net::ip::address address =
      net::ip::make_address(chosen.address == "localhost" ? "127.0.0.1" : chosen.address, failure);
  if (failure) {
    throw InputError(fmt::format("--address {} must be an IP address, such as 127.0.0.1 or ::1, or localhost",
                                 printable(chosen.address)));
  }
  const tcp::endpoint endpoint(address, chosen.port);
  const auto attempt = [&](const auto& function) {
    if (!failure) {
      function();
    }
  };
  attempt([&] { state.acceptor.open(endpoint.protocol(), failure); });
  attempt([&] { state.acceptor.set_option(tcp::acceptor::reuse_address(true), failure); });
  attempt([&] { state.acceptor.bind(endpoint, failure); });
  attempt([&] { state.acceptor.listen(net::socket_base::max_listen_connections, failure); });
  if (failure) {
    throw Error(fmt::format("cannot listen on port {} of {}: {}", chosen.port, chosen.address, failure.message()));
  }
}

NetServer::~NetServer() = default;

std::uint16_t NetServer::port() const {
  return state_->acceptor.local_endpoint().port();
}

void NetServer::watch_signals() {
  State& state = *state_;
  state.signals.add(SIGINT);
  state.signals.add(SIGTERM);
  state.signals.async_wait([&state](error_code failure, int) {
    if (!failure) {
      state.end();
    }
  });
}

void NetServer::run() {
  State& state = *state_;
  state.accept();
  state.context.run();
  for (Session* session : state.shared->sessions) {
    session->forget_client();
  }
}

void NetServer::stop() {
  post([this] { state_->end(); });
}

void NetServer::post(std::function<void()> function) {
  net::post(state_->context, std::move(function));
}

void NetServer::every(std::chrono::milliseconds interval, std::function<void()> function) {
  state_->repeat(interval, std::make_shared<net::steady_timer>(state_->context), function);
}

}  // namespace insonify
