// gain_test.cpp -- the last stages of the receiver: gain by a table, saturation, counts, and the complex field.

#include "insonify/error.h"
#include "validation/calibrated_scene.h"

namespace insonify::validation::gain_test {
namespace {

Scenario point_at(double range) {
  SonarConfig sonar;
  sonar.min_range = 0;
  sonar.max_range = 25;
  sonar.beam_count = 16;
  Scenario scenario = calibrated(sonar, kRays);
  scenario.points = {{.position = {range, 0.01, 0}}};
  return scenario;
}

TEST(GainTest, TableIsLinearBetweenItsRangesAndConstantBeyond) {
  for (const auto& [range, gain] : {std::pair{2.025, 10.0}, {10.025, 14.0}, {15.025, 20.0}, {20.025, 30.0}}) {
    Scenario scenario = point_at(range);
    scenario.receiver.gain_ranges = {5.025, 15.025, 18};
    scenario.receiver.gains_db = {8, 20, 30};
    EXPECT_NEAR(total_db(ping_of(scenario, {})) + 40 * std::log10(range), range < 5 ? 8 : gain, 0.001) << range;
  }
}

TEST(GainTest, SaturationLimitsTheInput) {
  Scenario scenario = point_at(10.025);
  scenario.receiver.saturation_db = -50;
  scenario.receiver.time_varied_gain = 40;
  EXPECT_NEAR(total_db(ping_of(scenario, {})), -50 + 40 * std::log10(10.025), 0.001);
  scenario.receiver.saturation_db = -30;  // Above the echo, at -40.04.
  EXPECT_NEAR(total_db(ping_of(scenario, {})), 0, 0.001);
}

// What is limited is the squared sum of echo, leak and noise, after array and pulse. Of exponentially distributed
// intensities of mean m, a limit at s leaves the mean m (1 - e^(-s/m)), and the share e^(-s/m) is at the limit. Noise
// alone, at -147.0403 dB (T23); and with echoes of volume reverberation with speckle, whose mean adds to it.
TEST(SaturationTest, LimitsTheSumOfEchoesLeakAndNoise) {
  for (const bool echoes : {false, true}) {
    SonarConfig sonar;
    sonar.beam_count = 64;
    sonar.azimuth_aperture = 64 * kDegree;
    sonar.min_range = 10;
    sonar.max_range = 12;
    sonar.bin_count = 2000;
    sonar.sampling = {1, 20};
    Scenario scenario = calibrated(sonar, kRays);
    scenario.receiver.noise = scenario.receiver.speckle = true;
    if (echoes) {
      scenario.water.volume_backscatter_db = -75;  // 10 lg(psi 2 sin 10 deg (1/r - 1/(r + .001))) = -22.2 - 50.8 dB.
    }
    const double mean = std::pow(10, (total_db(ping_of(scenario, {})) - 10 * std::log10(64 * 2000)) / 10);
    if (!echoes) {
      EXPECT_NEAR(10 * std::log10(mean), -147.0403, 0.05);
    } else {
      EXPECT_GT(10 * std::log10(mean), -146);
    }
    for (const double over : {0.5, 1.0, 3.0}) {
      scenario.receiver.saturation_db = 10 * std::log10(over * mean);
      const Ping ping = ping_of(scenario, {});
      const float limit = *std::ranges::max_element(ping.intensity);
      const double share = static_cast<double>(std::ranges::count(ping.intensity, limit)) / (64 * 2000);
      EXPECT_NEAR(limit, over * mean, 1e-5 * over * mean);
      EXPECT_NEAR(share, std::exp(-over), 4 * std::sqrt(std::exp(-over) / 20000)) << over;  // 2000 bins, 10 of range.
      EXPECT_NEAR(std::pow(10, (total_db(ping) - 10 * std::log10(64 * 2000)) / 10) / mean, 1 - std::exp(-over),
                  4 / std::sqrt(20000.0))
          << over;
    }
    // A leak 20 dB above the limit saturates every bin while it lasts.
    scenario.water.volume_backscatter_db = {};
    scenario.sonars[0].leak_db = 10 * std::log10(100 * mean);
    scenario.receiver.pulse = PulseKind::kCw;
    scenario.receiver.pulse_duration = 0.02;  // 15 m.
    scenario.receiver.saturation_db = 10 * std::log10(mean);
    const Ping drowned = ping_of(scenario, {});
    EXPECT_NEAR(*std::ranges::min_element(drowned.intensity), mean, 1e-5 * mean);
  }
}

TEST(CountsTest, FollowTheRecordedLevel) {
  Scenario scenario = point_at(10.025);
  scenario.receiver.counts = true;
  scenario.receiver.full_scale_db = -10;  // 30.04 dB above the echo, of 60.
  const Ping ping = ping_of(scenario, {});
  EXPECT_EQ(*std::ranges::max_element(ping.counts), 127);
  EXPECT_EQ(std::ranges::count(ping.counts, 0), static_cast<std::ptrdiff_t>(ping.counts.size()) - 1);
  scenario.receiver.counts = false;
  EXPECT_TRUE(ping_of(scenario, {}).counts.empty());
}

// With the share q of exponentially distributed intensities at full scale, that is -ln q means: 4.605 for 1 % (6.6325
// dB), 0.2231 for 80 %. Logarithmic counts fall by 255 / 60 a decibel from there; a louder receiver changes nothing.
TEST(CountsTest, AutomaticGainFillsItsShareOfBins) {
  for (const double share : {0.01, 0.8}) {
    SonarConfig sonar;
    sonar.beam_count = 100;
    sonar.azimuth_aperture = 100 * kDegree;
    sonar.sampling = {1, 20};
    Scenario scenario = calibrated(sonar, kRays);
    scenario.receiver.noise = true;
    scenario.receiver.counts = true;
    scenario.receiver.full_scale_share = share;
    const Ping ping = ping_of(scenario, {});
    const auto count = static_cast<double>(ping.counts.size());
    const auto full = static_cast<double>(std::ranges::count(ping.counts, 255));
    // Half a count below full scale rounds to it too: 0.1176 dB, by which -ln q is multiplied by 0.9733.
    const double expected = std::pow(share, 0.9733);
    EXPECT_NEAR(full / count, expected, 4 * std::sqrt(expected / count) + 0.02 * expected)
        << share;  // And 0.4 % of -ln q.
    const double scale_db = 10 * std::log10(-std::log(share)) + total_db(ping) - 10 * std::log10(count);
    for (std::size_t at = 0; at < 300; ++at) {
      const double level = 10 * std::log10(double{ping.intensity[at]}) - scale_db;
      // The sample's own quantile and mean: 4 x 100 % / sqrt(500) of it, 0.3 dB.
      EXPECT_NEAR(ping.counts[at], std::clamp(255 * (1 + level / 60), 0.0, 255.0), 0.5 + 0.3 * 255 / 60) << at;
    }
    scenario.receiver.gain_ranges = {0};
    scenario.receiver.gains_db = {40};
    const Ping louder = ping_of(scenario, {});
    int changed = 0;
    for (std::size_t at = 0; at < louder.counts.size(); ++at) {
      changed = std::max(changed, std::abs(louder.counts[at] - ping.counts[at]));
    }
    EXPECT_LE(changed, 1);  // 0.02 dB.
  }
}

TEST(CountsTest, AutomaticGainOfNothingIsNothing) {
  Scenario scenario = point_at(10.025);
  scenario.points.clear();
  scenario.receiver.counts = true;
  scenario.receiver.full_scale_share = 1;
  EXPECT_EQ(std::ranges::count(ping_of(scenario, {}).counts, 0), 16 * 500);
}

// The squared magnitude of the field is the intensity, and the phase of a point changes by 4 pi / wavelength per metre
// of range.
TEST(FieldTest, PhaseTurnsTwicePerWavelengthOfRange) {
  Scenario scenario = point_at(10.025);
  scenario.receiver.speckle = true;
  scenario.receiver.field = true;
  scenario.receiver.time_varied_gain = 30;
  const Ping first = ping_of(scenario, {});
  const std::size_t cell = std::ranges::max_element(first.intensity) - first.intensity.begin();
  EXPECT_NEAR(std::norm(first.field[cell]) / first.intensity[cell], 1, 1e-5);
  const double wavelength = scenario.water.true_sound_speed() / scenario.sonars[0].frequency;
  scenario.points[0].position.x() += wavelength / 8;  // A quarter of a turn, out and back.
  const Ping second = ping_of(scenario, {});
  EXPECT_NEAR(std::arg(second.field[cell] / first.field[cell]), 0.5 * 3.14159265, 0.01);
}

TEST(ReceiverConfigTest, RefusesSettingsThatExcludeEachOther) {
  const auto message = [](auto change) {
    ReceiverConfig receiver;
    change(receiver);
    try {
      receiver.validate();
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(message([](ReceiverConfig& r) {
              r.gain_ranges = {1, 2};
            }),
            "receiver.gains_db has 0 values for the 2 of receiver.gain_ranges");
  EXPECT_EQ(message([](ReceiverConfig& r) {
              r.gain_ranges = {1, 1}, r.gains_db = {0, 1};
            }),
            "receiver.gain_ranges[1] = 1 m must be greater than the one before it, 1 m");
  EXPECT_EQ(message([](ReceiverConfig& r) { r.gain_ranges = {1}, r.gains_db = {0}, r.time_varied_gain = 40; }),
            "receiver.time_varied_gain must be none where receiver.gain_ranges has a table");
  EXPECT_EQ(message([](ReceiverConfig& r) { r.field = true, r.speckle = false; }),
            "receiver.field needs receiver.speckle: without it echoes have no phase");
  EXPECT_EQ(message([](ReceiverConfig& r) { r.counts = true; }),
            "receiver.counts needs receiver.full_scale_db, the recorded level of the greatest count, or "
            "receiver.full_scale_share, the share of bins that have it");
  EXPECT_EQ(message([](ReceiverConfig& r) { r.counts = true, r.full_scale_share = 0.1; }), "");
  EXPECT_EQ(message([](ReceiverConfig& r) { r.full_scale_db = 0, r.full_scale_share = 0.1; }),
            "receiver.full_scale_share = 0.1 cannot go with receiver.full_scale_db = 0 dB; write none for one of them");
  EXPECT_EQ(message([](ReceiverConfig& r) { r.saturation_db = 200; }),
            "receiver.saturation_db = 200 dB must be from -400 to 100 dB");
}

}  // namespace
}  // namespace insonify::validation::gain_test
