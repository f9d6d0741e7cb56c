// ping360.h -- a Blue Robotics Ping360 as its commands see it: settings, scans and answers, without a sea or a socket.

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "insonify/wire/ping_protocol.h"

namespace insonify {

/// Steps of a turn of the head [gradians].
inline constexpr int kGradiansPerTurn = 400;

/// UDP port of the instrument, where clients that have found it by broadcast call it.
inline constexpr int kPing360Port = 12345;

/// The instrument's answer to a search by broadcast: four lines, name, maker, MAC address and IP address, as Ping
/// Viewer and BlueOS read them (src/link/ping360asciiprotocol.h; core/services/ping/ping360_ethernet_prober.py).
/// @param address  IPv4 address of the instrument.
[[nodiscard]] std::string ping360_introduction(const std::array<std::uint8_t, 4>& address);

/// Times of the instrument, beside those of the sound, from turns that were timed over Ethernet
/// (discuss.bluerobotics.com, thread 8328): 400 pings 1 gradian apart take 10.74 s at 2 m and 20.57 s at 20 m, 40 pings
/// 10 gradians apart 3.29 s at 2 m. How they are shared out within a ping is our assumption.
inline constexpr double kPing360StepTime = 6.2e-3;      ///< For the head to turn by 1 gradian [s].
inline constexpr double kPing360ReadoutTime = 18.2e-3;  ///< From the end of a ping's last sample to its message [s].

/// Time for the head to turn from one angle to another, the shorter way [s].
/// @param from, to  [gradians], 0..399.
[[nodiscard]] double ping360_turn_time(int from, int to);

/// Settings of a Ping360. Initial values are those of the instrument when it is switched on, as far as drivers
/// show them.
struct Ping360Settings {
  std::uint8_t mode = 1;                   ///< Reserved; sent back as it came.
  std::uint8_t gain_setting = 0;           ///< 0 low, 1 normal, 2 high.
  std::uint16_t angle = 0;                 ///< Angle of the head [gradians], 0..399.
  std::uint16_t transmit_duration = 32;    ///< [us], 1..1000.
  std::uint16_t sample_period = 80;        ///< [25 ns], 80..40000.
  std::uint16_t transmit_frequency = 740;  ///< [kHz], 500..1000.
  std::uint16_t sample_count = 200;        ///< "number_of_samples", 200..1200.

  [[nodiscard]] double sample_interval() const { return 25e-9 * sample_period; }            ///< [s]
  [[nodiscard]] double listening_time() const { return sample_interval() * sample_count; }  ///< [s]

  [[nodiscard]] bool operator==(const Ping360Settings&) const = default;
};

/// The sector of an auto_transmit.
struct Ping360Sector {
  std::uint16_t start_angle = 0;  ///< [gradians], 0..399.
  std::uint16_t stop_angle = 0;   ///< [gradians], 0..399; from start_angle the head turns to it with rising angles.
  std::uint8_t step = 1;          ///< "num_steps" [gradians], 1..10.
  std::uint8_t delay = 0;         ///< Between pings [ms], 0..100.

  /// The angle of ping n of a scan [gradians]. Where start and stop are neighbours across less than a step, the head
  /// keeps turning. Another sector of more than half a turn is swept one way, from start to its last whole step, again
  /// and again; a smaller one to and fro.
  [[nodiscard]] std::uint16_t angle_at(std::uint64_t ping) const;
};

/// What follows from a frame.
struct Ping360Answer {
  std::vector<PingFrame> frames = {};  ///< To be sent at once.
  bool transmit = false;               ///< A ping is to be made with settings() and sent with data().
  bool scan_changed = false;           ///< A scan has started, restarted or ended: see sector().
};

/// Handles commands and stores their settings. Invalid values are answered with NACK and change nothing.
class Ping360 {
 public:
  /// Answers a whole frame. Frames for another device are not answered.
  [[nodiscard]] Ping360Answer take(const PingFrame& frame);

  /// Answers what a parser found. A break ends a scan.
  [[nodiscard]] Ping360Answer take(const PingEvent& event);

  [[nodiscard]] const Ping360Settings& settings() const { return settings_; }
  [[nodiscard]] const std::optional<Ping360Sector>& sector() const { return sector_; }  ///< None: not scanning.

  /// Turns the head to ping n of the scan.
  void turn_to(std::uint64_t ping);

  /// Ends a scan.
  void stop() { sector_.reset(); }

  /// device_data (2300), or auto_device_data (2301) while scanning.
  /// @param samples  sample_count of them, or none where nothing was transmitted.
  [[nodiscard]] PingFrame data(std::span<const std::uint8_t> samples) const;

  /// NACK of a command, with a reason in ASCII.
  [[nodiscard]] PingFrame refusal(std::uint16_t id, std::string_view reason) const;

 private:
  [[nodiscard]] PingFrame frame(std::uint16_t id, std::vector<std::uint8_t> payload) const;
  [[nodiscard]] Ping360Answer accepted(std::uint16_t id) const;
  [[nodiscard]] Ping360Answer refused(std::uint16_t id, std::string_view reason) const;
  [[nodiscard]] Ping360Answer requested(std::uint16_t id) const;
  [[nodiscard]] Ping360Answer set_device(const PingFrame& frame);
  [[nodiscard]] Ping360Answer set_transducer(const PingFrame& frame);
  [[nodiscard]] Ping360Answer start_scan(const PingFrame& frame);

  std::uint8_t device_ = 1;
  Ping360Settings settings_;
  std::optional<Ping360Sector> sector_;
};

}  // namespace insonify
