// mutual_interference_test.cpp -- range, bearing and level of the pulses that sonars of one scenario receive from each
// other.

#include "validation/calibrated_scene.h"

namespace insonify::validation::mutual_interference_test {
namespace {

constexpr double kSoundSpeed = 1500;

double db(double value) {
  return 10 * std::log10(value);
}

// Two fans that look at each other over 6 m. The first hears 37.5 m far, 50 ms.
Scenario face_to_face() {
  SonarConfig first;
  first.name = "first";
  first.frequency = 720e3;
  first.source_level_db = 205;
  first.beam_count = 120;
  first.elevation_aperture = 24 * kDegree;
  first.min_range = 0;
  first.max_range = 37.5;
  first.bin_count = 750;
  first.ping_period = 0.07;
  SonarConfig second = first;
  second.name = "second";
  second.source_level_db = 198;
  second.ping_period = 0.09;
  second.position = {6, 0.5, 0};
  second.orientation = {0, 0, 180 * kDegree};
  Scenario scenario = calibrated(first, kRays);
  scenario.water.sound_speed = kSoundSpeed;
  scenario.sonars.push_back(second);
  scenario.mutual_interference = true;
  return scenario;
}

const double kRange = std::hypot(6, 0.5);
const double kBearing = std::atan2(0.5, 6);

double range_of_peak(const Ping& ping, const SonarConfig& sonar) {
  const auto at = std::ranges::max_element(ping.intensity) - ping.intensity.begin();
  return sonar.bin_range(static_cast<int>(at / ping.beam_count));
}

// Pulses are sent at 0, 90, 180 ... ms and arrive 4.014 ms later. The first sonar's pings are at 0, 70, 140, 210 ms: it
// hears those of 0 after 4.01 ms, of 90 after 24.01, of 180 after 44.01, and in its fourth that of 210 + ... none
// before 270. Their ranges are half of the sound's way in that time. A bin lasts 66.7 us, a pulse as long as a bin.
TEST(MutualInterferenceTest, ArrivesByBothSchedules) {
  Simulator simulator(face_to_face(), {}, 1);
  const SonarConfig& sonar = simulator.sonar(0);
  for (int ping = 0; ping < 3; ++ping) {
    EXPECT_NEAR(range_of_peak(simulator.make_ping(0, ping), sonar), 0.5 * (kRange + kSoundSpeed * 0.02 * ping), 0.06);
  }
  EXPECT_EQ(std::ranges::max(simulator.make_ping(0, 3).intensity), 0);
  // Second sonar: its second ping, at 90 ms, hears the pulse of 140 ms after 54 ms, too late; the third, at 180, that
  // of 210 ms after 34.014 ms.
  EXPECT_EQ(std::ranges::max(simulator.make_ping(1, 1).intensity), 0);
  EXPECT_NEAR(range_of_peak(simulator.make_ping(1, 2), simulator.sonar(1)), 0.5 * (kRange + kSoundSpeed * 0.03), 0.06);
}

// One way: 20 log r and absorption; both source levels; each of the two bins that a pulse may touch has its level.
TEST(MutualInterferenceTest, HasTheLevelOfOneWay) {
  Scenario scenario = face_to_face();
  const Ping ping = ping_of(scenario, {});
  const double level = 198 - 205 - 20 * std::log10(kRange);
  EXPECT_NEAR(db(std::ranges::max(ping.intensity)), level, 0.01);
  const auto at = std::ranges::max_element(ping.intensity) - ping.intensity.begin();
  EXPECT_NEAR(scenario.sonars[0].beam_azimuth(static_cast<int>(at % ping.beam_count)), kBearing, 0.51 * kDegree);
  scenario.water.absorption = true;
  scenario.water.absorption_db_per_m = 0.3;
  EXPECT_NEAR(db(std::ranges::max(ping_of(scenario, {}).intensity)), level - 0.3 * kRange, 0.01);
}

// Turned by 12 degrees about its y, the second sends at the edge of its pattern, at half power; the first one's
// pattern, of 24 degrees too, is met on its axis. A transmitter 60 degrees wide is at half power 30 degrees off.
TEST(MutualInterferenceTest, HasThePatternsOfBoth) {
  Scenario scenario = face_to_face();
  scenario.sonars[1].position.y() = 0;
  const double level = 198 - 205 - 20 * std::log10(6);
  scenario.receiver.elevation_pattern = BeamPattern::kRectangular;
  EXPECT_NEAR(db(std::ranges::max(ping_of(scenario, {}).intensity)), level, 0.01);
  scenario.sonars[1].orientation.y() = 12 * kDegree;
  EXPECT_NEAR(db(std::ranges::max(ping_of(scenario, {}).intensity)), level - db(2), 0.02);
  scenario.sonars[0].orientation.y() = 12 * kDegree;
  EXPECT_NEAR(db(std::ranges::max(ping_of(scenario, {}).intensity)), level - 2 * db(2), 0.02);
  scenario.sonars[0].orientation.y() = scenario.sonars[1].orientation.y() = 0;
  scenario.sonars[1].transmit_width = 60 * kDegree;
  scenario.sonars[1].orientation.z() = 150 * kDegree;
  EXPECT_NEAR(db(std::ranges::max(ping_of(scenario, {}).intensity)), level - db(2), 0.02);
  scenario.sonars[1].orientation.z() = 0;  // Looks away.
  EXPECT_EQ(std::ranges::max(ping_of(scenario, {}).intensity), 0);
}

// Bands of 700 to 740 and of 725 to 775 kHz share 15 kHz, 0.3 of the sender's. Apart, nothing is heard.
TEST(MutualInterferenceTest, OnlyTheSharedBandIsHeard) {
  Scenario scenario = face_to_face();
  for (SonarConfig& sonar : scenario.sonars) {
    sonar.pulse = PulseKind::kLfm;
    sonar.pulse_duration = 1e-3;
  }
  scenario.sonars[0].pulse_bandwidth = 40e3;
  scenario.sonars[1].pulse_bandwidth = 50e3;
  scenario.receiver.pulse = PulseKind::kNone;
  scenario.sonars[0].bandwidth = 40e3;
  scenario.sonars[1].receiver = scenario.receiver;
  scenario.sonars[1].receiver->pulse = PulseKind::kInstrument;
  scenario.sonars[1].frequency = 750e3;
  const double level = 198 - 205 - 20 * std::log10(kRange);
  EXPECT_NEAR(db(std::ranges::max(ping_of(scenario, {}).intensity)), level + db(0.3), 0.01);
  scenario.sonars[1].frequency = 766e3;
  EXPECT_EQ(std::ranges::max(ping_of(scenario, {}).intensity), 0);
  // From below, 660 to 710 kHz: 10 kHz. A band within the other is heard whole, one about it by the share of 40 kHz.
  scenario.sonars[1].frequency = 685e3;
  EXPECT_NEAR(db(std::ranges::max(ping_of(scenario, {}).intensity)), level + db(0.2), 0.01);
  scenario.sonars[1].frequency = 717e3;
  scenario.sonars[1].pulse_bandwidth = 30e3;
  EXPECT_NEAR(db(std::ranges::max(ping_of(scenario, {}).intensity)), level, 0.01);
  scenario.sonars[1].pulse_bandwidth = 64e3;
  EXPECT_NEAR(db(std::ranges::max(ping_of(scenario, {}).intensity)), level + db(0.625), 0.01);
}

// A head hears with its beam at its angle, and sends there.
TEST(MutualInterferenceTest, HeadsSendWhereTheyPoint) {
  Scenario scenario = face_to_face();
  SonarConfig& head = scenario.sonars[1];
  head.type = SonarType::kMechanicallyScanned;
  head.beam_count = 1;
  head.azimuth_aperture = 3 * kDegree;
  head.position = {6, 0, 0};
  head.orientation.z() = 0;
  head.head.sector_center = 178.5 * kDegree;  // Its first ping: 1.5 degrees from the other sonar.
  head.head.step = 1.5 * kDegree;
  scenario.receiver.azimuth_pattern = BeamPattern::kRectangular;
  scenario.sonars[0].azimuth_resolution = 1 * kDegree;
  Simulator simulator(scenario, {}, 1);
  const auto peak_db = [&](int ping) { return db(std::ranges::max(simulator.make_ping(0, ping).intensity)); };
  const double level = 198 - 205 - 20 * std::log10(6);
  // The beams of the first are 0.5 degrees to either side of the axis: half power.
  EXPECT_NEAR(peak_db(0), level - 2 * db(2), 0.05);
  EXPECT_NEAR(peak_db(1), level - db(2), 0.05);
}

TEST(MutualInterferenceTest, IsBlockedAndSwitchedOff) {
  Scenario scenario = face_to_face();
  EXPECT_LT(total_db(ping_of(scenario, plate_at(3, 3, diffuse(-200)))), -180);
  scenario.mutual_interference = false;
  EXPECT_EQ(std::ranges::max(ping_of(scenario, {}).intensity), 0);
}

// Beside noise, speckle and an array: the same mean as alone. A pulse of 3 ms fills 45 bins with independent phases;
// noise is 70 dB lower.
TEST(MutualInterferenceTest, AddsToNoiseWithSpeckle) {
  Scenario scenario = face_to_face();
  scenario.sonars[1].pulse = PulseKind::kCw;
  scenario.sonars[1].pulse_duration = 3e-3;
  scenario.sonars[1].bandwidth = 25e3;
  scenario.receiver.noise = scenario.receiver.speckle = true;
  scenario.receiver.azimuth_pattern = BeamPattern::kTaylor;
  const Ping ping = ping_of(scenario, {});
  const double level = 198 - 205 - 20 * std::log10(kRange);
  int loud = 0;
  for (int bin = 0; bin < ping.bin_count; ++bin) {
    loud += db(double{ping.intensity[ping.index(bin, 55)]}) > level - 6 ? 1 : 0;
  }
  EXPECT_NEAR(loud, 45, 1);
}

TEST(MutualInterferenceTest, NeedsSonarsApart) {
  Scenario scenario = face_to_face();
  scenario.sonars[1].position = {0, 0, 0.004};
  try {
    scenario.validate();
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "sonars[1].position is 0.004 m from that of sonars[0]; with mutual_interference at least 0.01 m");
  }
}

}  // namespace
}  // namespace insonify::validation::mutual_interference_test
