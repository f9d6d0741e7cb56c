// surveyor240.cpp -- commands, points and reports of a Cerulean Surveyor 240-16.

#include <algorithm>
#include <cmath>

#include "insonify/acoustics/sound_speed.h"
#include "insonify/survey/bottom_detection.h"
#include "insonify/wire/ping_streamer.h"
#include "wire/little_endian.h"
#include "wire/streamer_parts.h"

namespace insonify {
namespace {

constexpr std::uint16_t kWaterStats = 118, kAttitudeReport = 504, kYzPointData = 3011, kAtofPointData = 3012,
                        kSetPingParameters = 3023;

struct SurveyorSettings {
  std::int32_t start_mm = 0, end_mm = 5000;  // end_mm 0: automatic; below 0: automatic, to -end_mm at most.
  float sos_mps = 1500;
  std::int16_t gain_index = -1, msec_per_ping = 100;
  bool ping_enable = false, enable_yz = false, enable_atof = false;
  std::uint16_t n_range_steps = 400;
  float pulse_len_steps = 1.5F;

  // There and back [s].
  [[nodiscard]] double travel_time(double range) const { return 2 * range / static_cast<double>(sos_mps); }
};

// The bottom in the beams that have found it. A fan that looks down is searched as a multibeam is.
std::vector<Sounding> points_of(const Ping& ping, SonarConfig sonar) {
  std::vector<Sounding> points = ping.soundings;
  if (!sonar.is_multibeam()) {
    sonar.type = SonarType::kMultibeam;
    points = BottomDetector(sonar).detect(ping);
  }
  std::erase_if(points, [](const Sounding& sounding) { return !sounding.found(); });
  return points;
}

// The world's vertical in the frame of the device: x forward, y to port, z up where the sonar looks down.
Vec3 up_of(const Ping& ping) {
  const Vec3 up = ping.world_from_sonar.orientation.conjugate() * Vec3::UnitZ();
  return {up.z(), up.y(), -up.x()};
}

double pressure_of(const Water& water) {
  constexpr double kAtmosphere = 1.01325, kBarPerMegapascal = 10;
  return kAtmosphere + kBarPerMegapascal * pressure_mpa(water.depth, radians_from_degrees(45));
}

void put_vector(std::vector<std::uint8_t>& bytes, const Vec3& vector) {
  put(bytes, static_cast<float>(vector.x()), static_cast<float>(vector.y()), static_cast<float>(vector.z()));
}

class Surveyor240 : public PingStreamer {
 public:
  [[nodiscard]] std::unique_ptr<PingStreamer> clone() const override { return std::make_unique<Surveyor240>(*this); }
  [[nodiscard]] bool is_on() const override { return settings_.ping_enable; }
  [[nodiscard]] double period() const override { return settings_.msec_per_ping * kMilliseconds; }

  [[nodiscard]] SonarConfig config(const SonarConfig& sonar, const Scenario& scenario) const override {
    constexpr double kLeastShare = 0.05;  // Of the end, as published.
    const bool automatic = settings_.end_mm <= 0;
    const double end = settings_.end_mm == 0 ? sonar.max_range : std::abs(settings_.end_mm * kMillimetres);
    const double start = std::max(kLeastShare * end, automatic ? 0 : settings_.start_mm * kMillimetres);
    SonarConfig asked = over_window(sonar, scenario, start, end, settings_.n_range_steps, settings_.sos_mps, 1e-6);
    if (asked.receiver && scenario.model == EchoModel::kCalibrated) {
      asked.receiver->pulse_duration = pulse_of(asked);
    }
    return asked;
  }

  [[nodiscard]] std::vector<PingFrame> data(const Ping& ping, const SonarConfig& sonar, const Water& water,
                                            double time) const override;

 private:
  bool command(const PingFrame& frame) override;

  // Duration of the pulse [s].
  [[nodiscard]] double pulse_of(const SonarConfig& sonar) const {
    return static_cast<double>(settings_.pulse_len_steps) * settings_.travel_time(sonar.bin_length());
  }

  [[nodiscard]] PingFrame yz_points(const Ping& ping, const SonarConfig& sonar, const Water& water, std::uint32_t now,
                                    const std::vector<Sounding>& soundings) const;
  [[nodiscard]] PingFrame atof_points(const Ping& ping, const SonarConfig& sonar, std::uint32_t now,
                                      const std::vector<Sounding>& soundings) const;

