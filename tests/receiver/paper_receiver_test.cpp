// paper_receiver_test.cpp -- means, gain, near field and noise of the `paper` model, on grids filled by hand.

#include "receiver/paper_receiver.h"

#include <gtest/gtest.h>

#include <cmath>

namespace insonify::paper_receiver_test {
namespace {

// A grid with these sums of energy and weight in every cell, for path orders 1 and 2.
EchoGrid filled_grid(int beams, int bins, float energy1, float weight1, float energy2, float weight2) {
  EchoGrid grid(beams, bins, kPathOrders);
  for (int beam = 0; beam < beams; ++beam) {
    const EchoGrid::Cells first = grid.to_fill(1, beam, {0, bins}), second = grid.to_fill(2, beam, {0, bins});
    std::fill_n(first.energy, bins, energy1);
    std::fill_n(first.weight, bins, weight1);
    std::fill_n(second.energy, bins, energy2);
    std::fill_n(second.weight, bins, weight2);
  }
  return grid;
}

SonarConfig sonar_of(int beams, int bins) {
  SonarConfig sonar;
  sonar.beam_count = beams;
  sonar.bin_count = bins;
  sonar.min_range = 0;
  sonar.max_range = bins * 0.1;
  return sonar;
}

Ping receive(const EchoGrid& grid, const SonarConfig& sonar, const PaperReceiverSettings& settings,
             std::uint64_t number = 0) {
  Ping ping;
  ping.number = number;
  Workers workers(1);
  PaperReceiver(grid, sonar, settings, ping).receive(workers);
  return ping;
}

TEST(PaperReceiverTest, CellIsMeanOfPrimariesPlusMeanOfSecondaries) {
  const Ping ping = receive(filled_grid(3, 5, 0.6F, 2, 0.1F, 0.5F), sonar_of(3, 5), {.noise = false});
  for (const float value : ping.intensity) {
    EXPECT_FLOAT_EQ(value, 0.6F / 2 + 0.1F / 0.5F);
  }
}

TEST(PaperReceiverTest, CellIsClippedAtFullScale) {
  const Ping ping = receive(filled_grid(1, 1, 0.9F, 1, 0.8F, 1), sonar_of(1, 1), {.noise = false});
  EXPECT_EQ(ping.intensity[0], 1.0F);
}

TEST(PaperReceiverTest, GainMultipliesAfterTheSum) {
  SonarConfig sonar = sonar_of(1, 1);
  sonar.gain = 1.5;
  EXPECT_FLOAT_EQ(receive(filled_grid(1, 1, 0.4F, 1, 0, 0), sonar, {.noise = false}).intensity[0], 0.6F);
}

// The near-field ramp is linear from min_range (1 m) to blanking_range (2 m). Bins are 0.1 m long and read the ramp at
// their middle.
TEST(PaperReceiverTest, NearFieldRisesToFullLevelAtBlankingRange) {
  SonarConfig sonar = sonar_of(1, 20);
  sonar.min_range = 1;
  sonar.max_range = 3;
  sonar.blanking_range = 2;
  const Ping ping = receive(filled_grid(1, 20, 1, 1, 0, 0), sonar, {.noise = false});
  EXPECT_NEAR(ping.intensity[0], 0.05, 1e-6);
  EXPECT_NEAR(ping.intensity[4], 0.45, 1e-6);
  EXPECT_EQ(ping.intensity[10], 1);
}

struct Moments {
  double mean = 0, deviation = 0;
};

Moments moments(const std::vector<float>& values) {
  double sum = 0, squares = 0;
  for (const float value : values) {
    sum += value;
    squares += double{value} * value;
  }
  const double mean = sum / static_cast<double>(values.size());
  return {mean, std::sqrt(squares / static_cast<double>(values.size()) - mean * mean)};
}

// Mean and standard deviation of I x N(1, s) + N(0, a), clipped at 0; the reference values were computed by quadrature.
// With 400 x 1000 independent cells, the standard error of the mean is deviation / 632; that of the deviation is
// similar.
TEST(PaperReceiverTest, NoiseHasTheReferenceMoments) {
  struct Case {
    float intensity;
    double multiplicative, additive, mean, deviation;
  };
  for (const Case& c : {Case{0.5F, 0.2, 0.05, 0.5000000889236312, 0.11180298357746926},
                        Case{0.0F, 0.2, 0.05, 0.019947114020071637, 0.02919096850517745},
                        Case{0.1F, 0.5, 0.1, 0.11134368551568563, 0.09443314401117761}}) {
    const PaperReceiverSettings settings{
        .model = {.multiplicative_deviation = c.multiplicative, .additive_deviation = c.additive}, .seed = 5};
    const Moments found =
        moments(receive(filled_grid(400, 1000, c.intensity, 1, 0, 0), sonar_of(400, 1000), settings).intensity);
    EXPECT_NEAR(found.mean, c.mean, 4 * c.deviation / 632) << c.intensity;
    EXPECT_NEAR(found.deviation, c.deviation, 4 * c.deviation / 632) << c.intensity;
  }
}

// Noise of neighbouring bins, beams and pings is uncorrelated: the correlation of n = 1e5 pairs is below 4 / sqrt(n) =
// 0.013.
TEST(PaperReceiverTest, NoiseIsIndependentBetweenBinsBeamsAndPings) {
  const int beams = 200, bins = 500;
  const EchoGrid grid = filled_grid(beams, bins, 0.5F, 1, 0, 0);
  const PaperReceiverSettings settings{.model = {.multiplicative_deviation = 0.1, .additive_deviation = 0}, .seed = 9};
  const Ping a = receive(grid, sonar_of(beams, bins), settings, 0);
  const Ping b = receive(grid, sonar_of(beams, bins), settings, 1);
  const auto correlation = [&](const Ping& x, int shift, const Ping& y) {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i + shift < x.intensity.size(); ++i) {
      sum += (x.intensity[i] - 0.5) * (y.intensity[i + shift] - 0.5);
      ++count;
    }
    return sum / count / (0.05 * 0.05);
  };
  EXPECT_NEAR(correlation(a, 0, a), 1, 0.03);
  EXPECT_NEAR(correlation(a, 1, a), 0, 0.013);
  EXPECT_NEAR(correlation(a, beams, a), 0, 0.013);
  EXPECT_NEAR(correlation(a, 2 * beams, a), 0, 0.013);
  EXPECT_NEAR(correlation(a, 0, b), 0, 0.013);
}

TEST(PaperReceiverTest, EmptyCellsHaveNoLabelAndNoElevation) {
  const Ping ping = receive(EchoGrid(2, 2, kPathOrders), sonar_of(2, 2), {.noise = false});
  EXPECT_EQ(ping.instance[3], kNoLabel);
  EXPECT_EQ(ping.material[3], kNoLabel);
  EXPECT_TRUE(std::isnan(ping.elevation[3]));
}

}  // namespace
}  // namespace insonify::paper_receiver_test
