// clutter_statistics_test.cpp -- contrast of K-distributed clutter as received by array and pulse, against the variance
// of the texture's mean over the resolution cell.

#include <numbers>

#include "validation/calibrated_scene.h"
#include "validation/receiver/texture_correlation.h"

namespace insonify::validation::clutter_statistics_test {
namespace {

constexpr double kHeight = 2.5;  // Of the sonar above the bed [m].
constexpr int kBeams = 64, kBins = 160;
constexpr double kSpacing = 30.0 / kBeams * kDegree, kPulse = 50e-6;

class ClutterStatisticsTest : public testing::Test {
 protected:
  static Scenario scenario_at(double range) {
    SonarConfig sonar;
    sonar.beam_count = kBeams;
    sonar.azimuth_aperture = kBeams * kSpacing;
    sonar.azimuth_resolution = 1 * kDegree;
    sonar.elevation_center = -0.5 * (std::asin(kHeight / range) + std::asin(kHeight / (range + 2)));
    sonar.elevation_aperture = 8 * kDegree;
    sonar.min_range = range;
    sonar.max_range = range + 2;
    sonar.bin_count = kBins;
    sonar.sampling = {2, 100};
    Scenario scenario = calibrated(sonar, kRays);
    scenario.receiver.azimuth_pattern = BeamPattern::kRectangular;
    scenario.receiver.pulse = PulseKind::kCw;
    scenario.receiver.pulse_duration = kPulse;
    return scenario;
  }

  // Autocorrelation of weights, which are normalised to a sum of 1; [lag], from -(n - 1) to n - 1.
  static std::vector<double> autocorrelation(std::vector<double> weights) {
    double sum = 0;
    for (const double w : weights) {
      sum += w;
    }
    const int n = static_cast<int>(weights.size());
    std::vector<double> result(2 * n - 1, 0.0);
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        result[i - j + n - 1] += weights[i] * weights[j] / (sum * sum);
      }
    }
    return result;
  }

  // Variance of the texture's mean over the resolution cell at a range, for shape 1 of the texture itself: the mean of
  // its correlation over pairs of points, which are weighted by the squares of pattern (sinc) and pulse (a triangle of
  // base c tau, on the bed stretched by r / x).
  static double variance(const TextureCorrelation& correlation, double length, double range, double wavelength,
                         double sound_speed) {
    const double array = 0.8858929413781328 * wavelength / (2 * std::sin(0.5 * kDegree));
    const double stretch = range / std::sqrt(range * range - kHeight * kHeight);
    constexpr int kAcross = 240, kAlong = 24;
    const double wide = 12 * kDegree * range / kAcross, deep = sound_speed * kPulse / kAlong * stretch;
    std::vector<double> across, along;
    for (int i = 0; i < kAcross; ++i) {
      const double x =
          std::numbers::pi * array / wavelength * std::sin((i + 0.5 - 0.5 * kAcross) * 12 * kDegree / kAcross);
      across.push_back(std::pow(std::sin(x) / x, 2));
    }
    for (int i = 0; i < kAlong; ++i) {
      along.push_back(std::pow(1 - std::abs(2 * (i + 0.5) / kAlong - 1), 2));
    }
    const std::vector<double> sideways = autocorrelation(across), ahead = autocorrelation(along);
    double sum = 0;
    for (std::size_t i = 0; i < sideways.size(); ++i) {
      const double y = (static_cast<double>(i) - (kAcross - 1)) * wide;
      for (std::size_t j = 0; j < ahead.size(); ++j) {
        const double x = (static_cast<double>(j) - (kAlong - 1)) * deep;
        sum += sideways[i] * ahead[j] * correlation.at(std::hypot(x, y) / length);
      }
    }
    return sum;
  }

  struct Contrast {
    double squared, error;    // Of C^2, and the standard error of that, from the differences between the places.
    double tail, tail_error;  // Share of intensities above five times the mean, and its standard error.
  };

