// net_session.h -- one connection: HTTP requests, until one opens a WebSocket.

#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <memory>
#include <vector>

#include "serve/net/net_server.h"

namespace insonify {

/// The server's interface to a connection.
class NetSession : public Connection {
 public:
  virtual void start() = 0;
  virtual void forget_client() = 0;
  /// Called when the server ends: closes a WebSocket with a reason, and disconnects others.
  virtual void shut() = 0;
  virtual void cut_off() = 0;
  /// Whether it has not sent a complete request yet.
  [[nodiscard]] virtual bool waits_for_request() const = 0;
};

/// State shared by sessions.
struct NetShared {
  NetServerOptions options;
  std::vector<NetSession*> sessions;  ///< All sessions, oldest first.
};

/// Lives as long as its connection.
[[nodiscard]] std::shared_ptr<NetSession> make_session(boost::asio::ip::tcp::socket socket,
                                                       std::shared_ptr<NetShared> shared);

}  // namespace insonify
