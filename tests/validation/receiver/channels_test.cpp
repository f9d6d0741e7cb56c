// channels_test.cpp -- channels of the receiver in whole pings: gains of groups of beams, missing beams, crosstalk.

#include "insonify/error.h"
#include "validation/calibrated_scene.h"

namespace insonify::validation::channels_test {
namespace {

constexpr double kPi = 3.14159265358979323846;

// A fan of 24 beams of 1 degree over a floor 3 m below, with everything that a receiver does.
Scenario busy(const Method& method = kRays) {
  SonarConfig sonar;
  sonar.beam_count = 24;
  sonar.azimuth_aperture = 24 * kDegree;
  sonar.azimuth_resolution = 1 * kDegree;
  sonar.elevation_center = -15 * kDegree;
  sonar.min_range = 8;
  sonar.max_range = 16;
  sonar.bin_count = 160;
  sonar.sampling = {4, 200};
  Scenario scenario = calibrated(sonar, method);
  scenario.receiver.noise = scenario.receiver.speckle = true;
  scenario.receiver.azimuth_pattern = BeamPattern::kTaylor;
  scenario.receiver.pulse = PulseKind::kLfm;
  scenario.receiver.pulse_duration = 1e-3;
  scenario.receiver.pulse_bandwidth = 60e3;  // 12.5 mm: a quarter of a bin.
  scenario.receiver.decimation = Decimation::kPeak;
  scenario.receiver.time_varied_gain = 30;
  return scenario;
}

// Five groups of 24 beams: beam b is in group 5 b / 24, so that groups begin at beams 0, 5, 10, 15 and 20.
TEST(ChannelsTest, GroupsOfBeamsHaveTheirGains) {
  const std::vector<double> gains = {0, -0.53, 2.5, -6, -0.1};
  const auto group_of = [](int beam) { return beam < 5 ? 0 : beam < 10 ? 1 : beam < 15 ? 2 : beam < 20 ? 3 : 4; };
  for (const Method& method : {kRays, kReference}) {
    Scenario scenario = busy(method);
    scenario.ground_truth = GroundTruth::kFull;
    const Scene floor = seabed_at(-3, diffuse(-27));
    const Ping even = ping_of(scenario, floor);
    scenario.sonars[0].group_gains_db = gains;
    const Ping stepped = ping_of(scenario, floor);
    for (std::size_t at = 0; at < even.intensity.size(); ++at) {
      const double gain = std::pow(10, gains[group_of(static_cast<int>(at % 24))] / 10);
      EXPECT_NEAR(stepped.intensity[at], gain * even.intensity[at], 1e-6 * even.intensity[at]) << at;
      EXPECT_NEAR(stepped.direct_intensity[at], gain * even.direct_intensity[at], 1e-6 * even.direct_intensity[at]);
    }
    EXPECT_EQ(stepped.instance, even.instance);
  }
}

// The gain is that of the channel's input: what it lifts above saturation is limited.
TEST(ChannelsTest, GainsActBeforeSaturation) {
  Scenario scenario = busy();
  scenario.receiver.time_varied_gain = {};
  scenario.receiver.saturation_db = -95;
  scenario.sonars[0].group_gains_db = {-200, 60};
  const Ping ping = ping_of(scenario, seabed_at(-3, diffuse(-27)));
  EXPECT_NEAR(cell_db(ping, 80, 12), -95, 0.001);  // From -98 dB or so, by 60 dB.
  EXPECT_LT(cell_db(ping, 80, 11), -270);
}

TEST(ChannelsTest, MissingBeamsDeliverNothing) {
  for (const GroundTruth truth : {GroundTruth::kLabels, GroundTruth::kFull}) {
    Scenario scenario = busy();
    scenario.ground_truth = truth;
    scenario.receiver.counts = true;
    scenario.receiver.full_scale_db = -60;
    scenario.sonars[0].leak_db = -20;
    scenario.sonars[0].min_range = 0.01;
    const Scene floor = seabed_at(-3, diffuse(-27));
    const Ping whole = ping_of(scenario, floor);
    scenario.sonars[0].missing_beams = {17, 0};
    const Ping ping = ping_of(scenario, floor);
    for (int bin = 0; bin < 160; ++bin) {
      for (int beam = 0; beam < 24; ++beam) {
        const std::size_t at = ping.index(bin, beam);
        const bool missing = beam == 0 || beam == 17;
        EXPECT_EQ(ping.intensity[at], missing ? 0 : whole.intensity[at]);
        EXPECT_EQ(ping.counts[at], missing ? 0 : whole.counts[at]);
        EXPECT_EQ(ping.instance[at], missing ? kNoLabel : whole.instance[at]);
        if (truth == GroundTruth::kFull && missing) {
          EXPECT_EQ(ping.direct_intensity[at], 0);
          EXPECT_EQ(ping.path_order[at], 0);
          EXPECT_EQ(ping.strongest_share[kStrongestCount * at], 0);
        }
      }
    }
    EXPECT_GT(whole.intensity[whole.index(120, 17)], 0);
    EXPECT_NE(whole.instance[whole.index(120, 17)], kNoLabel);
  }
}

// A point in the fan of a line without a window: every beam has its own share g, and the crosstalk c of their sum.
TEST(ChannelsTest, CrosstalkOfAPointIsAFloorOverTheFan) {
  for (const bool speckle : {false, true}) {
    for (const double crosstalk_db : {-45.0, -20.0}) {
      SonarConfig sonar;
      sonar.beam_count = 128;
      sonar.azimuth_aperture = 60 * kDegree;
      sonar.azimuth_resolution = 1 * kDegree;
      sonar.min_range = 0;
      sonar.max_range = 25;
      sonar.crosstalk_db = crosstalk_db;
      Scenario scenario = calibrated(sonar, kRays);
      scenario.receiver.azimuth_pattern = BeamPattern::kRectangular;
      scenario.receiver.speckle = speckle;
      const double azimuth = 7.3 * kDegree, length = 0.8858929413781328 / (2 * std::sin(0.5 * kDegree));
      scenario.points = {{.position = 15.02 * Vec3(std::cos(azimuth), std::sin(azimuth), 0)}};
      const Ping ping = ping_of(scenario, {});
      std::vector<double> gains;
      double sum = 0, energy = 0;
      for (int beam = 0; beam < 128; ++beam) {
        const double x = kPi * length * (std::sin(azimuth) - std::sin(sonar.beam_azimuth(beam)));
        gains.push_back(std::sin(x) / x);
        sum += gains.back(), energy += gains.back() * gains.back();
      }
      const double c = std::pow(10, crosstalk_db / 20);
      for (const int beam : {0, 20, 48, 63, 90, 127}) {
        const double g = gains[beam];
        const double expected = speckle ? std::pow(g + c * sum, 2) : (1 + 2 * c) * g * g + c * c * energy;
        EXPECT_NEAR(ping.intensity[ping.index(static_cast<int>(15.02 / sonar.bin_length()), beam)] * std::pow(15.02, 4),
                    expected, 0.01 * expected + 3e-5)
            << beam << ", " << speckle;  // Lobes below -60 dB are left out: 1e-3 of g, and some of their sum.
      }
    }
  }
}

// Of a floor, independent in N = 24 top-hat beams: 1 + 2 c + N c^2 of its intensity, 1.58 dB at c = 0.1, with speckle
// and without. Noise is not coupled.
TEST(ChannelsTest, CrosstalkOfAFloorAddsAllBeams) {
  for (const Decimation decimation : {Decimation::kSample, Decimation::kMean}) {
    double means[2][2];
    for (const bool speckle : {false, true}) {
      for (const bool coupled : {false, true}) {
        Scenario scenario = busy();
        scenario.receiver.noise = false;
        scenario.receiver.speckle = speckle;
        scenario.receiver.azimuth_pattern = BeamPattern::kTopHat;
        scenario.receiver.decimation = decimation;
        scenario.receiver.time_varied_gain = 50;  // The floor's fall, so that bins have equal weights.
        if (coupled) {
          scenario.sonars[0].crosstalk_db = -20;
        }
        double sum = 0;
        for (std::uint64_t seed = 1; seed <= (speckle ? 6U : 1U); ++seed) {
          scenario.seed = seed;
          sum += std::pow(10, total_db(ping_of(scenario, seabed_at(-3, diffuse(-27)))) / 10) / (speckle ? 6 : 1);
        }
        means[speckle][coupled] = sum;
      }
    }
    EXPECT_NEAR(means[false][true] / means[false][false], 1.44, 0.002);
    // The crosstalk of a bin is the same in all beams: 6 x 160 independent bins of it, whose share is 0.44.
    const double tolerance = 4 * 0.44 * 1.5 / std::sqrt(6 * 160.0);
    EXPECT_NEAR(means[true][true] / means[true][false], 1.44, tolerance) << static_cast<int>(decimation);
  }
  Scenario scenario = busy();
  const Ping quiet = ping_of(scenario, {});
  scenario.sonars[0].crosstalk_db = -20;
  EXPECT_EQ(ping_of(scenario, {}).intensity, quiet.intensity);
}

TEST(ChannelsTest, RefusesBeamsThatAreNotThere) {
  const auto message = [](auto change) {
    SonarConfig sonar;
    sonar.beam_count = 16;
    change(sonar);
    try {
      sonar.validate();
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(message([](SonarConfig& s) { s.group_gains_db.assign(17, 0); }),
            "sonar.group_gains_db has 17 gains, must have at most one for each of beam_count = 16");
  EXPECT_EQ(message([](SonarConfig& s) {
              s.missing_beams = {3, 16};
            }),
            "sonar.missing_beams[1] = 16 must be less than beam_count = 16");
  EXPECT_EQ(message([](SonarConfig& s) { s.crosstalk_db = 3; }), "sonar.crosstalk_db = 3 dB must be from -200 to 0 dB");
}

}  // namespace
}  // namespace insonify::validation::channels_test
