// mutual_interference.h -- pulses that the sonars of one scenario receive from each other.

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "echo/batch/echo_source.h"
#include "insonify/array_pattern.h"
#include "sonar/elevation_pattern.h"
#include "sonar/fan_pattern.h"

namespace insonify {

struct Aperture;
struct SimulatedSonar;

/// An aperture of a sonar as a source of pulses: its schedule, and its directivity.
class SendingSonar {
 public:
  /// @param receiver  Receiver of the aperture.
  SendingSonar(const SimulatedSonar& sonar, const Aperture& aperture, const ReceiverConfig& receiver);

  [[nodiscard]] const std::string& name() const { return sonar_.name; }
  [[nodiscard]] const Vec3& place() const { return vehicle_from_housing_.position; }  ///< Position on the vehicle [m].
  [[nodiscard]] double source_level_db() const { return sonar_.source_level_db; }
  [[nodiscard]] double period() const {
    return *sonar_.ping_period;
  }  ///< Time between pings, the first of which is at time 0 [s].
  [[nodiscard]] double duration() const { return duration_; }  ///< Duration of a pulse [s].

  /// Share of its pulse's energy in the band of another sonar's pulse, 0..1. Both spectra are taken as flat from
  /// frequency - bandwidth / 2 to frequency + bandwidth / 2.
  [[nodiscard]] double share_within(const SendingSonar& other) const;

  /// Transmit gain (intensity) in a direction during a ping; 0 behind the sonar.
  /// @param direction  Unit vector in the frame of the vehicle.
  [[nodiscard]] double gain(std::uint64_t ping, const Vec3& direction) const;

 private:
  SonarConfig sonar_;
  Pose vehicle_from_housing_, housing_from_aperture_;
  double duration_ = 0, bandwidth_ = 0;
  BearingGrid beams_;
  PatternAxis sent_axis_;
  std::vector<float> sent_across_;  // Across elevations, see FlatPlan; empty for a top hat.
  FanPattern transmitter_;
  std::optional<ArrayPattern> array_;  // One-way pattern of an array that transmits.
  double array_length_ = 0;            // [wavelengths]
};

/// Pulses of all other sonars of a scenario that arrive during the ping of one, as discrete echoes, if the path is
/// unobstructed. Positions are those at transmission. Pulses from outside the fan are received through side lobes.
class MutualInterference final : public EchoSource {
 public:
  /// @param senders    All sonars of the scenario.
  /// @param receiving  Name of the sonar that receives; it does not receive the pulses of its own other side.
  /// @param has_array  See Interference.
  MutualInterference(std::span<const SendingSonar> senders, std::string_view receiving, bool has_array);

  void ask(const PingView& view, Workers& workers, RayList& rays) override;
  void answer(const PingView& view, const RayAnswers& hits, Workers& workers, RayList& more, EchoList& found) override;

 private:
  // Another sonar whose pulses are within the receiver's band and fan at this ping.
  struct Sender {
    std::size_t index;
    int beam;
    double range;
    Vec3f direction;  // In the sonar frame.
  };

  std::span<const SendingSonar> senders_;
  std::size_t own_;  // Index of the receiving sonar, or of its first side.
  bool has_array_;
  std::vector<Sender> near_;  // [sight]
};

}  // namespace insonify
