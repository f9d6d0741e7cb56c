// net_session.h -- one connection: HTTP requests, until one of them opens a WebSocket.

#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <memory>
#include <vector>

#include "serve/net/net_server.h"

namespace insonify {

/// A connection as the server sees it.
class NetSession : public Connection {
 public:
  virtual void start() = 0;
  virtual void forget_client() = 0;
  /// At the end of the server: tells a WebSocket so, and cuts off others.
  virtual void shut() = 0;
  virtual void cut_off() = 0;
  /// Whether it has yet to send a whole request.
  [[nodiscard]] virtual bool waits_for_request() const = 0;
};

/// What sessions share.
struct NetShared {
  NetServerOptions options;
  std::vector<NetSession*> sessions;  ///< All there are, in the order they came.
};

/// It lives as long as its connection.
[[nodiscard]] std::shared_ptr<NetSession> make_session(boost::asio::ip::tcp::socket socket,
                                                       std::shared_ptr<NetShared> shared);

}  // namespace insonify
