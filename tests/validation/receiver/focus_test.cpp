// focus_test.cpp -- beams out of focus, nearer than D^2 / wavelength, against sums over points of the array at their
// exact distances.

#include <complex>

#include "validation/calibrated_scene.h"

namespace insonify::validation::focus_test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSoundSpeed = 1500, kFrequency = 720e3;
constexpr double kWavelength = kSoundSpeed / kFrequency;
// A line with a beam of 1 degree: 105.7 mm long, D^2 / wavelength = 5.37 m.
const double kLength = 0.8858929413781328 * kWavelength / (2 * std::sin(0.5 * kDegree));

double db(double value) {
  return 10 * std::log10(value);
}

// Power that a line along y receives from a place in front, with the delays that focus it at another place.
double received(const Vec3& place, const Vec3& focus) {
  constexpr int kPoints = 4000;
  const double wave_number = 2 * kPi / kWavelength;
  std::complex<double> sum = 0;
  for (int i = 0; i < kPoints; ++i) {
    const Vec3 element(0, kLength * ((i + 0.5) / kPoints - 0.5), 0);
    const double there = (place - element).norm() - place.norm(), delay = (focus - element).norm() - focus.norm();
    sum += std::polar(1.0 / kPoints, -wave_number * (there - delay));
  }
  return std::norm(sum);
}

SonarConfig fan(double focus) {
  SonarConfig sonar;
  sonar.frequency = kFrequency;
  sonar.beam_count = 64;
  sonar.azimuth_aperture = 100 * kDegree;
  sonar.azimuth_resolution = 1 * kDegree;
  sonar.min_range = 1;
  sonar.max_range = 24;
  sonar.bin_count = 460;
  sonar.focus_range = focus;
  return sonar;
}

Scenario focused(const SonarConfig& sonar) {
  Scenario scenario = calibrated(sonar, kRays);
  scenario.water.sound_speed = kSoundSpeed;
  scenario.receiver.azimuth_pattern = BeamPattern::kRectangular;
  return scenario;
}

constexpr double kRanges[] = {1.53, 3.03, 8.03, 20.03};

// Levels of a beam at points at all ranges in one azimuth, re their echoes [dB].
std::vector<double> losses_db(const Scenario& scenario, double azimuth, int beam) {
  Scenario with = scenario;
  for (const double range : kRanges) {
    with.points.push_back({.position = point_from_spherical({range, azimuth, 0})});
  }
  const Ping ping = ping_of(with, {});
  std::vector<double> losses;
  for (const double range : kRanges) {
    const auto bin = static_cast<int>((range - 1) / 0.05);
    double sum = 0;  // A point lies in one bin, or is split by rounding.
    for (int near = bin - 1; near <= bin + 1; ++near) {
      sum += double{ping.intensity[ping.index(near, beam)]};
    }
    losses.push_back(db(sum) + 40 * std::log10(range));
  }
  return losses;
}

// Peaks and flanks, straight ahead and at 35 degrees, where the array seen from the point is shorter: at 1.5 m the peak
// is 3.20 dB lower, and a degree off the beam, where a focused one has 16 dB less, 7 dB.
TEST(FocusTest, BeamsAreWiderNearerThanTheFarField) {
  for (const double focus : {1e6, 5.0}) {
    const Scenario scenario = focused(fan(focus));
    for (const int beam : {9, 32}) {
      const double steered = scenario.sonars[0].beam_azimuth(beam);
      for (const double off : {0.0, 0.4, 1.0}) {
        const double azimuth = steered + off * kDegree / std::cos(steered);
        const std::vector<double> losses = losses_db(scenario, azimuth, beam);
        for (std::size_t i = 0; i < std::size(kRanges); ++i) {
          const double wanted = db(received(point_from_spherical({kRanges[i], azimuth, 0}),
                                            point_from_spherical({std::min(focus, 1e4), steered, 0})));
          // Zones of phases within 0.06 rad move flanks, which are steep, by a few per cent of their depth in dB; at
          // 1.5 m there are terms of third order too.
          EXPECT_NEAR(losses[i], wanted, 0.15 - 0.05 * wanted)
              << focus << " " << kRanges[i] << " " << beam << " " << off;
        }
      }
    }
  }
}

TEST(FocusTest, IsLosslessAtItsRangeAndDynamicEverywhere) {
  for (std::size_t i = 0; i < std::size(kRanges); ++i) {
    const SonarConfig sonar = fan(kRanges[i]);
    EXPECT_NEAR(losses_db(focused(sonar), sonar.beam_azimuth(32), 32)[i], 0, 0.01);
  }
  SonarConfig dynamic = fan(5);
  dynamic.focus_range = {};
  for (const double loss : losses_db(focused(dynamic), dynamic.beam_azimuth(32), 32)) {
    EXPECT_NEAR(loss, 0, 0.001);
  }
}

