// thruster_test.cpp -- noise of the vehicle's thrusters: its level in every beam, its statistics along range and
// between beams, and its modulation by the blades.

#include "validation/thruster_scene.h"

namespace insonify::validation::thruster_test {
namespace {

TEST(ThrusterTest, HasTheLevelOfTheSonarEquationInEveryBeam) {
  for (const Method& method : {kRays, kReference}) {
    for (const bool speckle : {false, true}) {
      Scenario scenario = with(thruster());
      scenario.engine = method.engine;
      scenario.receiver.speckle = speckle;
      expect_levels(scenario, level_db(18e3), 18e3, 11.3 * kDegree, kPings * kBins);
      scenario.water.absorption = true;
      scenario.water.absorption_db_per_m = 2.5;  // 3.25 dB on the way.
      expect_levels(scenario, level_db(18e3, 3.25), 18e3, 11.3 * kDegree, kPings * kBins);
    }
  }
}

// A tone of 160 us, in bins of 15 mm eight times as short, has the bandwidth of 6250 Hz; a chirp of 1 ms that of 1 kHz,
// also where bins of 15 mm hold 6 of its looks: one of them and their mean have the level of one, the greatest that of
// 1 + 1/2 + ... + 1/6 = 2.45 of them.
TEST(ThrusterTest, PassesTheFilterOfThePulse) {
  Scenario scenario = with(thruster());
  scenario.receiver.pulse = PulseKind::kCw;
  scenario.receiver.pulse_duration = 160e-6;
  expect_levels(scenario, level_db(6250), 6250, 11.3 * kDegree, kPings * kBins / 10.7);
  scenario.receiver.pulse = PulseKind::kLfm;
  scenario.receiver.pulse_duration = 1e-3;
  scenario.receiver.pulse_bandwidth = 300e3;
  for (const auto& [decimation, factor] :
       {std::pair{Decimation::kSample, 1.0}, {Decimation::kMean, 1.0}, {Decimation::kPeak, 2.45}}) {
    for (const bool speckle : {false, true}) {
      scenario.receiver.decimation = decimation;
      scenario.receiver.speckle = speckle;
      expect_levels(scenario, level_db(1000), 1000, 11.3 * kDegree, kPings * kBins, factor);
    }
  }
}

// The gain is applied to the noise as to all that is received: 20 log10 of the range, and 6 dB less in half the beams.
TEST(ThrusterTest, PassesTheGainsOfTheReceiver) {
  Scenario scenario = with(thruster(), BeamPattern::kTaylor);
  const std::vector<Ping> without = pings_of(scenario, {}, 1);
  scenario.receiver.time_varied_gain = 20;
  scenario.sonars[0].group_gains_db = {0, -6};
  const std::vector<Ping> raised = pings_of(scenario, {}, 1);
  for (const int beam : {5, 17, 40}) {
    for (const int bin : {7, 900, 3999}) {
      const double range = (bin + 0.5) * 0.015;
      EXPECT_NEAR(cell_db(raised[0], bin, beam) - cell_db(without[0], bin, beam),
                  20 * std::log10(range) - (beam < 25 ? 0 : 6), 1e-3);
    }
  }
}

// Beams hear the same noise, times their gains: their fields are proportional to those of the beam that points at it.
TEST(ThrusterTest, IsCoherentBetweenBeams) {
  Scenario scenario = with(thruster());
  scenario.thrusters[0].level_db = 190;
  scenario.receiver.speckle = scenario.receiver.field = true;
  const Ping ping = pings_of(scenario, {}, 1)[0];
  const double sine = std::sin(11.3 * kDegree);
  const auto gain = [&](int beam) { return sinc(kLength * (sine - std::sin(fan().beam_azimuth(beam)))); };
  for (const int beam : {3, 15, 19, 30, 49}) {
    for (const int bin : {0, 100, 2345}) {
      const std::complex<double> one = ping.field[ping.index(bin, 17)], other = ping.field[ping.index(bin, beam)];
      EXPECT_NEAR(std::abs(other / one - gain(beam) / gain(17)), 0, 0.01) << beam << ", " << bin;
    }
  }
}

// Along range a tone's noise is correlated as 1 - 2 dr / (c tau); each part is Gaussian: the intensity's second moment
// is twice the square of its mean.
TEST(ThrusterTest, HasTheStatisticsOfFilteredNoise) {
  Scenario scenario = with(thruster());
  scenario.receiver.speckle = scenario.receiver.field = true;
  scenario.receiver.pulse = PulseKind::kCw;
  scenario.receiver.pulse_duration = 100e-6;  // 75 mm: 5 bins.
  double power = 0, square = 0;
  std::vector<double> products(8, 0.0);
  for (const Ping& ping : pings_of(scenario, {}, 20)) {
    for (int bin = 0; bin + 8 < ping.bin_count; ++bin) {
      const std::complex<double> here = ping.field[ping.index(bin, 17)];
      power += std::norm(here);
      square += std::norm(here) * std::norm(here);
      for (int lag = 0; lag < 8; ++lag) {
        products[lag] += (here * std::conj(std::complex<double>(ping.field[ping.index(bin + lag, 17)]))).real();
      }
    }
  }
  const double samples = 20 * kBins / 3.4;  // The correlation's squares sum to 3.4.
  for (int lag = 1; lag < 8; ++lag) {
    EXPECT_NEAR(products[lag] / power, std::max(0.0, 1 - lag / 5.0), 4 / std::sqrt(samples)) << lag;
  }
  EXPECT_NEAR(square * 20 * (kBins - 8) / (power * power), 2, 4 * std::sqrt(20 / samples));
}

// Twice the mean of I cos(phase) over that of I is the depth of the modulation at its phase: 2 pi f (t - r / c) plus
// that of the thruster. A filter of 1 ms averages blades of 370 a second to sinc(0.37) of the depth. The sonar takes
// the sound speed for 1450 m/s, and reckons its times of reception with that; pings follow each other by 0.117 s.
TEST(ThrusterTest, IsModulatedByTheBlades) {
  for (const bool has_pulse : {false, true}) {
    Scenario scenario = with(thruster());
    scenario.thrusters[0].blade_rate = 370;
    scenario.thrusters[0].modulation = 0.8;
    scenario.thrusters[0].blade_phase = 2.1;
    scenario.sonars[0].assumed_sound_speed = 1450;
    scenario.sonars[0].steering = Steering::kLens;
    if (has_pulse) {
      scenario.receiver.pulse = PulseKind::kLfm;
      scenario.receiver.pulse_duration = 1e-3;
      scenario.receiver.pulse_bandwidth = 50e3;
    }
    std::complex<double> sum = 0;
    double power = 0;
    for (const Ping& ping : pings_of(scenario, {}, 12)) {
      for (int bin = 0; bin < ping.bin_count; ++bin) {
        const double time = static_cast<double>(ping.number) * 0.117 + (2 * (bin + 0.5) * 0.015) / 1450 - 1.3 / 1500;
        const double intensity = ping.intensity[ping.index(bin, 17)];
        sum += intensity * std::polar(1.0, -(2 * kPi * 370 * time + 2.1));
        power += intensity;
      }
    }
    const std::complex<double> depth = 2.0 * sum / power;
    const double expected = 0.8 * (has_pulse ? sinc(0.37) : 1);
    const double tolerance = 4 * std::sqrt(2.0 / (12 * kBins));
    EXPECT_NEAR(depth.real(), expected, tolerance) << has_pulse;
    EXPECT_NEAR(depth.imag(), 0, tolerance) << has_pulse;
  }
}

// It is on the vehicle: where that is and how it moves makes no difference. Mounts of the sonars do: a second one, 2 m
// ahead, turned by 160 degrees and rolled, hears it at a place of its own.
TEST(ThrusterTest, GoesWithTheVehicle) {
  Scenario scenario = with(thruster());
  scenario.thrusters[0].blade_rate = 60;
  scenario.thrusters[0].modulation = 1;
  for (const bool moves : {false, true}) {
    scenario.motion_in_ping = moves;
    Simulator simulator(scenario, {}, 2);
    const Ping here = simulator.ping(0, {.number = 3, .time = 1.7});
    const Ping there = simulator.ping(0, {.number = 3,
                                          .time = 1.7,
                                          .world_from_vehicle = {{40, -7, 3}, orientation_from_rpy(0.3, -0.2, 2.5)},
                                          .twist = {{1.5, 0.5, 0}, {0, 0, 0.4}}});
    EXPECT_EQ(here.intensity, there.intensity);
  }
  SonarConfig other = fan();
  other.name = "other";
  other.position = {2, 0.1, -0.1};
  other.orientation = {25 * kDegree, 0, 160 * kDegree};
  scenario.motion_in_ping = false;
  scenario.thrusters[0].modulation = scenario.thrusters[0].blade_rate = 0;
  scenario.sonars.push_back(other);
  const Vec3 local = orientation_from_rpy(25 * kDegree, 0, 160 * kDegree).inverse() *
                     (scenario.thrusters[0].position - Vec3(2, 0.1, -0.1));
  ASSERT_LT(std::abs(local.z()), local.norm() * std::sin(12 * kDegree));
  const Ping ping = Simulator(scenario, {}, 2).make_ping(1, 0);
  const std::vector<double> means = means_of({ping});
  const double source = linear(level_db(18e3) + 20 * std::log10(1.3 / local.norm()));
  const double azimuth = std::atan2(local.y(), local.x());
  const int beam = static_cast<int>((37.5 - azimuth / kDegree) / 1.5);
  const double gain = std::pow(sinc(kLength * (std::sin(azimuth) - std::sin(other.beam_azimuth(beam)))), 2);
  EXPECT_NEAR(db(means[beam]), db(gain * source), 0.3);
  EXPECT_LT(db(means[0]), db(source) - 20);
}

// Only what has a clear path is heard, and only where noise is.
TEST(ThrusterTest, IsHeardOnAClearPathOnly) {
  Scenario scenario = with(thruster());
  scenario.sonars[0].min_range = 2;
  const double heard = means_of(pings_of(scenario, {}, 1))[17];
  const Scene plate = plate_at(0.6, 1, diffuse(-200));
  const double blocked = means_of(pings_of(scenario, plate, 1))[17];
  EXPECT_NEAR(db(heard), level_db(18e3), 0.5);
  EXPECT_LT(db(blocked), db(heard) - 30);
  scenario.thrusters.push_back(thruster(-20 * kDegree, 0));
  scenario.thrusters[0].position = {-1, 0, 0};  // Behind.
  EXPECT_NEAR(db(means_of(pings_of(scenario, {}, 1))[38]), level_db(18e3), 0.7);
  EXPECT_LT(db(means_of(pings_of(scenario, {}, 1))[10]), level_db(18e3) - 20);
  scenario.receiver.noise = false;
  EXPECT_EQ(means_of(pings_of(scenario, {}, 1))[38], 0);
}

// The noise of two is independent: their powers add, 3.01 dB above one.
TEST(ThrusterTest, PowersOfTwoAdd) {
  Scenario scenario = with(thruster());
  scenario.thrusters.push_back(thruster());
  expect_levels(scenario, level_db(18e3) + 3.0103, 18e3, 11.3 * kDegree, kPings * kBins);
}

}  // namespace
}  // namespace insonify::validation::thruster_test
