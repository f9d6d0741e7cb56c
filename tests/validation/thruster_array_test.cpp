// thruster_array_test.cpp -- noise of thrusters through faults, patterns and focus of the array, and by heads.

#include "validation/thruster_scene.h"

namespace insonify::validation::thruster_array_test {
namespace {

// 70 elements, of which five are dead: side lobes are theirs. An element of 50 degrees is a line of 0.88589 / (2 sin 25
// deg) = 1.04809 wavelengths. What the transmitter sends makes no difference.
TEST(ThrusterArrayTest, IsHeardThroughTheFaultsOfTheArray) {
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
TEST(ThrusterArrayTest, HasItsBearingOnACone) {
  Scenario scenario = with(thruster(35 * kDegree, -25 * kDegree));
  scenario.sonars[0].elevation_aperture = 60 * kDegree;
  scenario.receiver.beam_shape = BeamShape::kCone;
  expect_levels(scenario, level_db(18e3), 18e3, std::asin(std::sin(35 * kDegree) * std::cos(25 * kDegree)),
                kPings * kBins);
}

// One way across elevations, 15 degrees above the axis of a line of 0.88589 / (2 sin 12 deg) = 2.1305 wavelengths that
// looks 3 degrees up: sinc^2(2.1305 sin 12 deg) is half.
TEST(ThrusterArrayTest, PassesThePatternAcrossElevationsOnce) {
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
TEST(ThrusterArrayTest, HeadsHearItWhereTheyLook) {
  Scenario scenario = with(thruster(40 * kDegree, 0));
  SonarConfig& head = scenario.sonars[0];
  head.type = SonarType::kMechanicallyScanned;
  head.beam_count = 1;
  head.azimuth_aperture = 1.5 * kDegree;
  head.head.sector_width = 2 * kPi;
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

// An array of 33.84 wavelengths that is focused at 6 m receives a thruster at 1.3 m out of focus: with the phase
// pi D^2 cos^2(a) / (4 lambda) (1/r - 1/f) at its edges, lambda = 1500 / 430e3.
TEST(ThrusterArrayTest, IsOutOfFocusWhereTheArrayIsFocusedElsewhere) {
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
TEST(ThrusterArrayTest, IsSeenFromWhereTheElementsAre) {
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

}  // namespace
}  // namespace insonify::validation::thruster_array_test
