// side_scan_receiver_test.cpp -- what the receivers of side-scan sonars add to echoes: crosstalk, noise and speckle of
// the two sides, coarse bins, the leak, truth of both sides.

#include <numeric>

#include "insonify/error.h"
#include "validation/decibels.h"
#include "validation/pi.h"
#include "validation/side_scan_scene.h"

namespace insonify::validation::side_scan_receiver_test {
namespace {

TEST(SideScanCrosstalkTest, IsAShareOfTheOtherSide) {
  for (const bool speckle : {false, true}) {
    Scenario scenario = with_lines();
    scenario.receiver.speckle = speckle;
    scenario.points = {{.position = {0, 20 * std::cos(0.5), -20 * std::sin(0.5)}, .target_strength_db = -20}};
    const double alone = total_db(ping_over(scenario, Scene{}, Vec3::Zero()));
    scenario.sonars[0].crosstalk_db = -37;
    const Ping ping = ping_over(scenario, Scene{}, Vec3::Zero());
    double starboard = 0;
    for (int bin = 0; bin < ping.bin_count; ++bin) {
      starboard += double{ping.intensity[ping.index(bin, 1)]};
    }
    EXPECT_NEAR(db(starboard), alone - 37, 0.1) << speckle;
  }
}

TEST(SideScanReceiverTest, SidesHaveNoiseAndSpeckleOfTheirOwnAndOneFullScale) {
  Scenario scenario = with_lines();
  scenario.receiver.noise = scenario.receiver.speckle = true;
  scenario.receiver.field = scenario.receiver.counts = true;
  scenario.receiver.full_scale_share = 0.01;
  const Ping ping = ping_over(scenario, seabed_at(-kAltitude, diffuse(-23)), Vec3::Zero());
  ASSERT_EQ(ping.field.size(), ping.intensity.size());
  ASSERT_EQ(ping.counts.size(), ping.intensity.size());
  std::complex<double> cross = 0;
  double port = 0, starboard = 0;
  int full = 0;
  for (int bin = 90; bin < 430; ++bin) {
    const std::complex<double> p = ping.field[ping.index(bin, 0)], s = ping.field[ping.index(bin, 1)];
    const double weight = std::pow(0.1 * bin, 5);
    cross += weight * p * std::conj(s);
    port += weight * std::norm(p);
    starboard += weight * std::norm(s);
  }
  EXPECT_LT(std::abs(cross) / std::sqrt(port * starboard), 0.25);
  EXPECT_NEAR(db(port / starboard), 0, 1.5);
  for (const std::uint16_t count : ping.counts) {
    full += count == 255 ? 1 : 0;
  }
  EXPECT_NEAR(full, 0.01 * 880, 2);
}

// Thermal noise NL = -15 + 20 log10(f / 1 kHz), over 20 kHz, less DI and SL: Mellen (1952), J. Acoust. Soc. Am. 24,
// 478. The receiving beam is a line's along the track, .8858929 wavelengths over 2 sin(w / 2) long, and a top hat
// across: its solid angle is the height of the fan times wavelength / D.
TEST(SideScanNoiseTest, IsThatOfTheSonarEquationOnEachSideOfTwoSonars) {
  Scenario scenario = with_lines();
  scenario.receiver.noise = scenario.receiver.speckle = true;
  scenario.sonars[0].bandwidth = 20e3;
  scenario.sonars.push_back(scenario.sonars[0]);
  scenario.sonars[1].name = "second";
  scenario.sonars[1].frequency = 900e3;
  scenario.sonars[1].position = {0.3, 0, 0};
  scenario.mutual_interference = true;  // Their bands do not overlap.
  Simulator simulator(scenario, Scene{}, 2);
  for (const int index : {0, 1}) {
    const SonarConfig& sonar = simulator.sonar(index);
    double sums[2] = {};
    constexpr int kPings = 40;
    for (int number = 0; number < kPings; ++number) {
      PingRequest request;
      request.number = static_cast<std::uint64_t>(number);
      const Ping ping = simulator.ping(index, request);
      for (int bin = 0; bin < ping.bin_count; ++bin) {
        sums[0] += double{ping.intensity[ping.index(bin, 0)]} / (kPings * ping.bin_count);
        sums[1] += double{ping.intensity[ping.index(bin, 1)]} / (kPings * ping.bin_count);
      }
    }
    const double angle = 50 * kDegree * 2 * std::sin(0.4 * kDegree) / 0.8858929413781328;  // [sr]
    const double level = -15 + 20 * std::log10(sonar.frequency / 1e3) + db(20e3) - db(4 * kPi / angle) - 200;
    EXPECT_NEAR(db(sums[0]), level, 0.3) << index;
    EXPECT_NEAR(db(sums[1]), level, 0.3) << index;
  }
}

// Bins of 0.1 m hold eight resolutions of a chirp of 60 kHz, c / 2B = 12.5 mm. The mean of their looks is the level of
// the bed; of the greatest of n exponential looks it is the harmonic number of n.
TEST(SideScanCoarseBinsTest, HoldTheLevelOfTheBedWhateverTheyKeep) {
  Scenario scenario = with_lines();
  scenario.receiver.speckle = true;
  scenario.receiver.azimuth_pattern = BeamPattern::kTopHat;
  SonarConfig& sonar = scenario.sonars[0];
  sonar.pulse = PulseKind::kLfm;
  sonar.pulse_duration = 1e-3;
  sonar.pulse_bandwidth = 60e3;
  const Scene bed = seabed_at(-kAltitude, diffuse(-23));
  const auto top_hat = [](double below) { return std::abs(below - 33 * kDegree) <= 25 * kDegree ? 1.0 : 0.0; };
  const auto level_over = [&](Decimation decimation) {
    scenario.receiver.decimation = decimation;
    Simulator simulator(scenario, bed, 2);
    double ratio = 0, count = 0;
    for (int number = 0; number < 12; ++number) {
      PingRequest request;
      request.world_from_vehicle.position = {2.0 * number, 0, 0};
      const Ping ping = simulator.ping(0, request);
      for (int bin = 120; bin < 380; bin += 5) {
        // One look has the energy of a resolution, c / 2B, of the bin's 0.1 m.
        const double expected =
            linear(bed_level(0.1 * bin, 0.1 * (bin + 1), kAltitude, -23, sonar.azimuth_aperture, top_hat)) *
            (1489.83 / 2 / 60e3) / 0.1;
        ratio += (double{ping.intensity[ping.index(bin, 0)]} + double{ping.intensity[ping.index(bin, 1)]}) / expected;
        count += 2;
      }
    }
    return db(ratio / count);
  };
  EXPECT_NEAR(level_over(Decimation::kMean), 0, 0.3);
  EXPECT_NEAR(level_over(Decimation::kSample), 0, 0.4);  // 1248 looks: a standard deviation of 0.12 dB.
  EXPECT_NEAR(level_over(Decimation::kPeak),
              db(1 + 1 / 2.0 + 1 / 3.0 + 1 / 4.0 + 1 / 5.0 + 1 / 6.0 + 1 / 7.0 + 1 / 8.0), 0.4);
}

// The leak covers the first bins; they have no part in the share of both sides that is full.
TEST(SideScanReceiverTest, TheLeakHasNoPartInFullScale) {
  Scenario scenario = with_lines();
  scenario.receiver.noise = scenario.receiver.counts = true;
  scenario.receiver.full_scale_share = 0.05;
  scenario.sonars[0].leak_db = 30;
  scenario.sonars[0].ring_down = 5e4;
  const Ping ping = ping_over(scenario, seabed_at(-kAltitude, diffuse(-23)), Vec3::Zero());
  int covered = 0;  // The leak falls steadily to the noise; full scale is that of the bed, from 73 on.
  while (covered < 60 && ping.counts[ping.index(covered, 0)] == 255) {
    ++covered;
  }
  ASSERT_GT(covered, 10);
  int full = 0;
  for (int bin = 60; bin < ping.bin_count; ++bin) {
    full += (ping.counts[ping.index(bin, 0)] == 255 ? 1 : 0) + (ping.counts[ping.index(bin, 1)] == 255 ? 1 : 0);
  }
  EXPECT_NEAR(full, 0.05 * 2 * ping.bin_count, 0.05 * 2 * 60 + 3);
}

// Full truth of a bed to both sides and a post to port: shares of each cell add up to 1, the strongest is the label.
TEST(SideScanTruthTest, TablesOfBothSidesStayApart) {
  Scenario scenario = calibrated(side_scan(), kRays);
  scenario.ground_truth = GroundTruth::kFull;
  const Scene scene =
      scene_of_all({seabed_at(-kAltitude, diffuse(-23)),
                    scene_of(make_plane(-Vec3::UnitY(), 3, 1.7), diffuse(-23), {.position = {0, 16.2, -6.45}})});
  const Ping ping = ping_over(scenario, scene, Vec3::Zero());
  int posts = 0;
  for (int bin = 95; bin < 400; ++bin) {
    for (const int side : {0, 1}) {
      const std::size_t at = ping.index(bin, side);
      if (ping.path_order[at] == 0) {
        continue;
      }
      double sum = 0;
      for (int k = 0; k < kStrongestCount; ++k) {
        sum += double{ping.strongest_share[kStrongestCount * at + k]};
      }
      EXPECT_NEAR(sum, 1, 1e-5) << bin << ", " << side;
      EXPECT_EQ(ping.strongest_instance[kStrongestCount * at], ping.instance[at]);
      posts += ping.instance[at] == 1 ? 1 : 0;
      EXPECT_TRUE(side == 0 || ping.instance[at] == 0) << bin;
    }
  }
  EXPECT_GT(posts, 0);
}

// One noise field for both sides would be the same numbers twice.
TEST(SideScanReceiverTest, NoiseOfTheSidesDiffers) {
  Scenario scenario = with_lines();
  scenario.receiver.noise = true;
  const Ping ping = ping_over(scenario, Scene{}, Vec3::Zero());
  int equal = 0;
  for (int bin = 0; bin < ping.bin_count; ++bin) {
    equal += ping.intensity[ping.index(bin, 0)] == ping.intensity[ping.index(bin, 1)] ? 1 : 0;
  }
  EXPECT_EQ(equal, 0);
}

}  // namespace
}  // namespace insonify::validation::side_scan_receiver_test
