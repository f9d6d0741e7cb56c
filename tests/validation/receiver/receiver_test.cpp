// receiver_test.cpp -- array pattern and pulse in whole pings (T14, T18 of docs/concepts/physics-tests.md).

#include "validation/calibrated_scene.h"

namespace insonify::validation::receiver_test {
namespace {

constexpr double kPi = 3.14159265358979323846;

SonarConfig fan() {
  SonarConfig sonar;
  sonar.azimuth_resolution = 1 * kDegree;
  sonar.min_range = 0;
  sonar.max_range = 25;
  return sonar;
}

double decibels(double ratio) {
  return 10 * std::log10(ratio);
}

// T14. A point appears in every beam at its range, with the array's pattern in the sine of the bearing.
TEST(ArrayPingTest, PointShowsTheBeamPatternAcrossTheBeams) {
  const SonarConfig sonar = fan();
  for (const double azimuth : {-50.1 * kDegree, -12.34 * kDegree, 0.0, 20 * kDegree, 47.7 * kDegree}) {
    Scenario scenario = calibrated(sonar, kRays);
    scenario.receiver.azimuth_pattern = BeamPattern::kRectangular;
    scenario.points = {{.position = 15.02 * Vec3(std::cos(azimuth), std::sin(azimuth), 0)}};
    const Ping ping = ping_of(scenario, {});
    const int bin = static_cast<int>(15.02 / sonar.bin_length());
    const double length = 0.8858929413781328 / (2 * std::sin(0.5 * kDegree));  // D / wavelength
    const double level = -40 * std::log10(15.02);
    for (int other = 0; other < sonar.beam_count; ++other) {
      const double x = kPi * length * (std::sin(azimuth) - std::sin(sonar.beam_azimuth(other)));
      const double expected = decibels(std::pow(std::sin(x) / x, 2));
      if (expected > -35) {
        EXPECT_NEAR(cell_db(ping, bin, other) - level, expected, 0.01) << azimuth << ", " << other;
      }
    }
  }
}

// With every window, in azimuth and in elevation, a point has its own level in the beam that points at it.
TEST(ArrayPingTest, EveryWindowPreservesTheLevelOfAPoint) {
  const double azimuth = fan().beam_azimuth(100) - 0.25 * 120 * kDegree / 256;  // The middle of half a beam.
  for (int window = 1; window <= static_cast<int>(BeamPattern::kDolphChebyshev); ++window) {
    Scenario scenario = calibrated(fan(), kRays);
    scenario.receiver.azimuth_pattern = scenario.receiver.elevation_pattern = static_cast<BeamPattern>(window);
    scenario.points = {{.position = 15.02 * Vec3(std::cos(azimuth), std::sin(azimuth), 0)}};
    const Ping ping = ping_of(scenario, {});
    EXPECT_NEAR(cell_db(ping, static_cast<int>(15.02 / fan().bin_length()), 100), -40 * std::log10(15.02), 0.2)
        << window;  // The beam points an eighth of its width beside the point.
  }
}

// Faulty elements raise the side lobes; the pattern is that of ArrayPattern with the same seed.
TEST(ArrayPingTest, FaultyElementsRaiseTheSideLobes) {
  const SonarConfig sonar = fan();
  Scenario scenario = calibrated(sonar, kRays);
  scenario.receiver.azimuth_pattern = BeamPattern::kHann;
  scenario.receiver.elements = 128;
  scenario.receiver.element_error_db = 1;
  scenario.receiver.dead_elements = {3, 40, 41, 77};
  scenario.seed = 5;
  scenario.points = {{.position = {15.02, 0, 0}}};
  const Ping ping = ping_of(scenario, {});
  const ArrayPattern array(
      {.window = ArrayWindow::kHann, .elements = 128, .element_error_db = 1, .dead_elements = {3, 40, 41, 77}}, 5);
  const double length = array.length(1, 1 * kDegree);
  const int bin = static_cast<int>(15.02 / sonar.bin_length());
  double highest = -100;
  for (int beam = 0; beam < sonar.beam_count; ++beam) {
    const double expected = decibels(array.intensity(-length * std::sin(sonar.beam_azimuth(beam))));
    if (expected > -50) {
      EXPECT_NEAR(cell_db(ping, bin, beam) + 40 * std::log10(15.02), expected, 0.01) << beam;
    }
    highest = std::abs(beam - 127.5) > 8 ? std::max(highest, expected) : highest;
  }
  EXPECT_GT(highest, -30);  // Without faults they are below -31.5 dB and fall off fast.
}

// T14 for a scanning head, which transmits and receives with the same array: side lobes are 26.5 dB down.
TEST(ArrayPingTest, ScanningHeadIsTwoWay) {
  SonarConfig sonar;
  sonar.type = SonarType::kMechanicallyScanned;
  sonar.beam_count = 1;
  sonar.azimuth_aperture = 3 * kDegree;
  sonar.min_range = 0;
  sonar.max_range = 25;
  sonar.head.step = 0.375 * kDegree;  // An eighth of a beam: the point is in the middle of a cell in every ping.
  const double first = 0.1875 * kDegree;
  Scenario scenario = calibrated(sonar, kRays);
  scenario.receiver.azimuth_pattern = BeamPattern::kRectangular;
  scenario.points = {{.position = 15.02 * Vec3(std::cos(first), std::sin(first), 0)}};
  Simulator simulator(scenario, {}, 2);
  const double length = 0.8858929413781328 / (2 * std::sin(1.5 * kDegree));  // D / wavelength
  for (int ping = 0; ping < 20; ++ping) {
    const double x = kPi * length * std::sin(first - ping * sonar.head.step);
    const double expected = decibels(std::pow(std::sin(x) / x, 4));
    if (expected > -50) {
      EXPECT_NEAR(total_db(simulator.make_ping(0, ping)) + 40 * std::log10(15.02), expected, 0.05) << ping;
    }
  }
}

// A beam of an array takes the label of the strongest cell in its own slice.
TEST(ArrayPingTest, BeamTakesTheLabelOfItsStrongestCell) {
  SonarConfig sonar;
  sonar.type = SonarType::kMechanicallyScanned;
  sonar.beam_count = 1;
  sonar.azimuth_aperture = 8 * kDegree;
  sonar.min_range = 0;
  sonar.max_range = 25;
  sonar.sampling = {64, 400};
  Scenario scenario = calibrated(sonar, kRays);
  scenario.receiver.azimuth_pattern = BeamPattern::kHann;
  // Plates in one bin in the middles of three cells, -3.5, 0.5 and 2.5 degrees off: weak, strong, middling.
  Scene scene;
  for (const auto& [azimuth, level] : {std::pair{3.5, -30.0}, {-0.5, -10.0}, {-2.5, -20.0}}) {
    Scene plate = plate_at(10, 0.1, diffuse(level));
    plate.instances[0].world_from_mesh = {
        .position = 10.02 * Vec3(std::cos(azimuth * kDegree), std::sin(azimuth * kDegree), 0),
        .orientation = orientation_from_rpy(0, 0, azimuth * kDegree)};
    plate.instances[0].materials.assign(plate.instances[0].materials.size(),
                                        static_cast<std::uint16_t>(scene.materials.size()));
    scene.materials.push_back(plate.materials[0]);
    scene.instances.push_back(plate.instances[0]);
  }
  const Ping ping = ping_of(scenario, scene);
  EXPECT_EQ(ping.instance[ping.index(static_cast<int>(10.02 / sonar.bin_length()), 0)], 1);
}

// Beams much narrower than their spacing receive the floor by the integral of their pattern: without a window that is
// 2 sin(width / 2) / 0.88589 in u, straight ahead; a Hann window collects 1.5 times 1 / 1.44058 of the half-power
// width. The floor's echo: mu h^2 psi (r1^-4 - r2^-4) / 4.
TEST(ArrayPingTest, NarrowBeamsFarApartReceiveTheirShareOfAFloor) {
  for (const Method& method : {kRays, kReference}) {
    for (const auto& [width, spacing] : {std::pair{0.35, 1.4}, {0.5, 0.8}, {0.9, 1.1}, {1.0, 0.5}}) {
      SonarConfig sonar;
      sonar.beam_count = 21;
      sonar.azimuth_aperture = sonar.beam_count * spacing * kDegree;
      sonar.azimuth_resolution = width * kDegree;
      sonar.elevation_center = -15 * kDegree;
      sonar.min_range = 8;
      sonar.max_range = 16;
      sonar.bin_count = 80;
      sonar.sampling = {8, 400};
      for (const auto& [pattern, share] :
           {std::pair{BeamPattern::kRectangular, 1 / 0.8858929}, {BeamPattern::kHann, 1.5 / 1.4405795}}) {
        Scenario scenario = calibrated(sonar, method);
        scenario.receiver.azimuth_pattern = pattern;
        const Ping ping = ping_of(scenario, seabed_at(-3, diffuse(-27)));
        const double near = sonar.bin_range(40) - 0.05, far = near + 0.1;
        const double expected =
            decibels(std::pow(10, -2.7) * 9 * share * width * kDegree * (std::pow(near, -4) - std::pow(far, -4)) / 4);
        EXPECT_NEAR(cell_db(ping, 40, 10), expected, 0.1) << method.name << ", " << width << ", " << spacing;
      }
    }
  }
}

Ping two_plates(PulseKind pulse) {
  SonarConfig sonar = fan();
  sonar.beam_count = 8;
  sonar.azimuth_aperture = 4 * kDegree;
  sonar.elevation_aperture = 1 * kDegree;
  sonar.min_range = 9.8;
  sonar.max_range = 10.2;
  sonar.bin_count = 200;
  Scenario scenario = calibrated(sonar, kRays);
  scenario.water.sound_speed = 1500;
  scenario.receiver.pulse = pulse;
  scenario.receiver.pulse_duration = pulse == PulseKind::kCw ? 50e-6 : 1e-3;
  scenario.receiver.pulse_bandwidth = 100e3;
  scenario.points = {{.position = {10.001, 0.001, 0}}, {.position = {10.031, 0.001, 0}}};
  return ping_of(scenario, {});
}

// T18.
TEST(PulsePingTest, ChirpResolvesWhatAToneDoesNot) {
  const auto dip = [](const Ping& ping) {
    const std::vector<double> received = by_range(ping);
    const auto level = [&](double range) { return decibels(received[static_cast<int>((range - 9.8) / 0.002)]); };
    return std::min(level(10.001), level(10.031)) - level(10.016);
  };
  EXPECT_GT(dip(two_plates(PulseKind::kLfm)), 3);
  EXPECT_LT(dip(two_plates(PulseKind::kCw)), 2);
}

// What the instrument transmits acts as the receiver's own pulse of the same values; the receiver's replaces it.
TEST(PulsePingTest, TheInstrumentsPulseActsUnlessTheReceiverNamesAnother) {
  const Scene scene = plate_at(15, 4, diffuse(-20), 0.5);
  const auto ping_with = [&](const SonarConfig& sonar, const ReceiverConfig& receiver) {
    Scenario scenario = calibrated(sonar, kRays);
    scenario.receiver = receiver;  // With speckle and noise.
    return ping_of(scenario, scene);
  };
  ReceiverConfig chirp;
  chirp.pulse = PulseKind::kLfm;
  chirp.pulse_duration = 700e-6;
  chirp.pulse_bandwidth = 30e3;
  chirp.pulse_window = PulseWindow::kTaylor;
  chirp.pulse_side_lobe_db = -33;
  SonarConfig instrument = fan();
  instrument.pulse = PulseKind::kLfm;
  instrument.pulse_duration = 700e-6;
  instrument.pulse_bandwidth = 30e3;
  instrument.pulse_window = PulseWindow::kTaylor;
  ReceiverConfig plain, none;
  plain.pulse_side_lobe_db = -33;
  none.pulse = PulseKind::kNone;
  EXPECT_EQ(ping_with(instrument, plain).intensity, ping_with(fan(), chirp).intensity);
  EXPECT_EQ(ping_with(instrument, none).intensity, ping_with(fan(), plain).intensity);
  EXPECT_NE(ping_with(instrument, plain).intensity, ping_with(fan(), plain).intensity);
}

}  // namespace
}  // namespace insonify::validation::receiver_test
