// fan_pattern_test.cpp -- levels across the fan of a transmitter and of elements that do not send and receive alike in
// all directions: points, floors, ghosts.

#include <complex>

#include "validation/calibrated_scene.h"

namespace insonify::validation::fan_pattern_test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kTransmit = 110, kElement = 140;  // Widths at half power [deg].

// |mean of exp(i 2 pi l u s)|^2 over a line of l wavelengths, by its parts.
double of_line(double length, double sine) {
  constexpr int kParts = 400;
  std::complex<double> sum = 0;
  for (int i = 0; i < kParts; ++i) {
    sum += std::polar(1.0 / kParts, 2 * kPi * length * sine * ((i + 0.5) / kParts - 0.5));
  }
  return std::norm(sum);
}

// The line whose gain is a half at half of a width, by bisection.
double line_of(double width_deg) {
  double low = 0.1, high = 20;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (of_line(middle, std::sin(0.5 * width_deg * kDegree)) > 0.5 ? low : high) = middle;
  }
  return low;
}

double gain(double width_deg, double azimuth) {
  static const double transmit = line_of(kTransmit), element = line_of(kElement);
  return of_line(width_deg == kTransmit ? transmit : element, std::sin(azimuth));
}

double db(double value) {
  return 10 * std::log10(value);
}

class FanPatternTest : public testing::TestWithParam<Method> {};

SonarConfig fan() {
  SonarConfig sonar;
  sonar.beam_count = 130;
  sonar.azimuth_aperture = 130 * kDegree;
  sonar.azimuth_resolution = 1.4 * kDegree;
  sonar.elevation_aperture = 20 * kDegree;
  sonar.min_range = 4;
  sonar.max_range = 20;
  sonar.bin_count = 320;
  sonar.sampling = {4, 200};
  sonar.transmit_width = kTransmit * kDegree;
  sonar.element_width = kElement * kDegree;
  return sonar;
}

TEST_P(FanPatternTest, PointsHaveBothGains) {
  for (const int beam : {4, 37, 64, 99, 128}) {
    Scenario scenario = calibrated(fan(), GetParam());
    scenario.receiver.azimuth_pattern = BeamPattern::kHamming;
    const double azimuth = scenario.sonars[0].beam_azimuth(beam);
    scenario.points = {{.position = point_from_spherical({11.03, azimuth, 0}), .target_strength_db = -10}};
    const Ping ping = ping_of(scenario, {});
    EXPECT_NEAR(db(std::ranges::max(ping.intensity)),
                -10 - 40 * std::log10(11.03) + db(gain(kTransmit, azimuth) * gain(kElement, azimuth)), 0.02)
        << beam;
  }
}

// A floor fills the fan: each beam has the level of the one without these gains times both. Beams are 1.4 degrees wide,
// over which the gains change by less than 2 %. Also through a tone in bins half as long as it.
TEST_P(FanPatternTest, FloorsHaveBothGainsInEveryBeam) {
  SonarConfig sonar = fan();
  sonar.elevation_center = -15 * kDegree;
  for (const PulseKind pulse : {PulseKind::kNone, PulseKind::kCw}) {
    sonar.pulse = pulse;
    sonar.pulse_duration = 133e-6;
    Scenario scenario = calibrated(sonar, GetParam());
    scenario.receiver.azimuth_pattern = BeamPattern::kHamming;
    const Scene bed = seabed_at(-3, diffuse(-27));
    const Ping ping = ping_of(scenario, bed);
    scenario.sonars[0].transmit_width = scenario.sonars[0].element_width = {};
    const Ping alike = ping_of(scenario, bed);
    for (const int beam : {1, 20, 65, 110, 128}) {
      double with = 0, without = 0;
      for (int bin = 80; bin < 240; ++bin) {
        with += double{ping.intensity[ping.index(bin, beam)]};
        without += double{alike.intensity[alike.index(bin, beam)]};
      }
      const double azimuth = sonar.beam_azimuth(beam);
      EXPECT_NEAR(db(with / without), db(gain(kTransmit, azimuth) * gain(kElement, azimuth)), 0.1) << beam;
    }
  }
}

