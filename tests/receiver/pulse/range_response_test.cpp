// range_response_test.cpp -- convolution with the pulse along range: discrete and extended echoes, two plates, and the
// sum by brute force. T numbers are those of docs/concepts/physics-tests.md.

#include "receiver/pulse/range_response.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace insonify::range_response_test {
namespace {

constexpr double kSoundSpeed = 1500;

Pulse tone(double duration, bool matched_filter = true) {
  return {{.kind = PulseKind::kCw, .duration = duration, .matched_filter = matched_filter}, kSoundSpeed, 0.1};
}

Pulse chirp(double bandwidth, bool hann = false) {
  return {{.kind = PulseKind::kLfm,
           .duration = 1e-3,
           .bandwidth = bandwidth,
           .window = hann ? PulseWindow::kHann : PulseWindow::kRectangular},
          kSoundSpeed,
          0.1};
}

std::vector<float> receive(const RangeResponse& response, const std::vector<float>& cells) {
  std::vector<float> bins(cells.size() / response.cells_per_bin());
  response.receive_energy(cells, bins);
  return bins;
}

using Field = std::vector<std::complex<float>>;

Field receive(const RangeResponse& response, const Field& cells) {
  Field bins(cells.size() / response.cells_per_bin());
  response.receive_field(cells, bins);
  return bins;
}

Field white_noise(std::size_t count) {
  std::mt19937 random(7);
  std::normal_distribution<float> normal(0, std::sqrt(0.5F));
  Field field(count);
  for (auto& value : field) {
    const float real = normal(random);
    value = {real, normal(random)};
  }
  return field;
}

constexpr double kSinglePrecision = 1e-5;

// Rows of odd lengths, pulses shorter and longer than the blocks that the convolution works on, and one or several
// cells per bin.
TEST(RangeResponseTest, IsTheConvolution) {
  const Pulse pulse = chirp(30e3);  // Range resolution 25 mm; side lobes to 0.75 m.
  for (const double bin_length : {0.1, 0.011, 0.004}) {
    for (const int cells_per_bin : {1, 3, 5}) {
      constexpr int kBins = 151;
      const double cell_length = bin_length / cells_per_bin;
      const RangeResponse response(pulse, bin_length, cells_per_bin, -300);
      const Field field = white_noise(static_cast<std::size_t>(kBins) * cells_per_bin);
      std::vector<float> energy;
      for (const std::complex<float> value : field) {
        energy.push_back(std::norm(value));
      }
      const std::vector<float> received_energy = receive(response, energy);
      const Field received_field = receive(response, field);
      for (int bin = 0; bin < kBins; ++bin) {
        double sum = 0;
        std::complex<double> complex_sum = 0;
        for (int cell = 0; cell < kBins * cells_per_bin; ++cell) {
          const double distance = (bin * cells_per_bin + cells_per_bin / 2 - cell) * cell_length;
          sum += pulse.intensity(distance) * energy[cell];
          complex_sum += pulse.amplitude(distance) * std::complex<double>(field[cell]);
        }
        ASSERT_NEAR(received_energy[bin], sum, kSinglePrecision * (1 + sum));
        ASSERT_NEAR(std::abs(std::complex<double>(received_field[bin]) - complex_sum), 0, 10 * kSinglePrecision);
      }
    }
  }
}

TEST(RangeResponseTest, DiscreteEchoReadsItsFullLevelInItsOwnBin) {
  for (const Pulse& pulse : {tone(50e-6), tone(400e-6), tone(400e-6, false), chirp(100e3), chirp(10e3, true)}) {
    for (const int cells_per_bin : {1, 5}) {
      std::vector<float> cells(99 * cells_per_bin, 0.0F);
      cells[33 * cells_per_bin + cells_per_bin / 2] = 7;
      const std::vector<float> bins = receive(RangeResponse(pulse, 0.1, cells_per_bin), cells);
      EXPECT_FLOAT_EQ(bins[33], 7);
      EXPECT_LE(*std::max_element(bins.begin(), bins.end()), 7.00001F);
    }
  }
}

// The matched-filtered tone is a triangle of half width c tau / 2 = 0.3 m, three bins: p^2 is 1, 4/9, 1/9, 0.
TEST(RangeResponseTest, ToneSpreadsAsItsTriangleSquared) {
  std::vector<float> cells(20, 0.0F);
  cells[10] = 9;
  const RangeResponse response(tone(400e-6), 0.1);
  const std::vector<float> bins = receive(response, cells);
  const float expected[] = {0, 1, 4, 9, 4, 1, 0};
  for (int i = 0; i < 7; ++i) {
    EXPECT_NEAR(bins[7 + i], expected[i], 1e-6);
  }
  EXPECT_EQ(response.taps(), 5);
}

TEST(RangeResponseTest, ExtendedEchoReadsTheSumOverThePulse) {
  const RangeResponse response(tone(400e-6), 0.1);
  EXPECT_NEAR(response.equivalent_cells(), 1 + 2 * (4 + 1) / 9.0, 1e-12);
  EXPECT_NEAR(receive(response, std::vector<float>(200, 2.0F))[100], 2 * response.equivalent_cells(), 1e-5);
  // In a fine grid of cells of length d the sum approximates the integral; the error is d^2 / 12 times the change of
  // slope at the peak, 4 / 0.3 m.
  EXPECT_NEAR(RangeResponse(tone(400e-6), 0.1, 99).equivalent_cells() * 0.1 / 99, tone(400e-6).equivalent_length(),
              1.2e-6);
}

// When only part of a row is non-zero, the result is zero outside reached_from(), and convolving that part alone gives
// the same as convolving the whole row.
TEST(RangeResponseTest, PartOfARowReachesNoFartherThanThePulse) {
  constexpr int kBins = 90;
  const RangeResponse response(tone(100e-6), 0.02);
  Field cells(kBins), whole(kBins), part(kBins);
  for (int bin = 40; bin < 55; ++bin) {
    cells[bin] = {1.0F / bin, 0.5F};
  }
  response.receive_field(cells, whole);
  const BinRange received = response.reached_from({40, 55}, kBins);
  EXPECT_LT(received.first, 40);
  EXPECT_GT(received.last, 55);
  const auto within = [&](Field& of_row) {
    return std::span(of_row).subspan(received.first, received.last - received.first);
  };
  response.receive_field(within(cells), within(part));
  EXPECT_EQ(part, whole);
  EXPECT_NE(part[received.first], 0.0F);
  EXPECT_NE(part[received.last - 1], 0.0F);
  EXPECT_TRUE(response.reached_from({7, 7}, kBins).empty());
  EXPECT_EQ(response.reached_from({0, kBins}, kBins).last, kBins);
}

TEST(RangeResponseTest, NoPulseLeavesBinsAsTheyAre) {
  const Pulse none({}, kSoundSpeed, 0.1);
  const std::vector<float> cells = {1, 2, 3, 4, 5, 6};
  EXPECT_EQ(receive(RangeResponse(none, 0.1), cells), cells);
  EXPECT_EQ(receive(RangeResponse(none, 0.1, 3), cells), (std::vector<float>{6, 15}));
}

// Full width at half power of a discrete echo, in bins of 0.1 mm: 0.8859 c / (2 B); and its first side lobe.
TEST(RangeResponseTest, SinglePlateIsAsWideAsThePulse) {
  std::vector<float> cells(1001, 0.0F);
  cells[500] = 1;
  const std::vector<float> bins = receive(RangeResponse(chirp(100e3), 1e-4), cells);
  const auto above = std::count_if(bins.begin(), bins.end(), [](float level) { return level >= 0.5F; });
  EXPECT_NEAR(above * 1e-4, 0.8858929413781328 * 0.0075, 1e-4);
  const float lobe = *std::max_element(bins.begin() + 500 + 75, bins.end());
  EXPECT_NEAR(10 * std::log10(lobe), -13.2615, 0.01);
}

// Depth of the dip between the echoes of two plates 30 mm apart, below their peaks [dB].
double dip_db(const Pulse& pulse) {
  std::vector<float> cells(2001, 0.0F);
  cells[985] = cells[1015] = 1;
  const std::vector<float> bins = receive(RangeResponse(pulse, 1e-3), cells);
  return 10 * std::log10(bins[985] / *std::min_element(bins.begin() + 985, bins.begin() + 1016));
}

// T18. A tone of 50 us is 37.5 mm long; a chirp of 100 kHz resolves 7.5 mm.
TEST(RangeResponseTest, ChirpResolvesTwoPlatesThatAToneDoesNot) {
  EXPECT_LT(dip_db(tone(50e-6)), 3);
  EXPECT_EQ(dip_db(tone(50e-6, false)), 0);
  EXPECT_GT(dip_db(chirp(100e3)), 3);
}

// The mean of n exponentially distributed numbers of mean 1 has the standard error 1 / sqrt(n).
TEST(RangeResponseTest, EnergyIsTheMeanOfTheField) {
  constexpr int kDraws = 20000, kBins = 9;
  const RangeResponse response(tone(400e-6), 0.1);
  const std::vector<float> energy = {1, 2, 0, 0, 5, 1, 1, 3, 0};
  const std::vector<float> expected = receive(response, energy);
  const Field noise = white_noise(kDraws * kBins);
  std::vector<double> mean(kBins);
  for (int draw = 0; draw < kDraws; ++draw) {
    Field cells(noise.begin() + draw * kBins, noise.begin() + (draw + 1) * kBins);
    for (int bin = 0; bin < kBins; ++bin) {
      cells[bin] *= std::sqrt(energy[bin]);
    }
    const Field received = receive(response, cells);
    for (int bin = 0; bin < kBins; ++bin) {
      mean[bin] += std::norm(received[bin]) / kDraws;
    }
  }
  for (int bin = 0; bin < kBins; ++bin) {
    EXPECT_NEAR(mean[bin] / expected[bin], 1, 4 / std::sqrt(kDraws));
  }
}

// Side lobe k of a sinc^2 has the level 1 / (pi (k + 1/2))^2, which falls below -30 dB after the tenth.
TEST(RangeResponseTest, FloorEndsThePulse) {
  const RangeResponse response(chirp(100e3), 0.00075, 1, -30);
  EXPECT_GT(response.taps(), 2 * 90);
  EXPECT_LT(response.taps(), 2 * 100);
}

}  // namespace
}  // namespace insonify::range_response_test