// Width of a pattern of N equal elements at half power, in wavelengths over N times their spacing, by bisection.
double width_of_elements(int elements) {
  double low = 0, high = 1;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high),
                 gain = std::sin(kPi * middle) / (elements * std::sin(kPi * middle / elements));
    (gain * gain > 0.5 ? low : high) = middle;
  }
  return 2 * low;
}

// An array without the 50 elements of 120 at its port end is centred 2.2 cm to starboard: out of focus it sees what is
// near too far to port, by 0.4 degrees at 3 m. An array with the sign of its defocus wrong sees it to starboard.
TEST(FocusTest, FaultyArraysSeeNearPointsFromWhereTheyAre) {
  constexpr int kElements = 120, kDead = 50;
  const double length = width_of_elements(kElements) * kWavelength / (2 * std::sin(0.5 * kDegree));
  for (const double focus : {1e6, 5.0}) {
    Scenario scenario = focused(fan(focus));
    scenario.receiver.elements = kElements;
    for (int i = 0; i < kDead; ++i) {
      scenario.receiver.dead_elements.push_back(i);
    }
    constexpr int kBeam = 32;
    const double steered = scenario.sonars[0].beam_azimuth(kBeam);
    const Vec3 focused_at = point_from_spherical({std::min(focus, 1e4), steered, 0});
    for (const double off : {-1.2, -0.6, 0.0, 0.6, 1.2}) {
      const std::vector<double> losses = losses_db(scenario, steered + off * kDegree, kBeam);
      for (std::size_t i = 1; i < std::size(kRanges); ++i) {
        const Vec3 place = point_from_spherical({kRanges[i], steered + off * kDegree, 0});
        std::complex<double> sum = 0;
        for (int element = kDead; element < kElements; ++element) {
          const Vec3 at(0, length * (0.5 - (element + 0.5) / kElements), 0);
          const double there = (place - at).norm() - place.norm(), delay = (focused_at - at).norm() - focused_at.norm();
          sum += std::polar(1.0 / kElements, -2 * kPi / kWavelength * (there - delay));
        }
        const double wanted = db(std::norm(sum));
        EXPECT_NEAR(losses[i], wanted, 0.15 - 0.05 * wanted) << focus << " " << kRanges[i] << " " << off;
      }
    }
  }
}

// A floor has the same level in all beams, in focus or not: the beam that is wider is as much lower. Its energy is that
// of the weights (Parseval). Through speckle: 16 seeds x 50 beams x 40 bins, of which some 12 000 are independent.
TEST(FocusTest, FloorsKeepTheirLevel) {
  SonarConfig sonar = fan(1e6);
  sonar.elevation_aperture = 40 * kDegree;
  sonar.elevation_center = -40 * kDegree;
  sonar.max_range = 4;
  sonar.bin_count = 60;
  for (const bool speckle : {false, true}) {
    double sums[2] = {};
    for (const bool dynamic : {false, true}) {
      sonar.focus_range = dynamic ? std::optional<double>() : 1e6;
      Scenario scenario = focused(sonar);
      scenario.receiver.speckle = speckle;
      scenario.receiver.pulse = PulseKind::kCw;
      scenario.receiver.pulse_duration = 133e-6;
      for (scenario.seed = 1; scenario.seed <= (speckle ? 16 : 1); ++scenario.seed) {
        const Ping ping = ping_of(scenario, seabed_at(-1, diffuse(-27)));
        for (int bin = 10; bin < 50; ++bin) {
          for (int beam = 7; beam < 57; ++beam) {
            sums[dynamic ? 1 : 0] += double{ping.intensity[ping.index(bin, beam)]};
          }
        }
      }
    }
    EXPECT_NEAR(db(sums[0] / sums[1]), 0, speckle ? 0.15 : 0.05) << speckle;
  }
}

// A head that sends with the array too loses twice as much.
TEST(FocusTest, HeadsLoseBothWays) {
  SonarConfig head = fan(1e6);
  head.type = SonarType::kMechanicallyScanned;
  head.beam_count = 1;
  head.azimuth_aperture = 1 * kDegree;
  head.head.sector_width = 90 * kDegree;
  Scenario scenario = focused(head);
  scenario.sonars[0].head.sector_center = 45 * kDegree;  // Begins straight ahead.
  const std::vector<double> losses = losses_db(scenario, 0, 0);
  for (std::size_t i = 0; i < std::size(kRanges); ++i) {
    EXPECT_NEAR(losses[i], 2 * db(received({kRanges[i], 0, 0}, {1e4, 0, 0})), 0.3) << kRanges[i];
  }
}

}  // namespace
}  // namespace insonify::validation::focus_test
