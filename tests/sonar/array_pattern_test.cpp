// array_pattern_test.cpp -- beam patterns against closed forms and independently computed values (formulas in
// docs/concepts/array-and-pulse.md), and the statistics of faulty elements.

#include "insonify/array_pattern.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "insonify/error.h"
#include "insonify/geometry.h"
#include "sonar/window.h"
#include "support/relative.h"

namespace insonify::array_pattern_test {
namespace {

using std::numbers::pi;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double kSoundSpeed = 1500;

double decibels(double intensity) {
  return 10 * std::log10(intensity);
}

double level_db(const ArrayPattern& pattern, double x) {
  return decibels(pattern.intensity(x));
}

TEST(ArrayPatternTest, ContinuousLineIsASinc) {
  const ArrayPattern line;
  EXPECT_EQ(line.amplitude(0), 1.0);
  for (const double x : {0.1, 0.5, 1.43, 7.77, -2.2}) {
    EXPECT_NEAR(line.amplitude(x).real(), std::sin(pi * x) / (pi * x), 1e-15);
    EXPECT_EQ(line.amplitude(x).imag(), 0);
  }
  EXPECT_NEAR(line.intensity(3), 0, 1e-30);
}

// Halves of a uniform line reach from -1/2 to 0 and from 0 to 1/2: their difference is (1 - cos pi x) / (pi x).
TEST(ArrayPatternTest, HalvesOfALineDifferByTheClosedForm) {
  const ArrayPattern line;
  EXPECT_EQ(line.difference(0), 0);
  for (const double x : {0.03, 0.41, 1.0, 1.77, 5.3, -0.62}) {
    EXPECT_NEAR(line.difference(x), (1 - std::cos(pi * x)) / (pi * x), 1e-9) << x;
  }
}

// Whatever the window: a source at x reaches the halves as sum -+ i difference, by quadrature over the window.
TEST(ArrayPatternTest, HalvesAreThoseOfTheWindow) {
  for (const ArrayWindow window : {ArrayWindow::kHann, ArrayWindow::kHamming, ArrayWindow::kTaylor}) {
    const ArrayPattern array({.window = window});
    for (const double x : {0.2, 0.9, 2.3, -1.4}) {
      const double at = array.difference(x);
      EXPECT_NEAR(array.difference(-x), -at, 1e-9);
      // The window is the transform of the pattern.
      constexpr int kSteps = 400;
      constexpr double kReach = 60;
      double half = 0;
      for (int i = 0; i < kSteps; ++i) {
        const double place = 0.5 * (i + 0.5) / kSteps;
        double taper = 0;
        for (double u = -kReach; u <= kReach; u += 0.125) {
          taper += 0.125 * array.amplitude(u).real() * std::cos(2 * pi * u * place);
        }
        half += taper * std::sin(2 * pi * x * place) * 0.5 / kSteps;
      }
      EXPECT_NEAR(at, 2 * half, 4e-3) << x;
    }
  }
}

TEST(ArrayPatternTest, LineHasTheReferenceLobes) {
  const ArrayPattern line;
  EXPECT_THAT(line.width(), RelativelyNear(0.8858929413781328));
  // The position of a peak is accurate only to the square root of the rounding error of its height.
  EXPECT_NEAR(line.highest_side_lobe().x, 1.4302966531241976, 1e-7);
  EXPECT_THAT(line.highest_side_lobe().level_db, RelativelyNear(-13.261458884048285));
  EXPECT_THAT(level_db(line, 2.4590240329569477), RelativelyNear(-17.830421076512664));
  EXPECT_THAT(line.equivalent_beam(), RelativelyNear(1));
  EXPECT_EQ(line.taper_efficiency(), 1);
}

// The same aperture transmits and receives: sinc^4.
TEST(ArrayPatternTest, TwoWayLineHasTheReferenceLobes) {
  const ArrayPattern line({.two_way = true});
  EXPECT_THAT(line.width(), RelativelyNear(0.6378333973704464));
  EXPECT_THAT(line.highest_side_lobe().level_db, RelativelyNear(2 * -13.261458884048285));
  EXPECT_THAT(line.equivalent_beam(), RelativelyNear(2.0 / 3));
}

TEST(ArrayPatternTest, LengthFollowsFromTheBeamWidth) {
  const struct {
    double frequency, beam_width_deg, length;
  } cases[] = {{720e3, 1, 0.10574702268051736},
               {720e3, 20, 0.005314223043785088},
               {1.2e6, 0.6, 0.10574616368410206},
               {700e3, 3, 0.036259803757718735},
               {700e3, 35, 0.0031564772285209617}};
  for (const auto& c : cases) {
    for (const bool two_way : {false, true}) {
      const double length =
          ArrayPattern({.two_way = two_way}).length(kSoundSpeed / c.frequency, radians_from_degrees(c.beam_width_deg));
      EXPECT_THAT(length, RelativelyNear(c.length)) << c.beam_width_deg;
    }
  }
}

// An array 0.1058 m long at 720 kHz.
TEST(ArrayPatternTest, BeamHasTheReferenceSamples) {
  constexpr double kLength = 0.1058 / (kSoundSpeed / 720e3);
  const struct {
    double bearing_deg, intensity;
  } samples[] = {
      {0.25, 0.8485495663522474}, {0.5, 0.49962534430356764}, {1, 0.015768288953058283}, {1.6, 0.04711933457369559}};
  for (const auto& sample : samples) {
    const double u = std::sin(radians_from_degrees(sample.bearing_deg));
    EXPECT_THAT(ArrayPattern().intensity(kLength * u), RelativelyNear(sample.intensity));
  }
  // The width in angle of a steered beam is larger.
  const struct {
    double bearing_deg, width_deg;
  } steered[] = {{0, 0.9994992564902505}, {30, 1.1541467230097133}, {60, 1.9999888874867295}};
  for (const auto& s : steered) {
    const double u0 = std::sin(radians_from_degrees(s.bearing_deg));
    const double half = ArrayPattern().width() / kLength / 2;
    EXPECT_THAT(degrees_from_radians(std::asin(u0 + half) - std::asin(u0 - half)), RelativelyNear(s.width_deg));
  }
}

// Width, highest side lobe and taper efficiency of 64 elements.
TEST(ArrayPatternTest, WindowsHaveTheReferenceLobes) {
  const struct {
    ArraySettings settings;
    double width, side_lobe_db, efficiency;
  } cases[] = {
      {{.window = ArrayWindow::kRectangular}, 0.8859862914874193, -13.254321133089, 1.0},
      {{.window = ArrayWindow::kHann}, 1.4184199507623518, -31.467388922080914, 0.6770833333333334},
      {{.window = ArrayWindow::kHamming}, 1.316476801519105, -42.4454812673155, 0.7255199639813759},
      {{.window = ArrayWindow::kTaylor, .side_lobe_db = -30, .nbar = 4},
       1.1247478338252666,
       -30.291198145258274,
       0.853385875321298},
      {{.window = ArrayWindow::kTaylor, .side_lobe_db = -35, .nbar = 5},
       1.187523341029688,
       -35.20996738979175,
       0.8079807969446431},
      {{.window = ArrayWindow::kDolphChebyshev, .side_lobe_db = -30},
       1.0728891453527336,
       -30.000000000000483,
       0.8750785786062677},
      {{.window = ArrayWindow::kDolphChebyshev, .side_lobe_db = -40},
       1.2175405989486079,
       -40.00000000001107,
       0.7857242428515906},
      {{.window = ArrayWindow::kCosine}, 1.1887333512773481, -23.01123710702501, 0.8107322491663862},
  };
  for (auto c : cases) {
    c.settings.elements = 64;
    const ArrayPattern array(c.settings);
    SCOPED_TRACE(static_cast<int>(c.settings.window));
    EXPECT_THAT(array.width(), RelativelyNear(c.width));
    // The reference values were searched on a grid.
    EXPECT_NEAR(array.highest_side_lobe().level_db, c.side_lobe_db, 1e-4);
    EXPECT_THAT(array.taper_efficiency(), RelativelyNear(c.efficiency));
    EXPECT_TRUE(array.is_real());
  }
}

// Taylor (1955): half-power width beta sigma, with beta = 2 / pi sqrt(acosh^2 R - acosh^2(R / sqrt 2)) that of Dolph's
// ideal pattern, R the ratio of main to side lobes, and sigma = nbar / sqrt(A^2 + (nbar - 1/2)^2), A = acosh(R) / pi.
// It holds for nbar >= 2 A^2 + 1/2 (Balanis, Antenna Theory (2005), section 7.7), which is 3.98 for -30 dB, 8.93 for
// -50 dB and 30.7 for -100 dB: with that many the side lobes are at the level asked for.
TEST(ArrayPatternTest, TaylorReachesTheLevelAskedFor) {
  for (const auto& [level, nbar, width] : {std::tuple{-25.0, 4, 1.0630},
                                           {-30.0, 4, 1.1302},
                                           {-40.0, 6, 1.2515},
                                           {-50.0, 9, 1.3667},
                                           {-70.0, 16, 1.5772},
                                           {-100.0, 31, 1.8537}}) {
    for (const int elements : {0, 256}) {
      const ArrayPattern array({.window = ArrayWindow::kTaylor, .side_lobe_db = level, .elements = elements});
      EXPECT_LE(array.highest_side_lobe().level_db, level) << elements;
      EXPECT_GT(array.highest_side_lobe().level_db, level - 0.5) << elements;
      EXPECT_NEAR(array.width(), width, 0.01 * width) << level << ", " << elements;
      const ArrayPattern same(
          {.window = ArrayWindow::kTaylor, .side_lobe_db = level, .nbar = nbar, .elements = elements});
      EXPECT_EQ(array.intensity(1.7), same.intensity(1.7)) << level;
    }
  }
  // Four lobes are too few for -50 dB.
  const ArrayPattern four({.window = ArrayWindow::kTaylor, .side_lobe_db = -50, .nbar = 4});
  EXPECT_NEAR(four.highest_side_lobe().level_db, -44.7, 0.1);
}

TEST(ArrayPatternTest, DolphsSideLobesAreLevel) {
  const ArrayPattern array({.window = ArrayWindow::kDolphChebyshev, .side_lobe_db = -30, .elements = 15});
  EXPECT_NEAR(array.highest_side_lobe().level_db, -30, 1e-9);
  double crossings = 0;
  for (double x = 1.5; x < 7.5; x += 0.001) {
    EXPECT_LE(level_db(array, x), -30 + 1e-9);
    crossings += level_db(array, x) > -30.01 ? 1 : 0;
  }
  EXPECT_GT(crossings, 6 * 20);
}

// A line with a Hann window has the width 1.441 lambda/D and side lobes of -31.5 dB (Harris, Proc. IEEE 66(1), 51
// (1978)). The pattern of many elements converges to that of a line.
TEST(ArrayPatternTest, ManyElementsAreALine) {
  EXPECT_NEAR(ArrayPattern({.window = ArrayWindow::kHann}).width(), 1.441, 5e-4);
  EXPECT_NEAR(ArrayPattern({.window = ArrayWindow::kHann}).highest_side_lobe().level_db, -31.47, 5e-3);
  for (const ArrayWindow window : {ArrayWindow::kRectangular, ArrayWindow::kHann, ArrayWindow::kHamming,
                                   ArrayWindow::kCosine, ArrayWindow::kTaylor}) {
    const ArrayPattern line({.window = window}), array({.window = window, .elements = 1024});
    for (double x = -12; x < 12; x += 0.37) {
      EXPECT_NEAR(array.amplitude(x).real(), line.amplitude(x).real(), 1.5e-3) << x;
    }
  }
}

// The integral of |g|^2 by brute force, over one period for an array of elements.
TEST(ArrayPatternTest, EquivalentBeamIsTheIntegral) {
  for (const bool two_way : {false, true}) {
    for (const ArrayWindow window : {ArrayWindow::kRectangular, ArrayWindow::kHann, ArrayWindow::kTaylor}) {
      const ArrayPattern array({.window = window, .elements = 21, .two_way = two_way});
      double sum = 0;
      constexpr int kSteps = 1000;
      for (int i = 0; i < kSteps; ++i) {
        sum += array.intensity(21 * (i + 0.5) / kSteps);
      }
      EXPECT_THAT(array.equivalent_beam(), RelativelyNear(sum * 21 / kSteps));
      // For a line, over all lobes that are not negligible.
      const ArrayPattern line({.window = window, .two_way = two_way});
      double line_sum = 0;
      for (double x = -500; x < 500; x += 0.25) {
        line_sum += 0.25 * line.intensity(x);
      }
      EXPECT_NEAR(line.equivalent_beam(), line_sum, 5e-4);
    }
  }
}

TEST(ArrayPatternTest, TwoWayIsTheSquare) {
  const ArraySettings faulty{.window = ArrayWindow::kTaylor,
                             .elements = 32,
                             .element_error_db = 1,
                             .element_error = 0.1,
                             .dead_elements = {3}};
  ArraySettings both_ways = faulty;
  both_ways.two_way = true;
  for (const double x : {0.0, 0.4, 2.7, -9.1}) {
    const std::complex<double> one_way = ArrayPattern(faulty, 7).amplitude(x);
    EXPECT_NEAR(std::abs(ArrayPattern(both_ways, 7).amplitude(x) - one_way * one_way), 0, 1e-15);
  }
}

// A dead element removes its contribution from the pattern: with equal weights 1/N, e^(-i 2 pi x ((N - 1) / 2 - n) / N)
// / N. Phases grow with range, and an element to port is nearer to what is to port.
TEST(ArrayPatternTest, DeadElementIsSubtractedFromThePattern) {
  const ArrayPattern perfect({.elements = 16}), holed({.elements = 16, .dead_elements = {2}});
  EXPECT_FALSE(holed.is_real());
  EXPECT_NEAR(holed.amplitude(0).real(), 15.0 / 16, 1e-14);
  for (const double x : {0.5, 1.43, 5.0, -3.3}) {
    const std::complex<double> lost = std::polar(1.0 / 16, -2 * pi * x * (7.5 - 2) / 16);
    EXPECT_NEAR(std::abs(holed.amplitude(x) - (perfect.amplitude(x) - lost)), 0, 1e-14);
  }
}

// With independent phase errors of standard deviation s, the mean amplitude falls by e^(-s^2 / 2), and the fraction 1 -
// e^(-s^2) of each element's power is spread over all directions: E|g|^2 = e^(-s^2) |g0|^2 + (1 - e^(-s^2)) sum w^2
// (Van Trees, Optimum Array Processing (2002), 2.6.3). At a null of g0 only the second term remains. With a share q of
// dead elements and no other errors that term is (1 - q) q / (N - 1); N - 1 instead of N, because the number of dead
// elements is exact. The means over 400 arrays have a standard error of 5 %.
TEST(ArrayPatternTest, FaultsRaiseTheSideLobes) {
  constexpr int kElements = 64, kArrays = 400;
  constexpr double kDeviation = 0.2, kShare = 0.125;
  double by_phase = 0, by_death = 0;
  for (int seed = 0; seed < kArrays; ++seed) {
    by_phase += ArrayPattern({.elements = kElements, .element_error = kDeviation}, seed).intensity(5) / kArrays;
    by_death += ArrayPattern({.elements = kElements, .dead_share = kShare}, seed).intensity(5) / kArrays;
  }
  constexpr double kFourSigma = 4 * 0.05;
  EXPECT_NEAR(by_phase / ((1 - std::exp(-kDeviation * kDeviation)) / kElements), 1, kFourSigma);
  EXPECT_NEAR(by_death / (kShare * (1 - kShare) / (kElements - 1)), 1, kFourSigma);
  EXPECT_LT(level_db(ArrayPattern({.elements = kElements}), 5), -250);
}

// The expectation of 10^(d / 20), for normal d with standard deviation s [dB], is e^((s ln 10 / 20)^2 / 2). The array's
// response on the axis is the mean over its 1000 elements.
TEST(ArrayPatternTest, AmplitudesDeviateInDecibels) {
  constexpr double kDeviationDb = 2;
  const double neper = kDeviationDb * std::log(10) / 20;
  const ArrayPattern array({.elements = 1000, .element_error_db = kDeviationDb}, 5);
  EXPECT_NEAR(array.amplitude(0).real(), std::exp(neper * neper / 2), 4 * neper / std::sqrt(1000));
  EXPECT_NEAR(array.amplitude(0).imag(), 0, 1e-12);
}

TEST(ArrayPatternTest, FaultsDependOnTheSeed) {
  const ArraySettings faulty{.elements = 32, .element_error_db = 1, .element_error = 0.1, .dead_share = 0.1};
  EXPECT_EQ(ArrayPattern(faulty, 3).amplitude(2.2), ArrayPattern(faulty, 3).amplitude(2.2));
  EXPECT_NE(ArrayPattern(faulty, 3).amplitude(2.2), ArrayPattern(faulty, 4).amplitude(2.2));
}

TEST(ArrayPatternTest, SparseArrayHasGratingLobes) {
  EXPECT_NEAR(ArrayPattern({.elements = 16}).intensity(16), 1, 1e-12);
  EXPECT_NEAR(ArrayPattern({.elements = 16}).intensity(8), 0, 1e-12);
}

TEST(BearingTest, ConeBringsHighTargetsTowardsTheAxis) {
  const struct {
    double azimuth, elevation, bearing;
  } cases[] = {{30, 10, 29.498704231103652},
               {60, 10, 58.5250511108145},
               {45, 20, 41.64114326790979},
               {60, -20, 54.46865223719582}};
  for (const auto& c : cases) {
    const double azimuth = radians_from_degrees(c.azimuth), elevation = radians_from_degrees(c.elevation);
    EXPECT_THAT(degrees_from_radians(std::asin(bearing_sine(BeamShape::kCone, azimuth, elevation))),
                RelativelyNear(c.bearing));
    EXPECT_THAT(degrees_from_radians(std::asin(bearing_sine(BeamShape::kWedge, azimuth, elevation))),
                RelativelyNear(c.azimuth));
  }
}

testing::Matcher<const ArraySettings&> is_refused(const char* message) {
  return testing::ResultOf(
      [](const ArraySettings& settings) -> std::string {
        try {
          settings.validate("fls.array");
        } catch (const Error& error) {
          return error.what();
        }
        return "accepted";
      },
      message);
}

TEST(ArraySettingsTest, InvalidSettingsAreRefused) {
  EXPECT_THAT(ArraySettings{}, is_refused("accepted"));
  EXPECT_THAT(ArraySettings{.side_lobe_db = -10},
              is_refused("fls.array.side_lobe_db = -10 dB must be from -100 to -15 dB"));
  EXPECT_THAT(ArraySettings{.nbar = 1},
              is_refused("fls.array.nbar = 1 must be 0 (as side_lobe_db needs) or at least 2"));
  EXPECT_THAT(ArraySettings{.nbar = 41}, is_refused("fls.array.nbar = 41 must be from 0 to 40"));
  EXPECT_THAT(ArraySettings{.elements = -1}, is_refused("fls.array.elements = -1 must be from 0 to 1024"));
  EXPECT_THAT(ArraySettings{.elements = 1},
              is_refused("fls.array.elements = 1 must be 0 (a continuous line) or at least 2"));
  EXPECT_THAT((ArraySettings{.elements = 8, .element_error = 4}),
              is_refused("fls.array.element_error_deg = 229.1831181 deg must be from 0 to 180 deg"));
  EXPECT_THAT(ArraySettings{.window = ArrayWindow::kDolphChebyshev},
              is_refused("fls.array.window = dolph_chebyshev needs fls.array.elements of at least 2"));
  EXPECT_THAT(ArraySettings{.element_error_db = 1},
              is_refused("fls.array has faults of elements, which needs fls.array.elements of at least 2"));
  EXPECT_THAT((ArraySettings{.elements = 8, .dead_elements = {1, 8}}),
              is_refused("fls.array.dead_elements[1] = 8 must be less than fls.array.elements = 8"));
  EXPECT_THAT((ArraySettings{.elements = 2, .dead_elements = {0}, .dead_share = 0.5}),
              is_refused("fls.array.dead_elements and fls.array.dead_share leave none of 2 elements"));
  EXPECT_THAT([] { ArrayPattern pattern({.elements = 1}); }, ThrowsMessage<Error>(HasSubstr("array.elements = 1")));
}

// Sum of the window's waves at 200 000 places along a line, whose phases at the ends differ by at most 4 x 300 / 100
// 000 rad from one to the next: an error of 1e-5 of those next to it.
TEST(ArrayPatternTest, DefocusedLineIsTheIntegralOverItsLength) {
  constexpr int kPlaces = 200000;
  for (const ArrayWindow window : {ArrayWindow::kRectangular, ArrayWindow::kCosine, ArrayWindow::kTaylor}) {
    const ArrayPattern line({.window = window});
    const std::vector<WindowCosine> weight = line_weight({.window = window});
    for (const double phase : {1e-3, -0.5, 3.0, -40.0, 300.0}) {
      const ArrayPattern defocused = line.defocused(phase);
      for (const double x : {0.0, 0.31, -1.5, 5.75, -7.9}) {
        std::complex<double> sum = 0;
        for (int i = 0; i < kPlaces; ++i) {
          const double s = (i + 0.5) / kPlaces - 0.5;
          double share = 0;
          for (const WindowCosine& part : weight) {
            share += part.share * std::cos(2 * pi * part.turns * s);
          }
          sum += std::polar(share / kPlaces, 2 * pi * x * s + 4 * phase * s * s);
        }
        sum /= line_pattern(weight, 0);
        EXPECT_NEAR(std::abs(defocused.amplitude(x) - sum), 0, 1e-7) << phase << " " << x;
      }
    }
  }
}

}  // namespace
}  // namespace insonify::array_pattern_test
