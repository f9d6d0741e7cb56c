// ping_streamer.h -- sonars of the ping protocol that ping by themselves once they are told to, without a sea or a
// socket.

#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "insonify/ping.h"
#include "insonify/scenario.h"
#include "insonify/wire/ping_protocol.h"

namespace insonify {

/// What follows from a frame.
struct StreamerAnswer {
  std::vector<PingFrame> frames = {};  ///< To be sent at once.
  bool accepted = false;               ///< A command was accepted: see is_on(), period() and config().
};

/// A sonar as its commands see it. Invalid values are answered with NACK and change nothing.
class PingStreamer {
 public:
  virtual ~PingStreamer() = default;
  [[nodiscard]] virtual std::unique_ptr<PingStreamer> clone() const = 0;

  /// Answers a whole frame: requests for device information and protocol version; commands that are accepted are not
  /// answered, as by the instruments.
  [[nodiscard]] StreamerAnswer take(const PingFrame& frame);

  /// NACK of a message, with a reason in ASCII.
  [[nodiscard]] static PingFrame refusal(std::uint16_t id, std::string_view reason);

  /// Whether it pings.
  [[nodiscard]] virtual bool is_on() const = 0;

  /// Time between pings that was asked for [s]; 0: as short as sound allows.
  [[nodiscard]] virtual double period() const = 0;

  /// The simulated sonar with the settings. In the calibrated model the pulse is a tone of the duration asked for.
  /// @param sonar  As the scenario has it; what no message sets is from there.
  [[nodiscard]] virtual SonarConfig config(const SonarConfig& sonar, const Scenario& scenario) const = 0;

  /// The messages of a ping.
  /// @param sonar  Of config(), with everything filled in.
  /// @param time   Of transmission, since power-up [s].
  [[nodiscard]] virtual std::vector<PingFrame> data(const Ping& ping, const SonarConfig& sonar, const Water& water,
                                                    double time) const = 0;

 protected:
  /// Takes a command. @return  False if it is unknown. @throws Error for a value out of limits.
  virtual bool command(const PingFrame& frame) = 0;
};

/// Cerulean Omniscan 450, a side-looking sonar with one beam: os_ping_params (2197), set_speed_of_sound (1002, or 116
/// in the maker's manual); os_mono_profile (2198). Layouts are those of the published definitions
/// (bluerobotics/ping-protocol, src/definitions/omniscan450.json; docs.ceruleansonar.com, "Omniscan 450"). Its echoes
/// are in dB re 1 uPa, from the loudest of a ping to 120 dB below.
[[nodiscard]] std::unique_ptr<PingStreamer> make_omniscan450();

/// Cerulean Surveyor 240-16, a multibeam echo sounder that looks down: set_ping_parameters (3023); yz_point_data
/// (3011), atof_point_data (3012), attitude_report (504) and water_stats (118), as published
/// (bluerobotics/ping-protocol, src/definitions/surveyor240.json). Points are those of BottomDetector
/// (how the instrument finds the bottom is not published).
[[nodiscard]] std::unique_ptr<PingStreamer> make_surveyor240();

}  // namespace insonify