// A Lambert sphere or a point at (10, -5) beside a mirror at y = 6, whose image is at (10, 17). Of the two echoes by
// the mirror one way, that which arrives from the sphere, at -26.57 degrees, was sent towards the image, at 59.53
// degrees, and the other the other way round; the echo by the mirror both ways is sent towards the image.
TEST_P(FanPatternTest, GhostsAreSentInOneDirectionAndArriveFromAnother) {
  SonarConfig sonar = fan();
  sonar.element_width = {};
  sonar.min_range = 8;
  sonar.max_range = 24;
  sonar.sampling = GetParam().engine == kReference.engine ? Sampling{2, 50} : Sampling{8, 200};
  Scenario scenario = calibrated(sonar, GetParam());
  scenario.secondary = SecondaryEchoes::kAll;
  Material mirror = glinting(1, 0.01);
  mirror.rms_height = 0;
  const Scene wall = scene_of(make_plane(-Vec3::UnitY(), 40, 40), mirror, {{0, 6, 0}});
  const Scene both = scene_of_all({sphere_at({10, -5, 0}, 0.5, diffuse(-10), 0.3), wall});
  for (const bool is_point : {false, true}) {
    SCOPED_TRACE(is_point);
    scenario.points.clear();
    if (is_point) {
      scenario.points = {{.position = {10, -5, 0}}};
    }
    const Scene& scene = is_point ? wall : both;
    scenario.sonars[0].transmit_width = sonar.transmit_width;
    const Ping with = ping_of(scenario, scene);
    scenario.sonars[0].transmit_width = {};
    const Ping without = ping_of(scenario, scene);
    const double target = std::atan2(-5, 10), image = std::atan2(17, 10);
    const double direct = std::hypot(10, 5), mirrored = std::hypot(10, 17);
    const auto ratio_db = [&](double azimuth, double range) {
      double sums[2] = {};
      for (int bin = 0; bin < sonar.bin_count; ++bin) {
        for (int beam = 0; beam < sonar.beam_count; ++beam) {
          const bool near =
              std::abs(sonar.bin_range(bin) - range) < 1 && std::abs(sonar.beam_azimuth(beam) - azimuth) < 5 * kDegree;
          sums[0] += near ? double{with.intensity[with.index(bin, beam)]} : 0;
          sums[1] += near ? double{without.intensity[without.index(bin, beam)]} : 0;
        }
      }
      EXPECT_GT(sums[1], 0) << azimuth << " " << range;
      return db(sums[0] / sums[1]);
    };
    EXPECT_NEAR(ratio_db(target, direct), db(gain(kTransmit, target)), 0.1);
    EXPECT_NEAR(ratio_db(target, 0.5 * (direct + mirrored)), db(gain(kTransmit, image)), 0.2);
    EXPECT_NEAR(ratio_db(image, 0.5 * (direct + mirrored)), db(gain(kTransmit, target)), 0.2);
    EXPECT_NEAR(ratio_db(image, mirrored), db(gain(kTransmit, image)), 0.2);
  }
}

// Thermal noise is that of the elements, whatever they receive from where: the edge has as much as the middle. Means of
// 24 pings x 300 bins x 3 beams: 1.2 %.
TEST(FanPatternNoiseTest, NoiseIsAlikeInAllBeams) {
  SonarConfig sonar = fan();
  Scenario scenario = calibrated(sonar, kRays);
  scenario.receiver.noise = true;
  scenario.receiver.azimuth_pattern = BeamPattern::kTaylor;
  Simulator simulator(scenario, {}, 2);
  double edge = 0, middle = 0;
  for (int ping = 0; ping < 24; ++ping) {
    const Ping heard = simulator.make_ping(0, ping);
    for (int bin = 0; bin < 300; ++bin) {
      for (const int beam : {0, 8, 16}) {
        edge += double{heard.intensity[heard.index(bin, beam)]};
        middle += double{heard.intensity[heard.index(bin, 60 + beam)]};
      }
    }
  }
  EXPECT_NEAR(edge / middle, 1, 0.05);
}

// The instrument's own pattern across elevations, a line of 20 degrees: a half at 10 degrees, each way.
TEST_P(FanPatternTest, InstrumentsOwnElevationPatternIsTheDefault) {
  SonarConfig sonar = fan();
  sonar.transmit_width = sonar.element_width = {};
  sonar.elevation_pattern = BeamPattern::kRectangular;
  Scenario scenario = calibrated(sonar, GetParam());
  scenario.primary = PrimaryEchoes::kAuto;
  for (const double elevation : {0.0, 9.5, 16.0}) {
    scenario.points = {{.position = point_from_spherical({11.03, 0.5 * kDegree, elevation * kDegree})}};
    scenario.receiver.elevation_pattern = BeamPattern::kInstrument;
    static const double line = line_of(20);
    EXPECT_NEAR(total_db(ping_of(scenario, {})),
                -40 * std::log10(11.03) + 2 * db(of_line(line, std::sin(elevation * kDegree))), 0.02);
    scenario.receiver.elevation_pattern = BeamPattern::kTopHat;
    const double hat = total_db(ping_of(scenario, {}));
    if (elevation > 10) {
      EXPECT_EQ(hat, -std::numeric_limits<double>::infinity());
    } else {
      EXPECT_NEAR(hat, -40 * std::log10(11.03), 0.01);
    }
  }
}

TEST(FanPatternPaperTest, PaperModelHasNone) {
  SonarConfig sonar = fan();
  sonar.elevation_pattern = BeamPattern::kRectangular;
  Scenario scenario = calibrated(sonar, kRaster);
  scenario.model = EchoModel::kPaper;
  const Scene bed = seabed_at(-3, diffuse(-27));
  const Ping ping = ping_of(scenario, bed);
  scenario.sonars[0].transmit_width = scenario.sonars[0].element_width = {};
  scenario.sonars[0].elevation_pattern = BeamPattern::kTopHat;
  EXPECT_EQ(ping.intensity, ping_of(scenario, bed).intensity);
}

constexpr auto kName = [](const auto& test) { return test.param.name; };
INSTANTIATE_TEST_SUITE_P(Methods, FanPatternTest, testing::Values(kRays, kReference), kName);

}  // namespace
}  // namespace insonify::validation::fan_pattern_test
