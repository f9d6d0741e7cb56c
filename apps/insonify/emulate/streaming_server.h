// streaming_server.h -- a sonar on TCP and UDP that pings by itself once a client has told it to.

#pragma once

#include <array>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ip/udp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "emulate/emulated_sonar.h"
#include "emulate/listening.h"
#include "emulate/stream_client.h"
#include "insonify/wire/ping_streamer.h"
#include "transport/transport_report.h"

namespace insonify {

/// Single-threaded, as Ping360Server. Its pings go to all TCP connections and to the UDP client that sent the last
/// command, when their last echo is back. It goes on until it is told to stop, also after its clients are gone.
class StreamingServer {
 public:
  /// Binds the ports.
  StreamingServer(const EmulateOptions& options, EmulatedSonar& sonar, std::unique_ptr<PingStreamer> streamer);

  /// "127.0.0.1:51200"
  [[nodiscard]] std::string address() const;

  /// Serves until SIGINT or SIGTERM.
  void run();

  [[nodiscard]] const TransportReport& report() const { return report_; }

 private:
  using Tcp = boost::asio::ip::tcp;
  using Udp = boost::asio::ip::udp;

  void accept();
  void receive();
  void take_datagram(std::size_t size);
  [[nodiscard]] StreamerAnswer take(const PingEvent& event);
  void schedule();
  void ping();
  void send(const std::vector<PingFrame>& frames);

  TransportReport report_;
  EventLoop loop_{report_};
  EmulatedSonar& sonar_;
  std::unique_ptr<PingStreamer> streamer_;
  Tcp::acceptor acceptor_;
  Udp::socket socket_;
  boost::asio::steady_timer timer_{loop_.context()};

  std::vector<std::shared_ptr<StreamClient>> clients_;
  std::optional<Udp::endpoint> udp_client_;
  std::array<std::uint8_t, 2048> datagram_ = {};
  Udp::endpoint sender_;
  bool warned_ = false;             // Of failing pings, since the last command.
  std::uint64_t command_ = 0;       // Counts commands: timers from before the last are ignored.
  WallClock::time_point next_due_;  // Of the next ping, at the earliest.
};

}  // namespace insonify
