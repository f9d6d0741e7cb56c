// net_server.h -- HTTP and WebSocket on one port, for any content.

#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "serve/net/access.h"

namespace insonify {

/// What goes out to clients. The bytes are shared by all clients they go to.
struct OutMessage {
  std::shared_ptr<const std::string> bytes;
  std::string head = {};  ///< Goes before them.
  bool binary = false;
  bool droppable = false;    ///< A ping: falls out of the queue when more than kQueuedPings of its stream wait.
  std::uint32_t stream = 0;  ///< Where a connection has several.
};

/// Pings of one stream that wait for one client, at most.
inline constexpr std::size_t kQueuedPings = 4;

/// One open WebSocket connection. For the server's thread only, as all here where nothing else is said.
class Connection {
 public:
  virtual ~Connection() = default;
  /// Queues a message, and never waits. A client that lets too much other than pings wait is cut off.
  virtual void send(OutMessage message) = 0;
  /// Ends the connection once what is queued has been sent, or two seconds later.
  virtual void close(std::uint16_t code, std::string_view reason) = 0;
  /// Pings that fell out of the queue.
  [[nodiscard]] virtual std::uint64_t dropped() const = 0;
};

/// What talks with one connection. An exception of its functions ends the connection, with its text as the reason.
class Client {
 public:
  virtual ~Client() = default;
  virtual void on_text(std::string_view text) = 0;
  virtual void on_binary(std::string_view bytes) = 0;
};

/// A file to be served.
struct ServedFile {
  std::string_view type;  ///< "text/html; charset=utf-8"
  std::string bytes;
};

struct NetServerOptions {
  std::string address = "127.0.0.1";
  std::uint16_t port = 8765;  ///< 0: any that is free.
  AccessRules access;
  std::vector<std::string> protocols;  ///< Subprotocols there are.
  /// A file by the path of its URL, decoded: "/index.html".
  std::function<std::optional<ServedFile>(std::string_view path)> file;
  /// A client has come. Never returns null.
  std::function<std::unique_ptr<Client>(Connection& connection, const std::string& protocol)> client;
};

class NetServer {
 public:
  /// Binds the port.
  /// @throws Error "cannot listen on 127.0.0.1:8765: Address already in use".
  explicit NetServer(NetServerOptions options);
  ~NetServer();
  NetServer(const NetServer&) = delete;
  NetServer& operator=(const NetServer&) = delete;

  [[nodiscard]] std::uint16_t port() const;

  /// From here on SIGINT and SIGTERM end run(), also where it has not begun yet.
  void watch_signals();
  /// Serves until a signal or stop(); then closes all connections, within a second. Clients are gone when it returns.
  void run();
  /// From any thread.
  void stop();
  /// Has the server's thread call a function. From any thread.
  void post(std::function<void()> function);
  /// Has the server's thread call a function again and again.
  void every(std::chrono::milliseconds interval, std::function<void()> function);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace insonify
