// bearing_response_test.cpp -- beams formed from a bearing grid: discrete echoes, side lobes, correlation of speckle
// between beams, and the matrix product by brute force. T numbers are those of docs/concepts/physics-tests.md.

#include "receiver/array/bearing_response.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "insonify/geometry.h"

namespace insonify::bearing_response_test {
namespace {

// A fan of 120 degrees in 256 beams, 0.46875 degrees apart, and an array with a beam of 1 degree at 720 kHz.
constexpr double kAperture = radians_from_degrees(120);
constexpr double kWavelength = 1500.0 / 720e3;

double length_in_wavelengths(const ArrayPattern& pattern, double beam_width_deg = 1) {
  return pattern.length(kWavelength, radians_from_degrees(beam_width_deg)) / kWavelength;
}

// u = sin(azimuth) of `count` bearings, evenly spaced in azimuth over the fan, from port to starboard.
std::vector<double> fan(int count, double aperture = kAperture) {
  std::vector<double> sines;
  for (int i = 0; i < count; ++i) {
    sines.push_back(std::sin(aperture * (0.5 - (i + 0.5) / count)));
  }
  return sines;
}

std::vector<float> receive(const BearingResponse& response, const std::vector<float>& cells, int bins) {
  std::vector<float> beams(static_cast<std::size_t>(response.beam_count()) * bins, 99.0F);
  response.receive_energy(cells, beams, bins, {0, bins}, {0, bins});
  return beams;
}

using Field = std::vector<std::complex<float>>;

Field receive(const BearingResponse& response, const Field& cells, int bins) {
  Field beams(static_cast<std::size_t>(response.beam_count()) * bins, 99.0F);
  response.receive_field(cells, beams, bins, {0, bins}, {0, bins});
  return beams;
}

Field white_noise(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal(0, std::sqrt(0.5F));
  Field field(count);
  for (auto& value : field) {
    const float real = normal(random);
    value = {real, normal(random)};
  }
  return field;
}

float decibels(float intensity) {
  return 10 * std::log10(intensity);
}

// Relative tolerance for sums over some hundred cells in single precision.
constexpr double kSinglePrecision = 1e-5;

// Odd numbers of beams, cells and bins, so that every block, panel and strip has an incomplete one.
TEST(BearingResponseTest, IsTheSumOverCells) {
  constexpr int kBeams = 21, kCells = 301, kBins = 37;
  const std::vector<double> cells = fan(kCells), beams = fan(kBeams);
  for (const ArraySettings& settings : {ArraySettings{.window = ArrayWindow::kHann},
                                        ArraySettings{.elements = 90, .element_error_db = 2, .element_error = 0.4}}) {
    const ArrayPattern pattern(settings);
    const BearingResponse response(pattern, 40, cells, beams, -300);
    const Field field = white_noise(kCells * kBins, 1);
    std::vector<float> energy;
    for (const std::complex<float> value : field) {
      energy.push_back(std::norm(value));
    }
    const std::vector<float> received_energy = receive(response, energy, kBins);
    const Field received_field = receive(response, field, kBins);
    for (int beam = 0; beam < kBeams; ++beam) {
      for (int bin = 0; bin < kBins; ++bin) {
        double sum = 0;
        std::complex<double> complex_sum = 0;
        for (int cell = 0; cell < kCells; ++cell) {
          const std::complex<double> gain = pattern.amplitude(40 * (cells[cell] - beams[beam]));
          sum += std::norm(gain) * energy[cell * kBins + bin];
          complex_sum += gain * std::complex<double>(field[cell * kBins + bin]);
        }
        ASSERT_NEAR(received_energy[beam * kBins + bin] / sum, 1, kSinglePrecision);
        ASSERT_NEAR(std::abs(std::complex<double>(received_field[beam * kBins + bin]) - complex_sum), 0,
                    kSinglePrecision);
      }
    }
  }
}

TEST(BearingResponseTest, DoesNotDependOnHowBinsAreDividedBetweenCalls) {
  constexpr int kBeams = 16, kCells = 64, kBins = 50;
  const ArrayPattern pattern({.elements = 32, .element_error = 0.1});
  const BearingResponse response(pattern, 20, fan(kCells), fan(kBeams));
  const Field field = white_noise(kCells * kBins, 2);
  Field shared(kBeams * kBins);
  response.receive_field(field, shared, kBins, {0, 7}, {0, kBins});
  response.receive_field(field, shared, kBins, {31, 50}, {0, kBins});
  response.receive_field(field, shared, kBins, {7, 31}, {0, kBins});
  EXPECT_EQ(shared, receive(response, field, kBins));
}

TEST(BearingResponseTest, EmptyBinsNeedNotBeSummed) {
  constexpr int kBeams = 16, kCells = 64, kBins = 50;
  const ArrayPattern pattern({.elements = 32, .element_error = 0.1});
  const BearingResponse response(pattern, 20, fan(kCells), fan(kBeams));
  Field field = white_noise(kCells * kBins, 2);
  for (int i = 0; i < kCells * kBins; ++i) {
    field[i] = i % kBins >= 21 && i % kBins < 40 ? field[i] : 0;
  }
  Field received(kBeams * kBins, 7);
  response.receive_field(field, received, kBins, {0, 30}, {21, 40});
  response.receive_field(field, received, kBins, {30, 45}, {21, 40});
  response.receive_field(field, received, kBins, {45, 50}, {21, 40});
  EXPECT_EQ(received, receive(response, field, kBins));
}

// One cell at the bearing of each beam.
TEST(BearingResponseTest, DiscreteEchoReadsItsFullLevelInItsOwnBeam) {
  constexpr int kBeams = 64;
  const ArrayPattern pattern;
  const BearingResponse response(pattern, length_in_wavelengths(pattern), fan(kBeams), fan(kBeams));
  std::vector<float> cells(kBeams, 0.0F);
  cells[20] = 5;
  EXPECT_FLOAT_EQ(receive(response, cells, 1)[20], 5);
}

// T14. A strong echo leaks into all beams. The first side lobes of a rectangular window are at -13.26 dB, where u is
// 1.4303 wavelengths / D from the echo's: for an echo at 20 degrees and D = 0.1058 m, at 18.2918 and 21.7270 degrees.
// Beams 0.01 degrees apart sample the pattern.
TEST(BearingResponseTest, SideLobesHaveTheAnglesAndLevelsOfTheClosedForm) {
  constexpr double kLength = 0.1058 / kWavelength;
  const struct {
    ArraySettings settings;
    double echo_deg, lobe_deg, other_lobe_deg, level_db;
  } cases[] = {
      {{}, 0, 1.6138, -1.6138, -13.2615},
      {{}, 20, 21.7270, 18.2918, -13.2615},
      {{.two_way = true}, 20, 21.7270, 18.2918, -26.523},
      // The first side lobe of a Hann window is 2.3619 wavelengths / D from the main lobe.
      {{.window = ArrayWindow::kHann}, 0, 2.6659, -2.6659, -31.4675},
  };
  std::vector<double> beams;
  for (int i = 0; i <= 8000; ++i) {
    beams.push_back(std::sin(radians_from_degrees(40 - i * 0.01)));
  }
  const auto near_lobe = [](double from_deg, double to_deg, const std::vector<float>& received) {
    int highest = std::lround((40 - to_deg) * 100);
    for (int i = highest; i <= std::lround((40 - from_deg) * 100); ++i) {
      highest = received[i] > received[highest] ? i : highest;
    }
    return std::pair{40 - highest * 0.01, decibels(received[highest])};
  };
  for (const auto& c : cases) {
    const std::vector<double> cell = {std::sin(radians_from_degrees(c.echo_deg))};
    const std::vector<float> received =
        receive(BearingResponse(ArrayPattern(c.settings), kLength, cell, beams), std::vector<float>{1}, 1);
    for (const double lobe_deg : {c.lobe_deg, c.other_lobe_deg}) {
      const auto [bearing_deg, level_db] = near_lobe(lobe_deg - 0.4, lobe_deg + 0.4, received);
      EXPECT_NEAR(bearing_deg, lobe_deg, 0.011) << c.level_db;
      EXPECT_NEAR(level_db, c.level_db, 0.01);
    }
  }
}

// Correlation of speckle between neighbouring beams (docs/concepts/speckle.md). For white circular noise, the
// intensities of two beams x = (D / wavelength) (u1 - u2) apart have the correlation r = sinc^2(x). Beams 0.46875
// degrees apart near the axis have x = 0.41547 and r = 0.5465; each beam adds x independent samples. With 12 beams near
// the axis, where x is nearly constant, and many bins, the standard error of r is below (1 - r^2) / sqrt(n_eff).
TEST(BearingResponseTest, SpeckleOfNeighbouringBeamsCorrelates) {
  constexpr int kBeams = 13, kPerBeam = 4, kMargin = 60, kBins = 4000;
  constexpr double kSpacing = radians_from_degrees(0.46875);
  const ArrayPattern pattern;
  const double length = length_in_wavelengths(pattern);
  std::vector<double> cells, beams;
  for (int beam = 0; beam < kBeams; ++beam) {
    beams.push_back(std::sin((kBeams / 2 - beam) * kSpacing));
  }
  for (int cell = 0; cell < (kBeams + 2 * kMargin) * kPerBeam; ++cell) {
    cells.push_back(std::sin((kBeams / 2.0 + kMargin + 0.5 - (cell + 0.5) / kPerBeam) * kSpacing));
  }
  const BearingResponse response(pattern, length, cells, beams, -300);
  const Field received = receive(response, white_noise(cells.size() * kBins, 3), kBins);

  const auto correlation = [&](int lag) {
    double mean = 0, square = 0, product = 0;
    const int pairs = (kBeams - lag) * kBins;
    for (int i = 0; i < pairs; ++i) {
      const double a = std::norm(received[i]), b = std::norm(received[i + lag * kBins]);
      mean += 0.5 * (a + b) / pairs;
      square += 0.5 * (a * a + b * b) / pairs;
      product += a * b / pairs;
    }
    return (product - mean * mean) / (square - mean * mean);
  };
  constexpr double kIndependent = 0.41547099364634316 * (kBeams - 1) * kBins;
  const double tolerance = 4 / std::sqrt(kIndependent);
  EXPECT_NEAR(correlation(1), 0.5465445707912471, tolerance);
  EXPECT_NEAR(correlation(2), 0.0377, tolerance);
  EXPECT_NEAR(correlation(3), 0.0319, tolerance);
}

// Phases are independent between cells, so the received energy is the mean of |received field|^2 over many draws. The
// mean of n exponentially distributed numbers of mean 1 has the standard error 1 / sqrt(n).
TEST(BearingResponseTest, EnergyIsTheMeanOfTheField) {
  constexpr int kBeams = 8, kCells = 64, kDraws = 20000;
  for (const ArraySettings& settings :
       {ArraySettings{}, ArraySettings{.elements = 64, .element_error_db = 3, .element_error = 0.5, .two_way = true}}) {
    const ArrayPattern pattern(settings);
    const BearingResponse response(pattern, 10, fan(kCells), fan(kBeams));
    Field cells = white_noise(kCells * kDraws, 4);
    std::vector<float> energy(kCells);
    for (int cell = 0; cell < kCells; ++cell) {
      energy[cell] = 1 + cell % 5;
      for (int draw = 0; draw < kDraws; ++draw) {
        cells[cell * kDraws + draw] *= std::sqrt(energy[cell]);
      }
    }
    const std::vector<float> expected = receive(response, energy, 1);
    const Field received = receive(response, cells, kDraws);
    for (int beam = 0; beam < kBeams; ++beam) {
      double mean = 0;
      for (int draw = 0; draw < kDraws; ++draw) {
        mean += std::norm(received[beam * kDraws + draw]) / kDraws;
      }
      EXPECT_NEAR(mean / expected[beam], 1, 4 / std::sqrt(kDraws));
    }
  }
}

// T17, without speckle: two equal echoes in one cell give twice the energy of one.
TEST(BearingResponseTest, EnergiesOfOneCellAddUp) {
  const ArrayPattern pattern;
  const BearingResponse response(pattern, 50, fan(32), fan(8));
  std::vector<float> one(32, 0.0F), two(32, 0.0F);
  one[9] = 3;
  two[9] = 6;
  const std::vector<float> received = receive(response, one, 1), twice = receive(response, two, 1);
  for (int beam = 0; beam < 8; ++beam) {
    EXPECT_FLOAT_EQ(twice[beam], 2 * received[beam]);
  }
}

// Energy spread evenly over u gives its density times the equivalent beam width, wavelength / D. With cells of 0.002 in
// u and an array of 50 wavelengths this is (1 / 50) / 0.002 = 10 cells. The fraction 1 / (pi^2 50) of the energy of a
// sinc^2 pattern lies beyond u = +-1 and is not received. The floor of -60 dB, 318 lobes out, is beyond that too.
TEST(BearingResponseTest, ExtendedEchoReadsTheEquivalentBeamWidth) {
  std::vector<double> cells;
  for (int i = 0; i < 1000; ++i) {
    cells.push_back(0.999 - 0.002 * i);
  }
  const ArrayPattern pattern;
  const std::vector<double> ahead = {0.0};
  const BearingResponse response(pattern, 50, cells, ahead);
  const double expected = (1.0 / 50) / 0.002 * (1 - 1 / (9.8696 * 50));
  EXPECT_NEAR(receive(response, std::vector<float>(1000, 1.0F), 1)[0], expected, 1e-3);
}

// The side lobes of a Hann window fall below -60 dB within 4 to 7 lobes, so that of all cells of the fan only a small
// part is summed. What is left out is less than the floor times the energy of all cells.
TEST(BearingResponseTest, FloorLeavesOutNegligibleCells) {
  const ArrayPattern pattern({.window = ArrayWindow::kHann});
  const double length = length_in_wavelengths(pattern);
  const BearingResponse response(pattern, length, fan(512), fan(256)), full(pattern, length, fan(512), fan(256), -300);
  EXPECT_LT(response.filled(), 0.2);
  EXPECT_EQ(full.filled(), 1);
  const std::vector<float> cells(512, 1.0F), received = receive(response, cells, 1), all = receive(full, cells, 1);
  for (int beam = 0; beam < 256; ++beam) {
    EXPECT_NEAR(received[beam] / all[beam], 1, 1e-5);
  }
}

// Beams in three zones of bins against the exact patterns of their edge phases. Tables are within 0.01 rad, or 1 % of a
// phase, of these: at most 0.02 rad at the ends of the array, and less elsewhere.
TEST(BearingResponseTest, OutOfFocusIsTheSumOverCells) {
  constexpr int kBeams = 37, kCells = 301, kBins = 41;
  constexpr double kLength = 40, kTolerance = 0.02;
  constexpr BearingResponse::Zone kZones[] = {{7, 2.0}, {30, 0}, {41, -0.6}};
  const std::vector<double> cells = fan(kCells), beams = fan(kBeams);
  for (const bool faulty : {false, true}) {
    ArraySettings settings{.window = ArrayWindow::kTaylor, .elements = faulty ? 96 : 0};
    settings.element_error = faulty ? 0.3 : 0;
    const ArrayPattern pattern(settings, 3);
    const BearingResponse::Extras extras{.zones = {std::begin(kZones), std::end(kZones)},
                                         .elements = settings.elements};
    const BearingResponse response(pattern, kLength, cells, beams, -60, extras);
    for (const int lit : {0, 40, 150, 299}) {
      std::vector<float> energy(kCells * kBins);
      Field field(kCells * kBins);
      std::fill_n(energy.begin() + lit * kBins, kBins, 1.0F);
      std::fill_n(field.begin() + lit * kBins, kBins, 1.0F);
      const std::vector<float> received = receive(response, energy, kBins);
      const Field received_field = receive(response, field, kBins);
      for (int beam = 0; beam < kBeams; ++beam) {
        for (const int bin : {0, 6, 7, 29, 30, 40}) {
          const double phase =
              std::ranges::find_if(kZones, [&](const auto& zone) { return bin < zone.end; })->edge_phase;
          const double steered = beams[beam], x = kLength * (cells[lit] - steered);
          const std::complex<double> exact = pattern.defocused(phase * (1 - steered * steered)).amplitude(x);
          const std::complex<double> found = received_field[beam * kBins + bin];
          if (std::norm(exact) > 2e-6) {
            ASSERT_NEAR(std::abs(found - exact), 0, kTolerance) << beam << " " << bin << " " << lit;
            ASSERT_NEAR(received[beam * kBins + bin], std::norm(found), 1e-6);
            ASSERT_NEAR(std::abs(response.gain(beam, cells[lit], bin) - found), 0, 1e-5);  // Single precision.
          }
        }
      }
    }
  }
}

// Gains that are kept and those that each ping looks up are the same; of three zones out of focus one, or none, is
// kept.
TEST(BearingResponseTest, GainsThatAreKeptAreThoseLookedUp) {
  constexpr int kBeams = 21, kCells = 150, kBins = 24;
  const std::vector<double> cells = fan(kCells), beams = fan(kBeams);
  std::vector<double> edges;
  for (int edge = 0; edge <= kCells; ++edge) {  // The last ten cells are wide.
    edges.push_back((edge == 0 ? 1.0 : cells[edge - 1]) - (edge > kCells - 10 ? 0.004 * (edge - kCells + 10) : 0.0));
  }
  const ArrayPattern pattern({.window = ArrayWindow::kHann});
  const auto with_most = [&](std::size_t most) {
    return BearingResponse(
        pattern, 33, cells, beams, -60,
        {.cell_edges = edges, .zones = {{5, 3.0}, {11, 0.8}, {17, 0}, {24, -0.4}}, .most_kept = most});
  };
  const std::size_t of_zone = 3UL * 24 * kCells;  // Three matrices, of beams in eights.
  const BearingResponse all = with_most(BearingResponse::kMostKept), one = with_most(2 * of_zone - 1),
                        none = with_most(0);
  EXPECT_EQ(all.kept(), 3 * of_zone);
  EXPECT_EQ(one.kept(), of_zone);
  EXPECT_EQ(none.kept(), 0U);
  EXPECT_TRUE(all.keeps_all());
  EXPECT_FALSE(one.keeps_all());
  std::vector<float> energy(kCells * kBins);
  Field field(kCells * kBins);
  for (std::size_t i = 0; i < energy.size(); ++i) {
    energy[i] = static_cast<float>(1 + i % 7);
    field[i] = {static_cast<float>(i % 5), static_cast<float>(i % 3)};
  }
  for (const BearingResponse* other : {&one, &none}) {
    EXPECT_EQ(receive(*other, energy, kBins), receive(all, energy, kBins));
    EXPECT_EQ(receive(*other, field, kBins), receive(all, field, kBins));
  }
}

// Beams as narrow as their spacing, from 128 to 1024 of them: the array is as long as there are beams, and its edge
// phases as large. Matrices of all zones would need 60 x 1024 x 2048 x 3 numbers.
TEST(BearingResponseTest, MemoryOutOfFocusGrowsWithTheBeams) {
  const auto values_of = [](int count) {
    std::vector<BearingResponse::Zone> zones;
    for (double phase = 0.27 * count; phase > 0.06; phase *= 0.95) {
      zones.push_back({static_cast<int>(zones.size()) + 1, phase});
    }
    const BearingResponse response(ArrayPattern(), 0.42 * count, fan(2 * count), fan(count), -60, {.zones = zones});
    EXPECT_LE(response.kept(), BearingResponse::kMostKept);
    return static_cast<double>(response.defocused()->value_count());
  };
  const double few = values_of(128), many = values_of(1024);
  EXPECT_LT(many, 5e6);
  EXPECT_LT(many / few, 1024 / 128 * 1.6);
}

}  // namespace
}  // namespace insonify::bearing_response_test
