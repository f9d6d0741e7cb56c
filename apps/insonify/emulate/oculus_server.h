// oculus_server.h -- an Oculus on TCP and UDP: broadcasts its status, receives fire messages and sends pings.

#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ip/udp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/thread_pool.hpp>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "emulate/listening.h"
#include "emulate/oculus_client.h"
#include "emulate/oculus_pings.h"
#include "transport/transport_report.h"

namespace insonify {

/// One thread communicates, another makes pings, so that large images are sent meanwhile. The sonar pings after the
/// first fire message while a client is connected, with the settings of the latest fire message; every client gets
/// every ping.
class OculusServer {
 public:
  /// Binds the port.
  OculusServer(const EmulateOptions& options, EmulatedSonar& sonar);

  /// "127.0.0.1:52100"
  [[nodiscard]] std::string address() const;
  /// "127.0.0.1:52102"
  [[nodiscard]] std::string status_address() const;
  [[nodiscard]] const OculusModes& modes() const { return pings_.modes(); }

  /// Serves until SIGINT or SIGTERM.
  void run();

  [[nodiscard]] const TransportReport& report() const { return report_; }

 private:
  using Tcp = boost::asio::ip::tcp;
  using Udp = boost::asio::ip::udp;
  using Client = std::shared_ptr<OculusClient>;

  void accept();
  void welcome(Tcp::socket socket);
  void forget(OculusClient& client);
  void take(OculusClient& client, const OculusMessage& message);
  void obey();
  void schedule();
  void ping(WallClock::time_point due);
  void pinged(const std::shared_ptr<const OculusPings::Received>& received, const std::string& failure);
  void send_ping(const OculusPings::Received& received);
  void beat();
  void end_silent_clients();
  void send_status();
  void refuse(const OculusClient& client, const std::string& reason);
  void warn_once(const std::string& text);
  [[nodiscard]] OculusStatus status() const;

  std::chrono::duration<double> silence_;
  TransportReport report_;
  EventLoop loop_{report_};
  OculusPings pings_;
  Ipv4Network network_;
  Tcp::acceptor acceptor_;
  Udp::socket status_socket_;
  boost::asio::steady_timer beat_timer_{loop_.context()}, ping_timer_{loop_.context()}, send_timer_{loop_.context()},
      accept_timer_{loop_.context()};

  std::vector<Client> clients_;
  boost::asio::ip::address_v4 last_client_;
  std::optional<OculusFire> wanted_;                       // Latest fire message, until it is applied.
  std::optional<OculusFire> asked_;                        // The applied one; none before the first.
  std::shared_ptr<const OculusPings::Settings> settings_;  // Its settings; null without.
  bool pinging_ = false;                                   // Whether the other thread uses the simulated sonar.
  std::optional<WallClock::time_point> last_due_;          // Scheduled time of the last ping.
  WallClock::time_point listening_until_;                  // Arrival time of the last echo of the last ping.
  std::set<std::string> warnings_;

  boost::asio::thread_pool maker_{1};  // Last: it ends first.
};

}  // namespace insonify
