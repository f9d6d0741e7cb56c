// net_server.h -- an HTTP and WebSocket server on one port, independent of the content.

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

/// An outgoing message. All its receivers share the bytes.
struct OutMessage {
  std::shared_ptr<const std::string> bytes;
  std::string head = {};  ///< Sent before the bytes.
  bool binary = false;
  bool droppable = false;    ///< A ping: dropped when more than kQueuedPings of its stream are queued.
  std::uint32_t stream = 0;  ///< For connections with several streams.
};

/// Largest number of queued pings per stream and client.
inline constexpr std::size_t kQueuedPings = 4;

/// One open WebSocket connection. For the server's thread only, like everything here unless stated otherwise.
class Connection {
 public:
  virtual ~Connection() = default;
  /// Queues a message without blocking. A client with too many queued bytes other than pings is disconnected.
  virtual void send(OutMessage message) = 0;
  /// Closes the connection once the queue is sent, or after two seconds.
  virtual void close(std::uint16_t code, std::string_view reason) = 0;
  /// Number of dropped pings.
  [[nodiscard]] virtual std::uint64_t dropped() const = 0;
};

/// Handles one connection. An exception from its functions ends the connection, with its text as the reason.
class Client {
 public:
  virtual ~Client() = default;
  virtual void on_text(std::string_view text) = 0;
  virtual void on_binary(std::string_view bytes) = 0;
};

/// A file to serve.
struct ServedFile {
  std::string_view type;  ///< "text/html; charset=utf-8"
  std::string bytes;
};

struct NetServerOptions {
  std::string address = "127.0.0.1";
  std::uint16_t port = 8765;  ///< 0: any free port.
  AccessRules access;
  std::vector<std::string> protocols;  ///< Supported subprotocols.
  /// A file by the path of its URL, decoded: "/index.html".
  std::function<std::optional<ServedFile>(std::string_view path)> file;
  /// Called for a new client. Never returns null.
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

  /// From now on SIGINT and SIGTERM end run(), even before it has started.
  void watch_signals();
  /// Serves until a signal or stop(), then closes all connections within a second. Destroys all clients before it
  /// returns.
  void run();
  /// From any thread.
  void stop();
  /// Posts a function to the server's thread. From any thread.
  void post(std::function<void()> function);
  /// Calls a function periodically in the server's thread.
  void every(std::chrono::milliseconds interval, const std::function<void()>& function);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace insonify
