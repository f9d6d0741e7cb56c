// oculus_server.h -- an Oculus on TCP and UDP: broadcasts its status, takes fire messages, pings and answers.

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

#include "emulate/ipv4_network.h"
#include "emulate/oculus_client.h"
#include "emulate/oculus_pings.h"
#include "road/road_loop.h"
#include "road/road_report.h"

namespace insonify {

/// One thread talks, another makes the pings, so that large images flow meanwhile. The sonar pings from the first fire
/// message on, while anybody is connected, with the settings of the fire message that came last; every client gets
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

  [[nodiscard]] const RoadReport& report() const { return report_; }

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
  void pinged(const std::shared_ptr<const OculusPings::Heard>& heard, const std::string& failure);
  void tell(const OculusPings::Heard& heard);
  void beat();
  void send_status();
  void refuse(const OculusClient& client, const std::string& reason);
  void warn_once(const std::string& text);
  [[nodiscard]] OculusStatus status() const;

  RoadReport report_;
  RoadLoop loop_{report_};
  OculusPings pings_;
  Ipv4Network network_;
  Tcp::acceptor acceptor_;
  Udp::socket status_socket_;
  boost::asio::steady_timer beat_timer_{loop_.context()}, ping_timer_{loop_.context()}, tell_timer_{loop_.context()},
      accept_timer_{loop_.context()};

  std::vector<Client> clients_;
  boost::asio::ip::address_v4 last_client_;
  std::optional<OculusFire> wanted_;                       // The fire message that came last, until it is obeyed.
  std::optional<OculusFire> asked_;                        // The one that is obeyed; none before the first.
  std::shared_ptr<const OculusPings::Settings> settings_;  // What it means; null without.
  bool pinging_ = false;                                   // While the other thread has the simulated sonar.
  std::optional<WallClock::time_point> last_due_;          // Time of the last ping by the schedule.
  WallClock::time_point listening_until_;                  // To the last ping.
  std::set<std::string> warnings_;

  boost::asio::thread_pool maker_{1};  // Last: it ends first.
};

}  // namespace insonify
