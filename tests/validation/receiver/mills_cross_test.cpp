// mills_cross_test.cpp -- sonars that transmit and receive with different patterns: levels by the product of the two in
// closed form, noise by the pattern of reception alone, and arrays of fans that send as well as receive.

#include "validation/calibrated_scene.h"

namespace insonify::validation::mills_cross_test {
namespace {

constexpr double kPi = std::numbers::pi;

// Amplitude of a uniform line at x = (L / wavelength) sin(angle), and of one with a Hann window.
double uniform(double x) {
  return std::abs(x) < 1e-9 ? 1 : std::sin(kPi * x) / (kPi * x);
}
double hann(double x) {
  return std::abs(std::abs(x) - 1) < 1e-9 ? 0.5 : uniform(x) / (1 - x * x);
}

// Intensity gain at an angle of a line whose width at half power is `width_deg`: 0.8858929 or 1.4405943 wavelengths
// over 2 sin(width / 2).
double gain(BeamPattern window, double width_deg, double angle_deg) {
  const double length =
      (window == BeamPattern::kHann ? 1.4405943 : 0.8858929) / (2 * std::sin(width_deg / 2 * kDegree));
  const double x = length * std::sin(angle_deg * kDegree);
  return std::pow(window == BeamPattern::kHann ? hann(x) : uniform(x), 2);
}

double db(double value) {
  return 10 * std::log10(value);
}

// Transmits 3 degrees high and receives 24 degrees high, in beams of 2 degrees: a Mills cross.
constexpr double kSent = 3, kReceived = 24, kBeam = 2;

SonarConfig cross(BeamPattern sent) {
  SonarConfig sonar;
  sonar.beam_count = 31;
  sonar.azimuth_aperture = 31 * kDegree;
  sonar.azimuth_resolution = kBeam * kDegree;
  sonar.elevation_aperture = kReceived * kDegree;
  sonar.elevation_pattern = BeamPattern::kRectangular;
  sonar.transmit_elevation_pattern = sent;
  sonar.transmit_elevation_aperture = kSent * kDegree;
  sonar.min_range = 5;
  sonar.max_range = 15;
  sonar.bin_count = 200;
  sonar.sampling = {4, 400};
  return sonar;
}

Scenario with_cross(const Method& method, BeamPattern sent) {
  Scenario scenario = calibrated(cross(sent), method);
  scenario.receiver.azimuth_pattern = BeamPattern::kHann;
  scenario.receiver.elevation_pattern = BeamPattern::kInstrument;
  return scenario;
}

double both_ways(BeamPattern sent, double elevation) {
  return gain(sent, kSent, elevation) * gain(BeamPattern::kRectangular, kReceived, elevation);
}

class MillsCrossTest : public testing::TestWithParam<Method> {};

// In beam 15, which looks straight ahead, and in beam 16, a degree to starboard. Also through a tone.
TEST_P(MillsCrossTest, PointsHaveTheProductOfBothPatterns) {
  for (const BeamPattern sent : {BeamPattern::kRectangular, BeamPattern::kHann}) {
    for (const PulseKind pulse : {PulseKind::kNone, PulseKind::kCw}) {
      for (const double elevation : {0.0, 1.0, -1.5, 2.3, 4.0}) {
        Scenario scenario = with_cross(GetParam(), sent);
        scenario.sonars[0].pulse = pulse;
        scenario.sonars[0].pulse_duration = 133e-6;  // Two bins.
        scenario.points = {
            {.position = point_from_spherical({10.025, 0, elevation * kDegree}), .target_strength_db = -20}};
        const Ping ping = ping_of(scenario, {});
        const auto peak_of = [&](int beam) {
          float peak = 0;
          for (int bin = 0; bin < ping.bin_count; ++bin) {
            peak = std::max(peak, ping.intensity[ping.index(bin, beam)]);
          }
          return db(double{peak});
        };
        const double expected = -20 - 40 * std::log10(10.025) + db(both_ways(sent, elevation));
        EXPECT_NEAR(peak_of(15), expected, 0.02) << elevation;
        EXPECT_NEAR(peak_of(16), expected + db(gain(BeamPattern::kHann, kBeam, 1)), 0.02) << elevation;
      }
    }
  }
}

// Each array has the mean pattern of arrays whose parts, half a wavelength long, have errors of 1.5 dB and 15 degrees:
// exp(0.172694^2 + 0.261799^2) - 1 = 0.103359 of the power on the axis over the number of parts, with the pattern of a
// part. 3.389 degrees are the null of the transmitter without a window. Also through a tone, in bins of ten times its
// length, and in cones.
TEST_P(MillsCrossTest, ErrorsOfThePartsFillTheNullsOfBoth) {
  const auto filled = [](BeamPattern window, double width_deg, double angle_deg) {
    const double efficiency = window == BeamPattern::kHann ? 2.0 / 3 : 1;
    const double length =
        (window == BeamPattern::kHann ? 1.4405943 : 0.8858929) / (2 * std::sin(width_deg / 2 * kDegree));
    const double k = 0.103359 / (2 * length * efficiency);
    return (gain(window, width_deg, angle_deg) + k * std::pow(uniform(0.5 * std::sin(angle_deg * kDegree)), 2)) /
           (1 + k);
  };
  for (const BeamPattern sent : {BeamPattern::kRectangular, BeamPattern::kHann}) {
    for (const BeamShape shape : {BeamShape::kWedge, BeamShape::kCone}) {
      for (const int bins : {200, 20}) {
        for (const double elevation : {0.0, 3.389, -8.0}) {
          Scenario scenario = with_cross(GetParam(), sent);
          scenario.receiver.beam_shape = shape;
          SonarConfig& sonar = scenario.sonars[0];
          sonar.bin_count = bins;
          sonar.pulse = PulseKind::kCw;
          sonar.pulse_duration = 66e-6;
          sonar.elevation_element_error_db = 1.5;
          sonar.elevation_element_error = 15 * kDegree;
          scenario.points = {
              {.position = point_from_spherical({10.025, 0, elevation * kDegree}), .target_strength_db = -20}};
          const std::vector<float> levels = ping_of(scenario, {}).intensity;
          EXPECT_NEAR(db(double{std::ranges::max(levels)}),
                      -20 - 40 * std::log10(10.025) + db(filled(sent, kSent, elevation)) +
                          db(filled(BeamPattern::kRectangular, kReceived, elevation)),
                      0.03)
              << elevation << ", " << bins;
        }
      }
    }
  }
}

// At the centre of a Lambert sphere of radius r the echo per unit solid angle is mu / r^2. Top-hat beams sum the
// product of both patterns over the fan.
TEST_P(MillsCrossTest, SphereAroundTheSonarSumsTheProduct) {
  const bool slow = GetParam().engine == kReference.engine;
  const Scene shell = sphere_at({0, 0, 0}, 10, diffuse(-20), slow ? 0.2 : 0.08);
  for (const BeamPattern sent : {BeamPattern::kRectangular, BeamPattern::kHann}) {
    for (const int bins : {200, 5}) {  // Fine and coarse.
      Scenario scenario = with_cross(GetParam(), sent);
      scenario.sonars[0].bin_count = bins;
      scenario.sonars[0].sampling = slow ? Sampling{1, 100} : Sampling{4, 400};
      scenario.receiver.azimuth_pattern = BeamPattern::kTopHat;
      double sum = 0;
      constexpr double kStep = 0.005;
      for (double elevation = -89; elevation < 89; elevation += kStep) {
        sum += both_ways(sent, elevation) * 31 * kDegree * std::cos(elevation * kDegree) * kStep * kDegree;
      }
      EXPECT_NEAR(total_db(ping_of(scenario, shell)), -20 - 20 * std::log10(10) + db(sum), slow ? 0.1 : 0.03);
    }
  }
}

// A top hat that transmits lower than the receiver hears cuts the sector: the sum is that of its own elevations.
TEST_P(MillsCrossTest, TopHatsLimitTheSector) {
  const bool slow = GetParam().engine == kReference.engine;
  const Scene shell = sphere_at({0, 0, 0}, 10, diffuse(-20), slow ? 0.2 : 0.08);
  Scenario scenario = with_cross(GetParam(), BeamPattern::kTopHat);
  scenario.sonars[0].sampling = slow ? Sampling{1, 50} : Sampling{4, 400};
  scenario.receiver.azimuth_pattern = scenario.receiver.elevation_pattern = BeamPattern::kTopHat;
  const double sum = 31 * kDegree * 2 * std::sin(kSent / 2 * kDegree);
  EXPECT_NEAR(total_db(ping_of(scenario, shell)), -40 + db(sum), slow ? 0.1 : 0.03);
}

// A point or a small sphere 1 m above a smooth floor 2 m below the sonar. Of the two echoes by the floor one way, each
// is sent in one direction and received from the other: T(straight) R(image) + T(image) R(straight), of patterns 10 and
// 40 degrees high, over twice that without patterns.
TEST_P(MillsCrossTest, GhostsAreSentInOneDirectionAndReceivedFromAnother) {
  Material mirror = glinting(1, 0.01);
  mirror.rms_height = 1e-7;
  const Scene floor = scene_of(make_plane(Vec3::UnitZ(), 60, 60), mirror, {.position = {0, 0, -2}});
  const Vec3 place(10, 0, -1);
  const Scene with_sphere = scene_of_all({sphere_at(place, 0.2, diffuse(-10), 0.3), floor});
  const double straight = std::atan2(-1.0, 10.0) / kDegree, image = std::atan2(-3.0, 10.0) / kDegree;
  for (const bool is_point : {true, false}) {
    double levels[2];
    for (const bool has_patterns : {false, true}) {
      SonarConfig sonar = cross(has_patterns ? BeamPattern::kRectangular : BeamPattern::kTopHat);
      sonar.transmit_elevation_aperture = (has_patterns ? 10 : 80) * kDegree;
      sonar.elevation_aperture = (has_patterns ? 40 : 80) * kDegree;
      sonar.elevation_pattern = has_patterns ? BeamPattern::kRectangular : BeamPattern::kTopHat;
      sonar.min_range = 8;
      sonar.max_range = 12;
      sonar.sampling = GetParam().engine == kReference.engine ? Sampling{4, 800} : Sampling{16, 3000};
      Scenario scenario = calibrated(sonar, GetParam());
      scenario.receiver.elevation_pattern = BeamPattern::kInstrument;
      scenario.secondary = SecondaryEchoes::kAll;
      scenario.max_surfaces = 2;
      if (is_point) {
        scenario.points = {{.position = place, .target_strength_db = 0}};
      }
      // Only the ghost: farther than the direct echo at 10.05 m, by half of 10.44 - 10.05 m.
      scenario.sonars[0].min_range = 10.1;
      levels[has_patterns ? 1 : 0] = total_db(ping_of(scenario, is_point ? floor : with_sphere));
    }
    const auto sent = [](double angle) { return gain(BeamPattern::kRectangular, 10, angle); };
    const auto received = [](double angle) { return gain(BeamPattern::kRectangular, 40, angle); };
    const double expected = db(0.5 * (sent(straight) * received(image) + sent(image) * received(straight)));
    EXPECT_LT(expected, -3);
    EXPECT_NEAR(levels[1] - levels[0], expected, is_point ? 0.02 : 0.3) << is_point;
  }
}

constexpr auto kName = [](const auto& test) { return test.param.name; };
INSTANTIATE_TEST_SUITE_P(Methods, MillsCrossTest, testing::Values(kReference, kRays), kName);

// The transmitter changes echoes and not noise.
TEST(MillsCrossNoiseTest, SeesThePatternOfReceptionAlone) {
  Scenario scenario = with_cross(kRays, BeamPattern::kHann);
  scenario.receiver.noise = true;
  const std::vector<float> noise = ping_of(scenario, {}).intensity;
  scenario.sonars[0].transmit_elevation_pattern = BeamPattern::kInstrument;
  scenario.sonars[0].transmit_elevation_aperture.reset();
  EXPECT_EQ(ping_of(scenario, {}).intensity, noise);
  const Scene bed = seabed_at(-1, diffuse(-20));
  const double alike = total_db(ping_of(scenario, bed));
  scenario.sonars[0].transmit_elevation_aperture = kSent * kDegree;
  EXPECT_LT(total_db(ping_of(scenario, bed)), alike - 3);
}

// The transmitter named as it is by default changes nothing, bit by bit.
TEST(MillsCrossDefaultTest, IsTheReceiversPatternBothWays) {
  Scenario scenario = with_cross(kRays, BeamPattern::kInstrument);
  scenario.secondary = SecondaryEchoes::kAll;
  scenario.sonars[0].transmit_elevation_aperture.reset();
  const Scene scene = scene_of_all({seabed_at(-1, diffuse(-20)), sphere_at({9, 0, 0}, 0.5, glinting(0.5, 0.2), 0.3)});
  const std::vector<float> before = ping_of(scenario, scene).intensity;
  scenario.sonars[0].transmit_elevation_pattern = BeamPattern::kRectangular;
  scenario.sonars[0].transmit_elevation_aperture = kReceived * kDegree;
  EXPECT_EQ(ping_of(scenario, scene).intensity, before);
}

// A fixed beam of an array that transmits too is that of a scanning head straight ahead: the same cells and levels.
TEST(TwoWayArrayTest, AFixedBeamIsThatOfAHeadStraightAhead) {
  SonarConfig sonar = cross(BeamPattern::kInstrument);
  sonar.transmit_elevation_aperture.reset();
  sonar.beam_count = 1;
  sonar.azimuth_aperture = kBeam * kDegree;
  const Scene scene = scene_of_all({seabed_at(-1, diffuse(-20)), sphere_at({9, 2, 0}, 0.5, glinting(0.5, 0.2), 0.3)});
  std::vector<float> intensity[2];
  for (const bool scans : {false, true}) {
    sonar.type = scans ? SonarType::kMechanicallyScanned : SonarType::kForwardLooking;
    sonar.two_way_array = !scans;
    Scenario scenario = calibrated(sonar, kRays);
    scenario.secondary = SecondaryEchoes::kSelective;
    scenario.receiver.azimuth_pattern = BeamPattern::kRectangular;
    scenario.receiver.speckle = scenario.receiver.noise = true;
    scenario.points = {{.position = {8, 1, 0}}};
    intensity[scans ? 1 : 0] = ping_of(scenario, scene).intensity;
  }
  EXPECT_EQ(intensity[0], intensity[1]);
}

TEST(TwoWayArrayTest, PointsFallWithThePatternTwice) {
  SonarConfig sonar = cross(BeamPattern::kInstrument);
  sonar.beam_count = 1;
  sonar.azimuth_aperture = kBeam * kDegree;
  sonar.two_way_array = true;
  for (const double azimuth : {0.0, 0.7, -1.3, 3.0}) {
    Scenario scenario = calibrated(sonar, kRays);
    scenario.receiver.azimuth_pattern = BeamPattern::kRectangular;
    scenario.points = {{.position = point_from_spherical({10.025, azimuth * kDegree, 0})}};
    EXPECT_NEAR(total_db(ping_of(scenario, {})),
                -40 * std::log10(10.025) + 2 * db(gain(BeamPattern::kRectangular, kBeam, azimuth)), 0.02)
        << azimuth;
  }
}

}  // namespace
}  // namespace insonify::validation::mills_cross_test
