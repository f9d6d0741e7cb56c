// omniscan450.cpp -- commands and profiles of a Cerulean Omniscan 450.

#include <algorithm>
#include <cmath>

#include "insonify/wire/ping_streamer.h"
#include "wire/little_endian.h"
#include "wire/streamer_parts.h"

namespace insonify {
namespace {

// Definitions and manual differ in the id of set_speed_of_sound.
constexpr std::uint16_t kSetSpeedOfSound = 1002, kSetSpeedOfManual = 116, kOsPingParams = 2197, kOsMonoProfile = 2198;
constexpr double kSpanDb = 120;  // From the loudest to the weakest value of a profile.

// Clockwise from north, which is the world's y [deg], 0..360.
float heading_of(const Eigen::Quaterniond& world_from_body) {
  constexpr double kTurn = 360;
  const Vec3 ahead = world_from_body * Vec3::UnitX();
  return static_cast<float>(std::fmod(degrees_from_radians(std::atan2(ahead.x(), ahead.y())) + kTurn, kTurn));
}

// Settings as the published client sends them by default.
struct OmniscanSettings {
  std::uint32_t start_mm = 0, length_mm = 5000, msec_per_ping = 0;
  float pulse_len_percent = 0.002F;  // Share of the length, for all its name: the published client sends 0.01 for 1 %.
  std::int16_t gain_index = -1;      // Automatic.
  std::uint16_t num_results = 600;
  bool enable = false;
  double sound_speed = 1500;  // [m/s]
};

class Omniscan450 : public PingStreamer {
 public:
  [[nodiscard]] std::unique_ptr<PingStreamer> clone() const override { return std::make_unique<Omniscan450>(*this); }
  [[nodiscard]] bool is_on() const override { return settings_.enable; }
  [[nodiscard]] double period() const override { return settings_.msec_per_ping * kMilliseconds; }

  [[nodiscard]] SonarConfig config(const SonarConfig& sonar, const Scenario& scenario) const override {
    const double start = settings_.start_mm * kMillimetres;
    return over_window(sonar, scenario, start, start + settings_.length_mm * kMillimetres, settings_.num_results,
                       settings_.sound_speed, pulse());
  }

  [[nodiscard]] std::vector<PingFrame> data(const Ping& ping, const SonarConfig& sonar, const Water& water,
                                            double time) const override;

 private:
  bool command(const PingFrame& frame) override;
  void take_params(const PingFrame& frame);

  // Duration of the pulse [s].
  [[nodiscard]] double pulse() const {
    const double share = settings_.pulse_len_percent;
    return std::max(1e-6, share * 2 * settings_.length_mm * kMillimetres / settings_.sound_speed);
  }

  OmniscanSettings settings_;
};

bool Omniscan450::command(const PingFrame& frame) {
  if (frame.id == kOsPingParams) {
    take_params(frame);
    return true;
  }
  if (frame.id != kSetSpeedOfSound && frame.id != kSetSpeedOfManual) {
    return false;
  }
  check_size(frame, sizeof(std::uint32_t));
  std::uint32_t speed_mm = 0;
  PacketReader(frame.payload).get(speed_mm);
  check_value("speed_of_sound", speed_mm, from_to(1.3e6, 1.7e6));
  settings_.sound_speed = speed_mm * kMillimetres;
  return true;
}

// Definitions of different age end with one and with three reserved bytes.
void Omniscan450::take_params(const PingFrame& frame) {
  constexpr std::size_t kOld = 34, kNew = 36;
  if (frame.payload.size() != kOld) {
    check_size(frame, kNew);
  }
  OmniscanSettings asked = settings_;
  float reserved = 0, filter = 0;
  std::uint8_t enable = 0;
  PacketReader(frame.payload)
      .get(asked.start_mm, asked.length_mm, asked.msec_per_ping, reserved, reserved, asked.pulse_len_percent, filter,
           asked.gain_index, asked.num_results, enable);
  check_value("start_mm", asked.start_mm, from_to(0, 1e6));
  check_value("length_mm", asked.length_mm, from_to(1, 1e6));
  check_value("msec_per_ping", asked.msec_per_ping, from_to(0, 1e6));
  check_value("pulse_len_percent", static_cast<double>(asked.pulse_len_percent), from_to(0, 0.5));
  check_value("gain_index", asked.gain_index, from_to(-1, 7));
  check_value("num_results", asked.num_results, from_to(200, 1200));
  check_value("enable", enable, from_to(0, 1));
  asked.enable = enable == 1;
  settings_ = asked;
}

std::vector<PingFrame> Omniscan450::data(const Ping& ping, const SonarConfig& sonar, const Water& /*water*/,
                                         double time) const {
  std::vector<double> levels(ping.intensity.size());
  std::ranges::transform(ping.intensity, levels.begin(), [&](float intensity) {
    return sonar.source_level_db + 10 * std::log10(std::max(1e-30, static_cast<double>(intensity)));
  });
  const double most = *std::ranges::max_element(levels), least = most - kSpanDb;
  constexpr double kFull = 65535;
  const Eigen::Quaterniond& sonar_axes = ping.world_from_sonar.orientation;
  PingFrame frame{.id = kOsMonoProfile, .source = 1};
  put(frame.payload, static_cast<std::uint32_t>(ping.number), settings_.start_mm, settings_.length_mm,
      static_cast<std::uint32_t>(static_cast<std::uint64_t>(time / kMilliseconds)),
      static_cast<std::uint32_t>(sonar.frequency), static_cast<std::uint16_t>(std::max<int>(0, settings_.gain_index)),
      static_cast<std::uint16_t>(levels.size()), static_cast<std::uint16_t>(std::lround(10 * settings_.sound_speed)),
      std::uint8_t{0}, std::uint8_t{0}, static_cast<float>(pulse()), 0.0F, static_cast<float>(most),
      static_cast<float>(least), heading_of(sonar_axes),
      heading_of(sonar_axes * sonar.vehicle_from_sonar().orientation.conjugate()));
  for (const double level : levels) {
    put(frame.payload,
        static_cast<std::uint16_t>(std::lround(kFull * std::clamp((level - least) / kSpanDb, 0.0, 1.0))));
  }
  return {frame};
}

}  // namespace

std::unique_ptr<PingStreamer> make_omniscan450() {
  return std::make_unique<Omniscan450>();
}

}  // namespace insonify