  static Contrast contrast(double shape, double length, double range, int places) {
    Scenario scenario = scenario_at(range);
    Material material = diffuse(-20);
    const std::vector<float> mean = ping_of(scenario, seabed_at(-kHeight, material)).intensity;
    material.clutter_shape = shape;
    material.clutter_length = length;
    scenario.receiver.speckle = true;
    Simulator simulator(scenario, seabed_at(-kHeight, material), 2);
    std::vector<double> sums, squares, tails;
    Ping ping;
    for (int place = 0; place < places; ++place) {
      // Within 190 m of the middle of the bed, and never nearer than 8 m to another place.
      const Vec3 position(-180 + 13 * (place % 27), -180 + 18.0 * (place / 27 % 20) + 0.3 * (place / 540), 0);
      const double yaw = place / 540 * 60 * kDegree;
      simulator.ping(0,
                     {.number = static_cast<std::uint64_t>(place),
                      .world_from_vehicle = {.position = position, .orientation = orientation_from_rpy(0, 0, yaw)}},
                     ping);
      double sum = 0, square = 0, n = 0, above = 0;
      for (int bin = 12; bin < kBins - 12; ++bin) {
        for (int beam = 14; beam < kBeams - 14; ++beam) {
          const double value = ping.intensity[bin * kBeams + beam] / mean[bin * kBeams + beam];
          n += 1, sum += value, square += value * value, above += value > 5 ? 1 : 0;
        }
      }
      sums.push_back(sum / n), squares.push_back(square / n), tails.push_back(above / n);
    }
    double m1 = 0, m2 = 0, tail = 0, tail_spread = 0;
    for (int i = 0; i < places; ++i) {
      m1 += sums[i] / places, m2 += squares[i] / places, tail += tails[i] / places;
    }
    // The error of m2 / m1^2 to first order.
    double spread = 0;
    for (int i = 0; i < places; ++i) {
      spread += std::pow((squares[i] - m2) / (m1 * m1) - 2 * m2 / (m1 * m1 * m1) * (sums[i] - m1), 2);
    }
    for (const double one : tails) {
      tail_spread += std::pow(one - tail, 2);
    }
    EXPECT_NEAR(m1, 1, 0.1);
    return {m2 / (m1 * m1) - 1, std::sqrt(spread) / places, tail, std::sqrt(tail_spread) / places};
  }

  // Squared contrast of the resolution cell one metre beyond the first range.
  static double theory(double shape, double length, double range) {
    const Scenario scenario = scenario_at(range);
    const double sound_speed = scenario.water.true_sound_speed();
    const TextureCorrelation correlation(shape);
    return 1 + 2 * variance(correlation, length, range + 1, sound_speed / scenario.sonars[0].frequency, sound_speed) /
                   shape;
  }

  static Contrast expect_contrast(double shape, double length, double range, int places) {
    const Contrast found = contrast(shape, length, range, places);
    const double expected = theory(shape, length, range);
    // 1 % for the ranges from beginning to end, over which the cell's width changes.
    EXPECT_NEAR(found.squared, expected, 4 * found.error + 0.01 * expected)
        << "shape " << shape << ", length " << length << " m, range " << range << " m";
    EXPECT_LT(found.error, 0.07 * expected) << "too few places";
    return found;
  }
};

// Patches of 5 m, cells of 0.2 by 0.05 m: the shape is the texture's own, C = sqrt(1 + 2 / nu), within the 2 % that
// theory allows for the cell; and so is the tail P(I > 5) of a K distribution.
TEST_F(ClutterStatisticsTest, PatchesLargerThanTheCellGiveTheShapeThatWasAsked) {
  EXPECT_NEAR(std::sqrt(theory(0.8, 5, 9)), 1.870829, 0.02 * 1.870829);
  EXPECT_NEAR(std::sqrt(theory(3, 5, 9)), 1.290994, 0.02 * 1.290994);
  const Contrast patchy = expect_contrast(0.8, 5, 9, 1500), smooth = expect_contrast(3, 5, 9, 600);
  EXPECT_NEAR(patchy.tail, 0.035864, 4 * patchy.tail_error + 0.001);
  EXPECT_NEAR(smooth.tail, 0.019176, 4 * smooth.tail_error + 0.001);
}

TEST_F(ClutterStatisticsTest, CellsOfTheSizeOfPatchesAverageThem) {
  expect_contrast(0.8, 0.4, 9, 400);
  expect_contrast(2, 0.2, 9, 200);
}

// The contrast falls with the area of the cell: with shorter patches, and with range.
TEST_F(ClutterStatisticsTest, CellsLargerThanPatchesHaveALargerShape) {
  expect_contrast(0.8, 0.06, 9, 100);
  expect_contrast(0.8, 0.06, 27, 60);
  expect_contrast(0.3, 0.02, 18, 100);
}

}  // namespace
}  // namespace insonify::validation::clutter_statistics_test
