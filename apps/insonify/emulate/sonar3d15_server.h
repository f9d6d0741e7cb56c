// sonar3d15_server.h -- a Water Linked Sonar 3D-15: sends range images by UDP.

#pragma once

#include <boost/asio/ip/udp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <string>

#include "emulate/emulated_sonar.h"
#include "emulate/listening.h"
#include "transport/transport_report.h"

namespace insonify {

/// Sends an image when the sound from the end of the range could be back, to a multicast group or to one address.
class Sonar3d15Server {
 public:
  Sonar3d15Server(const EmulateOptions& options, EmulatedSonar& sonar);

  /// "224.0.0.96:4747"
  [[nodiscard]] std::string destination() const;
  /// Images a second: the instrument's 5, or 20 with a field of view at most 40 degrees wide; fewer where the
  /// scenario's ping_period or the sound's travel takes longer [Hz].
  [[nodiscard]] double rate() const { return 1 / period_; }

  /// Serves until SIGINT or SIGTERM.
  void run();

  [[nodiscard]] const TransportReport& report() const { return report_; }

 private:
  void look(WallClock::time_point due);

  TransportReport report_;
  EventLoop loop_{report_};
  EmulatedSonar& sonar_;
  boost::asio::ip::udp::endpoint destination_;
  boost::asio::ip::udp::socket socket_;
  boost::asio::steady_timer timer_{loop_.context()};
  SonarConfig view_;
  double travel_ = 0, period_ = 0;  // [s]
  std::uint32_t number_ = 0;
};

}  // namespace insonify