  SurveyorSettings settings_;
};

bool Surveyor240::command(const PingFrame& frame) {
  if (frame.id != kSetPingParameters) {
    return false;
  }
  check_size(frame, 36);
  SurveyorSettings asked;
  std::uint16_t deprecated = 0, reserved = 0;
  std::uint8_t injected = 0, on = 0, channels = 0, raw = 0, yz = 0, atof = 0;
  std::int32_t target_hz = 0;
  PacketReader(frame.payload)
      .get(asked.start_mm, asked.end_mm, asked.sos_mps, asked.gain_index, asked.msec_per_ping, deprecated, injected, on,
           channels, raw, yz, atof, target_hz, asked.n_range_steps, reserved, asked.pulse_len_steps);
  check_value("end_mm", asked.end_mm, from_to(-1e6, 1e6));
  check_value("start_mm", asked.start_mm, from_to(0, asked.end_mm <= 0 ? 1e6 : asked.end_mm - 1.0));
  check_value("sos_mps", static_cast<double>(asked.sos_mps), from_to(1300, 1700));
  check_value("gain_index", asked.gain_index, from_to(-1, 100));
  check_value("msec_per_ping", asked.msec_per_ping, from_to(0, 32767));
  check_value("n_range_steps", asked.n_range_steps, from_to(200, 800));
  check_value("pulse_len_steps", static_cast<double>(asked.pulse_len_steps), above_to(0, 100));
  asked.ping_enable = on != 0;
  asked.enable_yz = yz != 0;
  asked.enable_atof = atof != 0;
  settings_ = asked;
  return true;
}

PingFrame Surveyor240::yz_points(const Ping& ping, const SonarConfig& sonar, const Water& water, std::uint32_t now,
                                 const std::vector<Sounding>& soundings) const {
  PingFrame frame{.id = kYzPointData, .source = 1};
  put(frame.payload, now, static_cast<std::uint32_t>(ping.number), settings_.sos_mps);
  put_vector(frame.payload, up_of(ping));
  put_vector(frame.payload, Vec3::Zero());  // The magnetic field: reserved.
  constexpr int kReserved = 10;
  for (int i = 0; i < kReserved; ++i) {
    put(frame.payload, std::uint32_t{0});
  }
  put(frame.payload, static_cast<float>(water.temperature_c), static_cast<float>(pressure_of(water)), 0.0F,
      static_cast<float>(sonar.min_range), static_cast<float>(sonar.max_range), std::uint16_t{0},
      static_cast<std::uint16_t>(soundings.size()));
  for (const Sounding& sounding : soundings) {
    put(frame.payload, sounding.range * std::sin(sounding.azimuth), -sounding.range * std::cos(sounding.azimuth));
  }
  return frame;
}

PingFrame Surveyor240::atof_points(const Ping& ping, const SonarConfig& sonar, std::uint32_t now,
                                   const std::vector<Sounding>& soundings) const {
  PingFrame frame{.id = kAtofPointData, .source = 1};
  put(frame.payload, now, std::uint64_t{0});  // UTC is not available.
  put(frame.payload, static_cast<float>(settings_.travel_time(sonar.max_range)), settings_.sos_mps,
      static_cast<std::uint32_t>(ping.number), static_cast<std::uint32_t>(sonar.frequency),
      static_cast<float>(pulse_of(sonar)), std::uint32_t{0}, static_cast<std::uint16_t>(soundings.size()),
      std::uint16_t{0});
  for (const Sounding& sounding : soundings) {
    put(frame.payload, sounding.azimuth, static_cast<float>(settings_.travel_time(double{sounding.range})),
        std::uint32_t{0}, std::uint32_t{0});
  }
  return frame;
}

std::vector<PingFrame> Surveyor240::data(const Ping& ping, const SonarConfig& sonar, const Water& water,
                                         double time) const {
  const auto now = static_cast<std::uint32_t>(static_cast<std::uint64_t>(time / kMilliseconds));
  const std::vector<Sounding> soundings = points_of(ping, sonar);
  std::vector<PingFrame> frames;
  if (settings_.enable_yz) {
    frames.push_back(yz_points(ping, sonar, water, now, soundings));
  }
  if (settings_.enable_atof) {
    frames.push_back(atof_points(ping, sonar, now, soundings));
  }
  PingFrame& attitude = frames.emplace_back(PingFrame{.id = kAttitudeReport, .source = 1});
  put_vector(attitude.payload, up_of(ping));
  put_vector(attitude.payload, Vec3::Zero());
  put(attitude.payload, std::uint64_t{0}, now);
  PingFrame& stats = frames.emplace_back(PingFrame{.id = kWaterStats, .source = 1});
  put(stats.payload, static_cast<float>(water.temperature_c), static_cast<float>(pressure_of(water)));
  return frames;
}

}  // namespace

std::unique_ptr<PingStreamer> make_surveyor240() {
  return std::make_unique<Surveyor240>();
}

}  // namespace insonify
