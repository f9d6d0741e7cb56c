// transmit_leak_test.cpp -- the transmitter's own pulse in the receiver: its envelope, what it interferes with, and the
// range in which the receiver is deaf.

#include "validation/calibrated_scene.h"

namespace insonify::validation::transmit_leak_test {
namespace {

constexpr double kSpeed = 1500;
constexpr Method kMethods[] = {kRays, kReference};

double decibels(double ratio) {
  return 10 * std::log10(ratio);
}

// A fan of 12 beams with bins of `bin` metres from the transducer on, and a leak of -23 dB that decays by 400 dB/ms:
// 400e3 x 2 / 1500 = 533.33 dB per metre of range.
Scenario leaking(double bin, const Method& method = kRays) {
  SonarConfig sonar;
  sonar.beam_count = 12;
  sonar.azimuth_aperture = 12 * kDegree;
  sonar.min_range = 0;
  sonar.bin_count = 120;
  sonar.max_range = 120 * bin;
  sonar.sampling = {1, 20};
  sonar.leak_db = -23;
  sonar.ring_down = 400e3;
  Scenario scenario = calibrated(sonar, method);
  scenario.water.sound_speed = kSpeed;
  scenario.receiver.pulse = PulseKind::kCw;
  scenario.receiver.pulse_duration = 100e-6;  // 0.075 m.
  return scenario;
}

// Level of the leak at a range: full while the pulse is sent, then a straight line in decibels.
double leak_db(double range, double pulse = 0.075, double slope = 533.3333333) {
  return -23 - slope * std::max(0.0, range - pulse);
}

TEST(TransmitLeakTest, IsFullForThePulseAndThenDecaysByTheRingDown) {
  for (const Method& method : kMethods) {
    for (const bool speckle : {false, true}) {
      for (const BeamPattern pattern : {BeamPattern::kTopHat, BeamPattern::kTaylor}) {
        Scenario scenario = leaking(0.004, method);
        scenario.receiver.speckle = speckle;
        scenario.receiver.azimuth_pattern = pattern;
        const Ping ping = ping_of(scenario, {});
        for (const int bin : {0, 9, 18, 19, 30, 60}) {
          EXPECT_NEAR(cell_db(ping, bin, 3), leak_db((bin + 0.5) * 0.004), 0.001) << bin;
        }
      }
    }
  }
}

// The leak ends by the clock: a sonar that takes 1540 m/s for the true speed shows it at 1540 t / 2.
TEST(TransmitLeakTest, IsShownByTheAssumedSoundSpeed) {
  Scenario scenario = leaking(0.004);
  scenario.water.sound_speed = 1450;
  scenario.sonars[0].assumed_sound_speed = 1540;
  const Ping ping = ping_of(scenario, {});
  for (const int bin : {5, 18, 25, 50}) {
    EXPECT_NEAR(cell_db(ping, bin, 3), leak_db((bin + 0.5) * 0.004, 0.077, 519.4805195), 0.001) << bin;
  }
}

// Without a pulse it is as long as a bin; each bin holds the mean of its length.
TEST(TransmitLeakTest, WithoutAPulseIsAsLongAsABin) {
  Scenario scenario = leaking(0.03);
  scenario.receiver.pulse = PulseKind::kNone;
  const Ping ping = ping_of(scenario, {});
  EXPECT_NEAR(cell_db(ping, 0, 5), -23, 0.001);
  // 16 dB a bin: the mean over one of 10^(-1.6 x) from 0 to 1 is (1 - 10^-1.6) / (1.6 ln 10) = .264617, -5.7738 dB.
  for (const int bin : {1, 2, 7}) {
    EXPECT_NEAR(cell_db(ping, bin, 5), -23 - 16 * (bin - 1) - 5.7738, 0.001) << bin;
  }
}

// Bins longer than the pulse keep the leak at their near edge, its mean, or that at their middle. The mean by a sum.
TEST(TransmitLeakTest, IsDecimatedAsEchoesAre) {
  constexpr double kBin = 0.05, kPulse = 0.0225;
  for (const Decimation decimation : {Decimation::kPeak, Decimation::kMean, Decimation::kSample}) {
    Scenario scenario = leaking(kBin);
    scenario.receiver.pulse_duration = 30e-6;
    scenario.receiver.decimation = decimation;
    const Ping ping = ping_of(scenario, {});
    for (const int bin : {0, 1, 3}) {
      double sum = 0;
      for (int i = 0; i < 20000; ++i) {
        sum += std::pow(10, leak_db((bin + (i + 0.5) / 20000) * kBin, kPulse) / 10) / 20000;
      }
      const double expected = decimation == Decimation::kMean
                                  ? decibels(sum)
                                  : leak_db((bin + (decimation == Decimation::kPeak ? 0 : 0.5)) * kBin, kPulse);
      EXPECT_NEAR(cell_db(ping, bin, 3), expected, 0.001) << static_cast<int>(decimation) << ", " << bin;
    }
  }
}

// With noise and speckle too: 60 dB above both, it fluctuates by less than 0.05 dB.
TEST(TransmitLeakTest, IsNotDrawnAnewAsLooksAre) {
  for (const Decimation decimation : {Decimation::kPeak, Decimation::kMean}) {
    Scenario scenario = leaking(0.05);
    scenario.receiver.pulse_duration = 30e-6;
    scenario.receiver.decimation = decimation;
    scenario.receiver.noise = scenario.receiver.speckle = true;
    scenario.sonars[0].ring_down = 1e3;  // 1.33 dB/m: 0.067 dB a bin.
    const Ping ping = ping_of(scenario, seabed_at(-2.5, diffuse(-27)));
    for (const int bin : {0, 20, 70, 110}) {
      const double mean = leak_db((bin + 0.25) * 0.05, 0.0225, 4.0 / 3);
      EXPECT_NEAR(cell_db(ping, bin, 3), mean, 0.1) << static_cast<int>(decimation) << ", " << bin;
    }
  }
}

// A steady field L in complex Gaussian noise N (Rice): the mean intensity is L + N, its variance N^2 + 2 L N. The
// sonar's noise: -15 + 20 lg 720 + 10 lg 25e3 - 10 lg(4 pi / (1 deg x 2 sin 10 deg)) - 200 = -147.0403 dB.
TEST(TransmitLeakTest, InterferesWithNoise) {
  for (const double over_noise : {1.0, 100.0}) {
    for (const bool speckle : {false, true}) {
      Scenario scenario = leaking(0.0005);
      scenario.sonars[0].ring_down = 1e3;  // 0.08 dB over all of it.
      scenario.sonars[0].leak_db = -147.0403 + decibels(over_noise);
      scenario.receiver.pulse = PulseKind::kNone;
      scenario.receiver.noise = true;
      scenario.receiver.speckle = speckle;
      Simulator simulator(scenario, {}, 2);
      double sum = 0, square = 0, count = 0;
      for (int number = 0; number < 12; ++number) {
        for (const double value : simulator.make_ping(0, number).intensity) {
          const double scaled = value * std::pow(10, 14.70403);
          sum += scaled, square += scaled * scaled, ++count;
        }
      }
      const double mean = over_noise + 1, variance = 2 * over_noise + 1;
      const double sampling = 4 * std::sqrt(variance / count);
      EXPECT_NEAR(sum / count, mean, sampling + 0.01 * over_noise) << over_noise;  // Half of the decay.
      const double contrast = std::sqrt(square / count - std::pow(sum / count, 2)) / (sum / count);
      // .8660 and .1404; the standard error of a contrast is below 1 / sqrt(count).
      EXPECT_NEAR(contrast, std::sqrt(variance) / mean, 4 / std::sqrt(count)) << over_noise;
    }
  }
}

TEST(TransmitLeakTest, IsSaturatedThenAmplifiedThenCounted) {
  Scenario scenario = leaking(0.004);
  scenario.receiver.saturation_db = -40;
  scenario.receiver.gain_ranges = {0};
  scenario.receiver.gains_db = {7};
  scenario.receiver.counts = true;
  scenario.receiver.full_scale_db = -33;
  const Ping ping = ping_of(scenario, {});
  // It falls to -40 dB at 0.075 + 17 / 533.33 = 0.106875 m: bin 26 begins at 0.104 m.
  for (const int bin : {0, 18, 25}) {
    EXPECT_NEAR(cell_db(ping, bin, 3), -33, 0.001);
    EXPECT_EQ(ping.counts[ping.index(bin, 3)], 255);
  }
  EXPECT_NEAR(cell_db(ping, 40, 3), leak_db(40.5 * 0.004) + 7, 0.001);
  // 22.8 dB below full scale of 60 dB: 255 (1 - 45.6 / 60)
  EXPECT_NEAR(ping.counts[ping.index(40, 3)], 255 * (1 + (leak_db(40.5 * 0.004) + 40) / 60), 0.51);
}

// The saturation of the front end acts on the sum of echo and leak: each below it by 1 dB, together 5 dB above.
TEST(TransmitLeakTest, SaturatesTogetherWithEchoesAndNoise) {
  Scenario scenario = leaking(0.05);
  scenario.receiver.pulse_duration = 8e-3;  // 6 m: as far as all bins.
  scenario.sonars[0].leak_db = -40 * std::log10(3.025);
  scenario.points = {{.position = {3.025, -0.001, 0}}};
  const double sum = *scenario.sonars[0].leak_db + decibels(2);  // Without speckle energies add.
  const int bin = 60;
  EXPECT_NEAR(cell_db(ping_of(scenario, {}), bin, 6), sum, 0.01);
  scenario.receiver.saturation_db = sum - 2;
  EXPECT_NEAR(cell_db(ping_of(scenario, {}), bin, 6), sum - 2, 0.001);
  EXPECT_NEAR(cell_db(ping_of(scenario, {}), bin, 0), *scenario.sonars[0].leak_db, 0.01);
  scenario.receiver.saturation_db = sum + 2;
  EXPECT_NEAR(cell_db(ping_of(scenario, {}), bin, 6), sum, 0.01);
}

// Within dead_range nothing but the leak is received; beyond, everything as without it, byte for byte.
TEST(TransmitLeakTest, DeafReceiverHearsOnlyTheLeak) {
  for (const Method& method : kMethods) {
    for (const bool speckle : {false, true}) {
      for (const GroundTruth truth : {GroundTruth::kLabels, GroundTruth::kFull}) {
        Scenario scenario = leaking(0.02, method);
        scenario.receiver.noise = true;
        scenario.receiver.speckle = speckle;
        scenario.receiver.azimuth_pattern = BeamPattern::kTaylor;
        scenario.ground_truth = truth;
        scenario.water.volume_backscatter_db = -60;
        const Scene scene = scene_of_all({plate_at(0.95, 1, diffuse(-20)), plate_at(1.95, 3, diffuse(-20))});
        scenario.sonars[0].leak_db = {};
        const Ping open = ping_of(scenario, scene);
        scenario.sonars[0].leak_db = -23;
        scenario.sonars[0].dead_range = 1.2;  // 60 bins; the leak is below -300 dB there.
        const Ping deaf = ping_of(scenario, scene);
        const std::size_t dead = 60 * 12;
        for (std::size_t at = 0; at < dead; ++at) {
          const double range = (at / 12 + 0.5) * 0.02;
          const double expected = std::pow(10, leak_db(range) / 10);
          EXPECT_NEAR(deaf.intensity[at], expected < 1.01e-30 ? 0 : expected, 1e-4 * expected) << at;
          EXPECT_EQ(deaf.instance[at], kNoLabel);
          EXPECT_EQ(deaf.material[at], kNoLabel);
          EXPECT_TRUE(std::isnan(deaf.elevation[at]));
        }
        EXPECT_TRUE(std::equal(open.intensity.begin() + dead, open.intensity.end(), deaf.intensity.begin() + dead));
        EXPECT_TRUE(std::equal(open.instance.begin() + dead, open.instance.end(), deaf.instance.begin() + dead));
        EXPECT_NE(open.instance[47 * 12 + 5], kNoLabel);
        if (truth == GroundTruth::kFull) {
          EXPECT_EQ(*std::max_element(deaf.direct_intensity.begin(), deaf.direct_intensity.begin() + dead), 0);
          EXPECT_EQ(*std::max_element(deaf.path_order.begin(), deaf.path_order.begin() + dead), 0);
          EXPECT_EQ(*std::max_element(deaf.strongest_share.begin(), deaf.strongest_share.begin() + 3 * dead), 0);
          EXPECT_EQ(*std::min_element(deaf.strongest_instance.begin(), deaf.strongest_instance.begin() + 3 * dead),
                    kNoLabel);
          EXPECT_TRUE(std::equal(open.direct_intensity.begin() + dead, open.direct_intensity.end(),
                                 deaf.direct_intensity.begin() + dead));
        }
      }
    }
  }
}

// Levels of 600 beams differ by a normal deviate of 2 dB: its standard error is 2 / sqrt(1200). They do so by seed, and
// equally in every ping.
TEST(TransmitLeakTest, DiffersBetweenBeamsAndNotBetweenPings) {
  Scenario scenario = leaking(0.004);
  scenario.sonars[0].beam_count = 600;
  scenario.sonars[0].bin_count = 10;
  scenario.sonars[0].max_range = 0.04;
  scenario.sonars[0].leak_spread_db = 2;
  Simulator simulator(scenario, {}, 2);
  const Ping first = simulator.make_ping(0, 0), later = simulator.make_ping(0, 7);
  EXPECT_EQ(first.intensity, later.intensity);
  double sum = 0, square = 0;
  for (int beam = 0; beam < 600; ++beam) {
    const double level = cell_db(first, 4, beam) + 23;
    sum += level, square += level * level;
    EXPECT_NEAR(cell_db(first, 9, beam), cell_db(first, 0, beam), 1e-4);
  }
  EXPECT_NEAR(sum / 600, 0, 4 * 2 / std::sqrt(600));
  EXPECT_NEAR(std::sqrt(square / 600), 2, 4 * 2 / std::sqrt(1200));
  scenario.seed = 99;
  EXPECT_NE(ping_of(scenario, {}).intensity, first.intensity);
  scenario.sonars[0].leak_spread_db = 0;
  const Ping level = ping_of(scenario, {});
  EXPECT_NEAR(*std::ranges::min_element(level.intensity), *std::ranges::max_element(level.intensity), 1e-8);
}

// In the scan of a head each direction is a beam: its leak is the same in each turn, and differs from that of others by
// the spread. Over 360 directions a beam apart the standard error of the deviation is 2 / sqrt(720).
TEST(TransmitLeakTest, DiffersBetweenTheDirectionsOfAHead) {
  Scenario scenario = leaking(0.004);
  scenario.sonars[0].type = SonarType::kMechanicallyScanned;
  scenario.sonars[0].beam_count = 1;
  scenario.sonars[0].azimuth_aperture = 1 * kDegree;
  scenario.sonars[0].leak_spread_db = 2;
  Simulator simulator(scenario, {}, 1);
  const auto level = [&](double direction) {
    PingRequest request;
    request.head_angle = direction * kDegree;
    return cell_db(simulator.ping(0, request), 4, 0) + 23;
  };
  double sum = 0, square = 0, next = 0;
  for (int direction = 0; direction < 360; ++direction) {
    const double here = level(direction + 0.2);
    sum += here, square += here * here, next += here * level(direction + 1.2);
    EXPECT_NEAR(level(direction + 360.2), here, 1e-3);
    EXPECT_NEAR(level(direction + 0.2 - 720), here, 1e-3);
    EXPECT_NEAR(level(direction + 0.201), here, 0.1);
  }
  EXPECT_NEAR(sum / 360, 0, 4 * 2 / std::sqrt(360));
  EXPECT_NEAR(std::sqrt(square / 360), 2, 4 * 2 / std::sqrt(720));
  EXPECT_NEAR(next / square, 0, 4 / std::sqrt(360));
}

// Automatic gain is that of what lies beyond the leak: with it the counts there are those without it.
TEST(TransmitLeakTest, AutomaticGainDoesNotCountIt) {
  for (const double dead_range : {0.0, 1.0}) {
    Scenario scenario = leaking(0.02);
    scenario.receiver.noise = scenario.receiver.speckle = scenario.receiver.counts = true;
    scenario.receiver.full_scale_share = 0.01;
    const Scene scene = plate_at(1.95, 3, diffuse(-20));
    scenario.sonars[0].leak_db = 10;
    scenario.sonars[0].dead_range = dead_range;
    const Ping with = ping_of(scenario, scene);
    // 10 dB less 533.33 dB/m beyond 0.075 m are below the noise, at -140 to -150 dB, from 0.37 m on: bin 18 or 19.
    const std::size_t first = dead_range > 0 ? 50 * 12 : 19 * 12, count = with.counts.size() - first;
    const auto full = std::ranges::count(std::span(with.counts).subspan(first), 255);
    EXPECT_NEAR(static_cast<double>(full), 0.01 * static_cast<double>(count), 3);
    EXPECT_EQ(with.counts[0], dead_range > 0 || first > 0 ? 255 : 0);
    scenario.sonars[0].leak_db = {};
    scenario.sonars[0].dead_range = (static_cast<double>(first) / 12) * 0.02;
    const Ping without = ping_of(scenario, scene);
    EXPECT_TRUE(std::equal(with.counts.begin() + static_cast<std::ptrdiff_t>(first), with.counts.end(),
                           without.counts.begin() + static_cast<std::ptrdiff_t>(first)));
  }
}

// A leak that covers all bins is all there is to set the scale by.
TEST(TransmitLeakTest, AutomaticGainCountsALeakThatNeverEnds) {
  Scenario scenario = leaking(0.004);
  scenario.sonars[0].ring_down = 1e3;
  scenario.receiver.counts = true;
  scenario.receiver.full_scale_share = 0.01;
  const Ping ping = ping_of(scenario, {});
  EXPECT_EQ(ping.counts.front(), 255);
  EXPECT_GT(ping.counts.back(), 240);
}

// A head that turns on a vehicle that moves, beside another sonar: its leak stays as it is, and is its own.
TEST(TransmitLeakTest, BelongsToItsSonarWhereverThatMoves) {
  Scenario scenario = leaking(0.004);
  scenario.motion_in_ping = true;
  SonarConfig head = scenario.sonars[0];
  head.name = "head";
  head.type = SonarType::kMechanicallyScanned;
  head.beam_count = 1;
  head.leak_db = -35;
  scenario.sonars[0].leak_db = {};
  scenario.sonars.push_back(head);
  scenario.receiver.azimuth_pattern = BeamPattern::kTaylor;
  Simulator simulator(scenario, seabed_at(-3, diffuse(-27)), 2);
  PingRequest request;
  request.twist.linear = {2, 1, 0};
  for (int number = 0; number < 4; ++number) {
    request.number = number;
    request.world_from_vehicle.position = {number * 0.5, 0, 0};
    EXPECT_NEAR(cell_db(simulator.ping(1, request), 10, 0), -35, 0.001) << number;
    EXPECT_EQ(simulator.ping(0, request).intensity[10], 0) << number;
  }
}

}  // namespace
}  // namespace insonify::validation::transmit_leak_test
