// thruster_test.cpp -- noise of the vehicle's thrusters: its level in every beam, its statistics along range and
// between beams, and its modulation by the blades.

#include <complex>
#include <functional>

#include "insonify/acoustics/sonar_equation.h"
#include "validation/calibrated_scene.h"

namespace insonify::validation {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kPings = 4, kBins = 4000;

double db(double value) {
  return 10 * std::log10(value);
}

double linear(double level_db) {
  return std::pow(10, level_db / 10);
}

double sinc(double x) {
  return std::abs(x) < 1e-9 ? 1 : std::sin(kPi * x) / (kPi * x);
}

// 50 beams of 1.5 x 24 degrees over 75 degrees at 430 kHz: a line of 0.88589 / (2 sin 0.75 deg) = 33.84 wavelengths.
constexpr double kLength = 33.83957;
SonarConfig fan() {
  SonarConfig sonar;
  sonar.name = "fan";
  sonar.frequency = 430e3;
  sonar.source_level_db = 207;
  sonar.bandwidth = 18e3;
  sonar.beam_count = 50;
  sonar.azimuth_aperture = 75 * kDegree;
  sonar.elevation_aperture = 24 * kDegree;
  sonar.min_range = 0;
  sonar.max_range = 60;
  sonar.bin_count = kBins;
  sonar.ping_period = 0.117;
  sonar.sampling = {1, 20};
  return sonar;
}

// 1.3 m away at an azimuth of 11.3 and an elevation of -4 degrees, 62 dB above what thermal noise is per hertz.
Thruster thruster(double azimuth = 11.3 * kDegree, double elevation = -4 * kDegree, double range = 1.3) {
  return {
      .position = point_from_spherical({range, azimuth, elevation}), .level_db = 131, .frequency = 20e3, .slope = -17};
}

Scenario with(const Thruster& source, BeamPattern pattern = BeamPattern::kRectangular) {
  Scenario scenario = calibrated(fan(), kRays);
  scenario.water.sound_speed = 1500;
  scenario.receiver.noise = true;
  scenario.receiver.azimuth_pattern = pattern;
  scenario.thrusters = {source};
  return scenario;
}

// By hand, with a bandwidth [Hz] and a gain of 1: 131 - 17 log10(430 / 20) - 20 log10(1.3) - 207 = -100.9270 dB,
// and what the water takes on the way.
double level_db(double bandwidth, double absorbed_db = 0) {
  return -100.9270 + db(bandwidth) - absorbed_db;
}

std::vector<Ping> pings_of(const Scenario& scenario, const Scene& scene = {}, int count = kPings) {
  Simulator simulator(scenario, scene, 2);
  std::vector<Ping> pings;
  pings.reserve(static_cast<std::size_t>(count));
  for (int number = 0; number < count; ++number) {
    pings.push_back(simulator.make_ping(0, number));
  }
  return pings;
}

// Means over bins and pings.
std::vector<double> means_of(const std::vector<Ping>& pings) {
  std::vector<double> means(pings[0].beam_count, 0.0);
  for (const Ping& ping : pings) {
    for (int bin = 0; bin < ping.bin_count; ++bin) {
      for (int beam = 0; beam < ping.beam_count; ++beam) {
        means[beam] += ping.intensity[ping.index(bin, beam)] / ping.bin_count / static_cast<double>(pings.size());
      }
    }
  }
  return means;
}

// Means of all beams, with their gains towards the thruster, and the thermal noise beside it.
// @param gain  Of a beam whose middle has the sine, |g|^2.
void expect_gains(const Scenario& scenario, double source_db, double bandwidth,
                  const std::function<double(double)>& gain, double samples, double factor = 1,
                  double amplitude_error = 0) {
  const std::vector<double> means = means_of(pings_of(scenario));
  const double solid_angle = 2 * std::sin(0.5 * scenario.sonars[0].elevation_aperture) / kLength;
  const double thermal = linear(thermal_noise_level_db(430e3) + db(bandwidth) - db(4 * kPi / solid_angle) - 207);
  for (int beam = 0; beam < 50; ++beam) {
    const double heard = gain(std::sin(fan().beam_azimuth(beam))) * linear(source_db);
    const double slack = 8.686 * amplitude_error * std::sqrt(linear(source_db) / heard);
    EXPECT_NEAR(db(means[beam]), db(factor * (thermal + heard)), 4 * 4.343 / std::sqrt(samples) + slack) << beam;
  }
}

// The same for a line without a window that receives from an azimuth.
void expect_levels(const Scenario& scenario, double source_db, double bandwidth, double azimuth, double samples,
                   double factor = 1) {
  expect_gains(
      scenario, source_db, bandwidth,
      [&](double sine) { return std::pow(sinc(kLength * (std::sin(azimuth) - sine)), 2); }, samples, factor);
}

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

// 70 elements, of which five are dead: side lobes are theirs. An element of 50 degrees is a line of 0.88589 / (2 sin 25
// deg) = 1.04809 wavelengths. What the transmitter sends makes no difference.
TEST(ThrusterTest, IsHeardThroughTheFaultsOfTheArray) {
  constexpr int kElements = 70;
  Scenario scenario = with(thruster(-18.3 * kDegree, 0));
  scenario.receiver.elements = kElements;
  scenario.receiver.dead_elements = {3, 4, 30, 41, 66};
  scenario.sonars[0].element_width = 50 * kDegree;
  scenario.sonars[0].transmit_width = 40 * kDegree;
  const double source = std::sin(-18.3 * kDegree);
  const auto gain = [&](double sine) {
    std::complex<double> sum = 0;
    for (int i = 0; i < kElements; ++i) {
      const bool is_dead = i == 3 || i == 4 || i == 30 || i == 41 || i == 66;
      const double place = 0.5 - (i + 0.5) / kElements;  // From starboard to port.
      sum += is_dead ? 0 : std::polar(1.0 / kElements, 2 * kPi * kLength * (source - sine) * place);
    }
    return std::norm(sum) * std::pow(sinc(1.04809 * source), 2);
  };
  // The length of so many elements differs by 1e-4 from that of a line, which moves nulls.
  expect_gains(scenario, level_db(18e3), 18e3, gain, kPings * kBins, 1, 4e-4);
}

// On cones around the array the bearing's sine is that of the azimuth times the cosine of the elevation: of 35 degrees
// at an elevation of -25, that of 31.3.
TEST(ThrusterTest, HasItsBearingOnACone) {
  Scenario scenario = with(thruster(35 * kDegree, -25 * kDegree));
  scenario.sonars[0].elevation_aperture = 60 * kDegree;
  scenario.receiver.beam_shape = BeamShape::kCone;
  expect_levels(scenario, level_db(18e3), 18e3, std::asin(std::sin(35 * kDegree) * std::cos(25 * kDegree)),
                kPings * kBins);
}

// One way across elevations, 15 degrees above the axis of a line of 0.88589 / (2 sin 12 deg) = 2.1305 wavelengths that
// looks 3 degrees up: sinc^2(2.1305 sin 12 deg) is half.
TEST(ThrusterTest, PassesThePatternAcrossElevationsOnce) {
  for (const double elevation : {15.0, -4.0, -41.0}) {
    Scenario scenario = with(thruster(0.75 * kDegree, elevation * kDegree), BeamPattern::kTopHat);
    scenario.sonars[0].elevation_center = 3 * kDegree;
    const double thermal = linear(thermal_noise_level_db(430e3) + db(18e3) - 207 - db(4 * kPi));
    const std::vector<double> top_hat = means_of(pings_of(scenario));
    const double whole = 1.5 * kDegree * (std::sin(15 * kDegree) + std::sin(9 * kDegree));
    const double inside = elevation > -9 && elevation < 15 + 1e-9 ? linear(level_db(18e3)) : 0;
    if (elevation != 15.0) {  // On the edge rounding decides.
      EXPECT_NEAR(db(top_hat[24]), db(thermal * whole + inside), 4 * 4.343 / std::sqrt(kPings * kBins)) << elevation;
    }
    scenario.receiver.elevation_pattern = BeamPattern::kRectangular;
    const double gain = std::pow(sinc(2.13046 * std::sin((elevation - 3) * kDegree)), 2);
    const std::vector<double> line = means_of(pings_of(scenario));
    scenario.thrusters.clear();
    const double without = means_of(pings_of(scenario))[24];
    EXPECT_NEAR(db(line[24]), db(without + gain * linear(level_db(18e3))), 6 * 4.343 / std::sqrt(kPings * kBins))
        << elevation;
    EXPECT_NEAR(db(line[26]), db(without), 6 * 4.343 / std::sqrt(kPings * kBins)) << elevation;  // Top-hat beams.
  }
}

// A head turns past it and receives it one way, though its beam is formed twice: 3.01 dB down, half a beam width
// beside; through its side lobes; and from behind not at all.
TEST(ThrusterTest, HeadsHearItWhereTheyLook) {
  Scenario scenario = with(thruster(40 * kDegree, 0));
  SonarConfig& head = scenario.sonars[0];
  head.type = SonarType::kMechanicallyScanned;
  head.beam_count = 1;
  head.azimuth_aperture = 1.5 * kDegree;
  head.sector_width = 2 * kPi;
  scenario.thrusters[0].level_db = 170;
  Simulator simulator(scenario, {}, 2);
  for (const double off : {0.0, 0.75, 2.3, -7.7, 55.0, 100.0, 179.0}) {
    const Ping ping = simulator.ping(0, {.number = 5, .head_angle = (40 + off) * kDegree});
    const double gain = off < 90 ? std::pow(sinc(kLength * std::sin(off * kDegree)), 2) : 0;
    const double thermal =
        linear(thermal_noise_level_db(430e3) + db(18e3) - 207 - db(4 * kPi * kLength / (2 * std::sin(12 * kDegree))));
    const double source = linear(level_db(18e3) + 39);
    EXPECT_NEAR(db(means_of({ping})[0]), db(thermal + gain * source), 4 * 4.343 / std::sqrt(kBins)) << off;
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

// An array of 33.84 wavelengths that is focused at 6 m receives a thruster at 1.3 m out of focus: with the phase
// pi D^2 cos^2(a) / (4 lambda) (1/r - 1/f) at its edges, lambda = 1500 / 430e3.
TEST(ThrusterTest, IsOutOfFocusWhereTheArrayIsFocusedElsewhere) {
  Scenario scenario = with(thruster(0.75 * kDegree, 0));
  scenario.sonars[0].focus_range = 6;
  const std::vector<double> means = means_of(pings_of(scenario));
  const double wavelength = 1500 / 430e3;
  const double phase = kPi * kLength * kLength * wavelength / 4 * (1 / 1.3 - 1 / 6.0);
  for (const int beam : {24, 25, 23, 20, 27}) {
    const double sine = std::sin(fan().beam_azimuth(beam)), x = kLength * (std::sin(0.75 * kDegree) - sine);
    std::complex<double> sum = 0;
    for (int i = 0; i < 2000; ++i) {
      const double s = (i + 0.5) / 2000 - 0.5;
      sum += std::polar(1.0 / 2000, 2 * kPi * x * s + phase * (1 - sine * sine) * 4 * s * s);
    }
    EXPECT_NEAR(db(means[beam]), level_db(18e3) + db(std::norm(sum)), 0.15 + 4 * 4.343 / std::sqrt(kPings * kBins))
        << beam;
  }
}

// Without the 25 elements of 70 at its port end the array is centred to starboard, and sees what is near too far to
// port: sums over the others at their distances.
TEST(ThrusterTest, IsSeenFromWhereTheElementsAre) {
  constexpr int kElements = 70, kDead = 25, kBeam = 24;
  Scenario scenario = with(thruster(0.75 * kDegree, 0));
  scenario.sonars[0].focus_range = 6;
  scenario.receiver.elements = kElements;
  for (int i = 0; i < kDead; ++i) {
    scenario.receiver.dead_elements.push_back(i);
  }
  const std::vector<double> means = means_of(pings_of(scenario));
  const double wavelength = 1500 / 430e3;
  const Vec3 place = thruster(0.75 * kDegree, 0).position;
  for (const int beam : {kBeam - 2, kBeam - 1, kBeam, kBeam + 1, kBeam + 2}) {
    const Vec3 focus = point_from_spherical({6, fan().beam_azimuth(beam), 0});
    std::complex<double> sum = 0;
    for (int i = kDead; i < kElements; ++i) {
      const Vec3 element(0, kLength * wavelength * (0.5 - (i + 0.5) / kElements), 0);
      const double there = (place - element).norm() - place.norm(), delay = (focus - element).norm() - focus.norm();
      sum += std::polar(1.0 / kElements, 2 * kPi / wavelength * (delay - there));
    }
    const double wanted = db(std::norm(sum));
    EXPECT_NEAR(db(means[beam]), level_db(18e3) + wanted, 0.3 - 0.03 * wanted) << beam;
  }
}

// The noise of two is independent: their powers add, 3.01 dB above one.
TEST(ThrusterTest, PowersOfTwoAdd) {
  Scenario scenario = with(thruster());
  scenario.thrusters.push_back(thruster());
  expect_levels(scenario, level_db(18e3) + 3.0103, 18e3, 11.3 * kDegree, kPings * kBins);
}

}  // namespace
}  // namespace insonify::validation
