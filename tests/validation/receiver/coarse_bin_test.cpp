// coarse_bin_test.cpp -- bins longer than the pulse: levels and statistics of extended and compact echoes, against
// closed forms and against bins as fine as the pulse that are decimated here.

#include <functional>

#include "validation/calibrated_scene.h"

namespace insonify::validation::coarse_bin_test {
namespace {

constexpr double kSpeed = 1500, kCell = 0.0125;  // A chirp of 60 kHz resolves 12.5 mm.

// A fan of 24 degrees with bins of so many resolution cells, from 9 m on.
Scenario scenario_of(int cells, const Method& method = kRays, int bins = 96) {
  SonarConfig sonar;
  sonar.frequency = 650e3;
  sonar.beam_count = 24;
  sonar.azimuth_aperture = 24 * kDegree;
  sonar.elevation_center = -15 * kDegree;
  sonar.min_range = 9;
  sonar.bin_count = bins / cells;
  sonar.max_range = 9 + bins * kCell;
  sonar.sampling = {4, 600};
  Scenario scenario = calibrated(sonar, method);
  scenario.water.sound_speed = kSpeed;
  scenario.receiver.pulse = PulseKind::kLfm;
  scenario.receiver.pulse_duration = 4e-3;
  scenario.receiver.pulse_bandwidth = 60e3;
  return scenario;
}

double decibels(double ratio) {
  return 10 * std::log10(ratio);
}

// The floor's echo in one look: mu h^2 psi r^-5 times the equivalent length of the pulse, whatever the bin: c / (2 B)
// for the chirp, 1.5 of it with a Hann window, c tau / 3 for a matched tone of 30 us. Bins from 1 to 8 cells.
TEST(CoarseBinTest, ExtendedEchoDoesNotGrowWithTheBin) {
  for (const Method& method : {kRays, kReference}) {
    for (const BeamPattern pattern : {BeamPattern::kTopHat, BeamPattern::kRectangular}) {
      for (const auto& [kind, window, length] : {std::tuple{PulseKind::kLfm, PulseWindow::kRectangular, kCell},
                                                 {PulseKind::kLfm, PulseWindow::kHann, 1.5 * kCell},
                                                 {PulseKind::kCw, PulseWindow::kRectangular, kSpeed * 30e-6 / 3}}) {
        for (const int cells : {1, 2, 8}) {
          for (const Decimation decimation : {Decimation::kSample, Decimation::kPeak, Decimation::kMean}) {
            Scenario scenario = scenario_of(cells, method);
            scenario.receiver.azimuth_pattern = pattern;
            scenario.receiver.decimation = decimation;
            scenario.receiver.pulse = kind;
            scenario.receiver.pulse_window = window;
            if (kind == PulseKind::kCw) {
              scenario.receiver.pulse_duration = 30e-6;
            }
            const Ping ping = ping_of(scenario, seabed_at(-3, diffuse(-27)));
            const int bin = ping.bin_count / 2;
            const double range = scenario.sonars[0].bin_range(bin);
            const double psi = (pattern == BeamPattern::kTopHat ? 1 : 1 / 0.8858929) * kDegree;
            EXPECT_NEAR(cell_db(ping, bin, 12), decibels(std::pow(10, -2.7) * 9 * psi * length / std::pow(range, 5)),
                        0.15)
                << method.name << ", " << static_cast<int>(kind) << ", " << cells;
          }
        }
      }
    }
  }
}

// A point keeps its level, whatever the bin; averaged over a bin of n looks it has 1 / n of it. A plate of 4 mm, turned
// towards the sonar, is shorter in range than the pulse: it is received as a point is, beside the floor too.
TEST(CoarseBinTest, CompactEchoKeepsItsLevel) {
  for (const int cells : {1, 2, 6}) {
    for (const auto& [decimation, share] :
         {std::pair{Decimation::kSample, 1.0}, {Decimation::kPeak, 1.0}, {Decimation::kMean, 1.0 / cells}}) {
      Scenario scenario = scenario_of(cells);
      scenario.receiver.decimation = decimation;
      scenario.sonars[0].elevation_center = 0;
      const double range = scenario.sonars[0].bin_range(scenario.sonars[0].bin_count / 2);
      scenario.points = {{.position = {range * std::cos(0.5 * kDegree), -range * std::sin(0.5 * kDegree), 0}}};
      const Ping point = ping_of(scenario, {});
      EXPECT_NEAR(cell_db(point, point.bin_count / 2, 12), -40 * std::log10(range) + decibels(share), 0.01) << cells;

      scenario.points.clear();
      scenario.sonars[0].sampling = {32, 1600};
      const Scene plate = plate_at(range, 0.05, diffuse(-10));
      double level = 0;
      for (const double sum : by_range(ping_of(scenario, plate))) {
        level = std::max(level, sum);
      }
      EXPECT_NEAR(decibels(level), decibels(0.1 * 0.0025 * std::pow(range, -4) * share), 0.4) << cells;
    }
  }
}

// The level of a shiny ball does not depend on where its front lies in a bin. Its echo is some millimetres deep, more
// at the default sampling. Bins of 30 and 60 mm; a tone of 25 us is 12.5 mm long after its filter. On the edge of two
// bins (1 + ln n) / n is left, 1.1 dB less for n = 2.4 (without it, 3.8 dB less).
TEST(CoarseBinTest, BallsKeepTheirLevelWhereverTheyLieInABin) {
  for (const double radius : {0.1, 0.25}) {
    for (const double bin : {0.03, 0.06}) {
      SonarConfig sonar;
      sonar.beam_count = 32;
      sonar.azimuth_aperture = 15 * kDegree;
      sonar.elevation_aperture = 6 * kDegree;
      sonar.min_range = 22;
      sonar.bin_count = 150;
      sonar.max_range = 22 + 150 * bin;
      Scenario scenario = calibrated(sonar, kRays);
      scenario.water.sound_speed = kSpeed;
      scenario.receiver.pulse = PulseKind::kCw;
      scenario.receiver.pulse_duration = 25e-6;
      const double distance = 22.6 + radius, looks = bin / 0.0125;
      Simulator simulator(scenario, sphere_at({distance, 0, 0}, radius, glinting(0.9, 0.05), 0.1), 2);
      const double expected = 20 * std::log10(0.9 * radius / 2) - 40 * std::log10(distance - radius);
      for (int i = 0; i < 12; ++i) {
        PingRequest request;
        request.world_from_vehicle.position = {i * bin / 12, 0.011 * (i - 6), 0.007 * (i - 6)};
        const double level = total_db(simulator.ping(0, request));
        EXPECT_GT(level, expected + decibels((1 + std::log(looks)) / looks) - 0.5)
            << radius << ", " << bin << ", " << i;
        EXPECT_LT(level, expected + 0.5) << radius << ", " << bin << ", " << i;
      }
    }
  }
}

// Means, contrast and tail of the intensities of a floor's speckle, over their mean without it.
struct Statistics {
  double mean, contrast, tail;
};
Statistics statistics_of(const std::vector<double>& values) {
  double sum = 0, squares = 0, above = 0;
  for (const double value : values) {
    sum += value, squares += value * value, above += value > 4 ? 1 : 0;
  }
  const double n = static_cast<double>(values.size()), mean = sum / n;
  return {mean, std::sqrt(squares / n / (mean * mean) - 1), above / n};
}

// Intensities over the expected ones: of coarse bins, or of fine ones of one look each, decimated here by `keep`.
std::vector<double> decimated(Scenario scenario, int group,
                              const std::function<double(const std::vector<double>&)>& keep) {
  const Scene scene = seabed_at(-3, diffuse(-20));
  const Ping ping = ping_of(scenario, scene);
  scenario.receiver.speckle = scenario.receiver.noise = false;
  const Ping mean = ping_of(scenario, scene);
  std::vector<double> kept;
  for (int bin = group; bin + 2 * group <= ping.bin_count; bin += group) {
    for (int beam = 1; beam + 1 < ping.beam_count; ++beam) {
      std::vector<double> looks;
      for (int i = bin; i < bin + group; ++i) {
        looks.push_back(ping.intensity[ping.index(i, beam)] / mean.intensity[mean.index(i, beam)]);
      }
      kept.push_back(keep(looks));
    }
  }
  return kept;
}

// Brute force: bins as long as the resolution, whose looks are independent, decimated here; and the closed forms. The
// greatest of n exponential numbers has the mean H_n = 1 + 1/2 + ... + 1/n and the variance 1 + 1/4 + ... + 1/n^2; the
// mean of n has the contrast 1 / sqrt(n).
TEST(CoarseBinTest, StatisticsAreThoseOfDecimatedFineBins) {
  const auto greatest = [](const std::vector<double>& looks) { return *std::ranges::max_element(looks); };
  const auto average = [](const std::vector<double>& looks) {
    double sum = 0;
    for (const double look : looks) {
      sum += look / static_cast<double>(looks.size());
    }
    return sum;
  };
  const auto first = [](const std::vector<double>& looks) { return looks[0]; };
  for (const BeamPattern pattern : {BeamPattern::kTopHat, BeamPattern::kTaylor}) {
    for (const int n : {3, 6}) {
      const Scenario fine_bins = [&] {
        Scenario scenario = scenario_of(1, kRays, 1440);
        scenario.receiver.azimuth_pattern = pattern;
        scenario.receiver.speckle = true;
        return scenario;
      }();
      double harmonic = 0, squares = 0;
      for (int k = 1; k <= n; ++k) {
        harmonic += 1.0 / k, squares += 1.0 / (k * k);
      }
      for (const auto& [decimation, keep, mean, contrast] :
           {std::tuple{Decimation::kPeak, std::function<double(const std::vector<double>&)>(greatest), harmonic,
                       std::sqrt(squares) / harmonic},
            {Decimation::kMean, average, 1.0, 1 / std::sqrt(n)},
            {Decimation::kSample, first, 1.0, 1.0}}) {
        Scenario coarse = scenario_of(n, kRays, 1440);
        coarse.receiver.azimuth_pattern = pattern;
        coarse.receiver.speckle = true;
        coarse.receiver.decimation = decimation;
        const Statistics here = statistics_of(decimated(coarse, 1, first));
        const Statistics brute = statistics_of(decimated(fine_bins, n, keep));
        // Five beams of 24 overlap with Taylor's window: some 1440 / n x 11 independent bins.
        const double error = 1 / std::sqrt(1440.0 / n * 11);
        for (const Statistics& result : {here, brute}) {
          EXPECT_NEAR(result.mean, mean, 4 * error * mean * contrast) << static_cast<int>(decimation) << ", " << n;
          EXPECT_NEAR(result.contrast, contrast, 4 * error) << static_cast<int>(decimation) << ", " << n;
        }
        EXPECT_NEAR(here.tail, brute.tail, 6 * error * std::sqrt(std::max(brute.tail, 1e-3))) << n;
      }
    }
  }
}

// Noise alone: mean H_n of the greatest of n, unchanged in the mean of n and in one look, with speckle or without.
TEST(CoarseBinTest, NoiseIsDecimatedToo) {
  for (const auto& [decimation, mean] : {std::pair{Decimation::kPeak, 1 + 1 / 2.0 + 1 / 3.0 + 1 / 4.0},
                                         {Decimation::kMean, 1.0},
                                         {Decimation::kSample, 1.0}}) {
    for (const bool speckle : {true, false}) {
      Scenario scenario = scenario_of(4, kRays, 8000);
      scenario.receiver.noise = true;
      scenario.receiver.speckle = speckle;
      scenario.receiver.decimation = Decimation::kSample;
      const double look = total_db(ping_of(scenario, {}));
      scenario.receiver.decimation = decimation;
      EXPECT_NEAR(total_db(ping_of(scenario, {})) - look, decibels(mean), 0.1) << static_cast<int>(decimation);
    }
  }
}

}  // namespace
}  // namespace insonify::validation::coarse_bin_test
