// ping360_server.h -- a Ping360 on UDP and on a serial line: receives commands and sends pings.

#pragma once

#include <boost/asio/ip/udp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <deque>
#include <memory>
#include <optional>

#include "emulate/emulated_sonar.h"
#include "emulate/listening.h"
#include "emulate/ping360_discovery.h"
#include "emulate/serial_line.h"
#include "insonify/wire/ping360_sonar.h"
#include "transport/transport_report.h"

namespace insonify {

/// Single-threaded: an instrument makes one ping at a time. Commands that arrive during a ping are queued in the
/// system's buffers, which drop the excess; a scan can be ended between any two pings.
class Ping360Server {
 public:
  /// Binds the port.
  Ping360Server(const EmulateOptions& options, EmulatedSonar& sonar);

  /// Whether searches by broadcast are answered: clients that find a sonar take its port for granted.
  [[nodiscard]] bool is_found() const { return discovery_.has_value(); }

  /// The address, and the path of the serial line or "".
  [[nodiscard]] std::string address() const;
  [[nodiscard]] std::string serial_path() const { return serial_ ? serial_->path() : ""; }

  /// Serves until SIGINT or SIGTERM.
  void run();

  [[nodiscard]] const TransportReport& report() const { return report_; }

 private:
  using Udp = boost::asio::ip::udp;
  /// Recipient of answers; none: the serial line.
  using Client = std::optional<Udp::endpoint>;
  struct Command {
    PingEvent event;
    Client client;
  };
  /// A computed ping whose echoes the instrument still receives.
  struct Received {
    std::vector<std::uint8_t> samples = {};
    WallClock::time_point transmitted = {};
  };

  void receive();
  void receive_datagram(std::size_t size);
  void receive_bytes(std::span<const std::uint8_t> bytes);
  void work();
  void act(const Command& command);
  void answer_after_turn(const Command& command, std::vector<PingFrame> frames);
  void transmit_once(const Command& command, const Ping360& before);
  void scan(std::uint64_t ping);
  void scan_after_turn(std::uint64_t ping);
  void scan_on(std::uint64_t ping);
  void become_free();
  [[nodiscard]] WallClock::time_point turned_at(WallClock::time_point start);
  [[nodiscard]] WallClock::time_point read_out_at(const Received& received);
  Received make_ping();
  void apply_settings();
  void send_ping(const Received& received, const Client& client);
  void send(const PingFrame& frame, const Client& client);
  void refuse(std::uint16_t id, const Error& error, const Client& client);

  TransportReport report_;
  EventLoop loop_{report_};
  EmulatedSonar& sonar_;
  Udp::socket socket_;
  std::optional<Ping360Discovery> discovery_;
  std::unique_ptr<SerialLine> serial_;
  bool fast_;
  boost::asio::steady_timer ping_timer_{loop_.context()}, scan_timer_{loop_.context()};

  Ping360 instrument_;
  int head_ = 0;                            // Where the head stands, or turns to [gradians].
  WallClock::time_point due_;               // When the last event is due: the end of a turn, a message.
  std::optional<Ping360Settings> applied_;  // Settings of the simulated sonar.
  std::optional<SonarConfig> config_;       // The simulated sonar; none if all samples are blank.
  MessageLevels levels_;

  Client scan_client_;
  std::uint64_t scan_number_ = 0;  // Counts starts and ends of scans: timers of an ended one are ignored.

  std::vector<std::uint8_t> datagram_;
  Udp::endpoint sender_;
  PingParser serial_parser_;
  std::deque<Command> commands_;  // Received commands; no more are read before they are done.
  bool receiving_datagram_ = false, receiving_bytes_ = false, busy_ = false, warned_ = false;
};

}  // namespace insonify
