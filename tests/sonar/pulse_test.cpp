// pulse_test.cpp -- range point-spread functions against closed forms and independently computed values (formulas in
// docs/concepts/array-and-pulse.md).

#include "insonify/pulse.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "insonify/error.h"
#include "support/relative.h"

namespace insonify::pulse_test {
namespace {

constexpr double kSoundSpeed = 1500, kBinLength = 0.04;

Pulse make(const PulseSettings& settings) {
  return {settings, kSoundSpeed, kBinLength};
}

Pulse chirp(double bandwidth, bool hann = false) {
  return make({.kind = PulseKind::kLfm,
               .duration = 1e-3,
               .bandwidth = bandwidth,
               .window = hann ? PulseWindow::kHann : PulseWindow::kRectangular});
}

// The integral of |p|^2 by brute force.
double summed(const Pulse& pulse) {
  constexpr int kSteps = 200000;
  const double step = 2.2 * pulse.reach() / kSteps;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    sum += step * pulse.intensity((i + 0.5) * step - 1.1 * pulse.reach());
  }
  return sum;
}

TEST(PulseTest, NoneIsOneBinLong) {
  const Pulse none = make({});
  EXPECT_EQ(none.amplitude(0.0199), 1);
  EXPECT_EQ(none.amplitude(-0.0201), 0);
  EXPECT_THAT(none.intensity(0.02), RelativelyNear(0.5));
  EXPECT_THAT(none.width(), RelativelyNear(kBinLength));
  EXPECT_THAT(none.equivalent_length(), RelativelyNear(kBinLength));
  EXPECT_EQ(none.side_lobe_db(), -std::numeric_limits<double>::infinity());
}

// A tone of duration tau has the length c tau / 2 in range: 37.5 mm for 50 us, 15 mm for 20 us.
TEST(PulseTest, ToneIsHalfItsLengthInWater) {
  for (const auto& [duration, length] : {std::pair{50e-6, 0.0375}, std::pair{20e-6, 0.015}}) {
    const Pulse tone = make({.kind = PulseKind::kCw, .duration = duration, .matched_filter = false});
    EXPECT_THAT(tone.width(), RelativelyNear(length));
    EXPECT_THAT(tone.equivalent_length(), RelativelyNear(length));
    EXPECT_EQ(tone.amplitude(0.49 * length), 1);
    EXPECT_EQ(tone.amplitude(0.51 * length), 0);
  }
}

// The correlation of two rectangles is a triangle of base c tau. Its half-power points are where it is sqrt(1/2).
TEST(PulseTest, MatchedToneIsATriangle) {
  const Pulse tone = make({.kind = PulseKind::kCw, .duration = 50e-6});
  EXPECT_EQ(tone.amplitude(0), 1);
  EXPECT_THAT(tone.amplitude(0.0375 / 4), RelativelyNear(0.75));
  EXPECT_EQ(tone.amplitude(-0.0375), 0);
  EXPECT_THAT(tone.width(), RelativelyNear(0.075 * (1 - std::sqrt(0.5))));
  EXPECT_THAT(tone.intensity(tone.width() / 2), RelativelyNear(0.5));
  EXPECT_THAT(tone.equivalent_length(), RelativelyNear(0.0375 * 2 / 3));
}

// Range resolution c / (2 B), and width at half power, 0.8859 times that.
TEST(PulseTest, ChirpHasTheReferenceWidths) {
  const struct {
    double bandwidth, cell, width;
  } cases[] = {{20000, 0.0375, 0.03322098530167998},
               {80000, 0.009375, 0.008305246325419995},
               {100000, 0.0075, 0.006644197060335996},
               {200000, 0.00375, 0.003322098530167998}};
  for (const auto& c : cases) {
    EXPECT_THAT(chirp(c.bandwidth).width(), RelativelyNear(c.width));
    EXPECT_THAT(chirp(c.bandwidth).equivalent_length(), RelativelyNear(c.cell));
    EXPECT_NEAR(chirp(c.bandwidth).amplitude(c.cell), 0, 1e-15);
    EXPECT_THAT(chirp(c.bandwidth).side_lobe_db(), RelativelyNear(-13.261458884048285));
  }
}

TEST(PulseTest, WeightingTheBandLowersTheSideLobes) {
  const Pulse weighted = chirp(100e3, true);
  EXPECT_EQ(weighted.amplitude(0), 1);
  EXPECT_NEAR(weighted.width() / 0.0075, 1.441, 5e-4);
  EXPECT_NEAR(weighted.side_lobe_db(), -31.5, 0.05);
  EXPECT_THAT(weighted.equivalent_length(), RelativelyNear(1.5 * 0.0075));
}

// Windows over the band have the lobes of the same windows along a line (Harris 1978): continuous cosine -23.00 dB,
// Hamming -42.7 dB; Taylor's the level asked for. The peak stays 1.
TEST(PulseTest, EveryWindowHasItsSideLobes) {
  for (const auto& [window, level, asked, tolerance] : {std::tuple{PulseWindow::kCosine, -23.0, -40.0, 0.01},
                                                        {PulseWindow::kHamming, -42.7, -40.0, 0.1},
                                                        {PulseWindow::kTaylor, -35.1, -35.0, 0.15},
                                                        {PulseWindow::kTaylor, -55.1, -55.0, 0.15}}) {
    const Pulse pulse =
        make({.kind = PulseKind::kLfm, .duration = 2e-3, .bandwidth = 60e3, .window = window, .side_lobe_db = asked});
    EXPECT_NEAR(pulse.amplitude(0), 1, 1e-12);
    EXPECT_NEAR(pulse.side_lobe_db(), level, tolerance) << static_cast<int>(window);
    EXPECT_NEAR(summed(pulse) / pulse.equivalent_length(), 1, 1e-3);
  }
}

// White noise after a filter w(f) over the band B, with which the pulse's spectrum of constant height makes a peak of
// 1, has the bandwidth (integral w^2) / (integral w)^2 B / (B T): 1 / T without a window, 1.5 / T for Hann, pi^2 / 8 /
// T for a cosine. Its correlation is the transform of w^2, summed here; a tone has a triangle.
TEST(PulseTest, NoiseIsThatOfTheMatchedFilter) {
  EXPECT_EQ(make({}).noise_bandwidth(), 0);
  EXPECT_EQ(make({}).noise_correlation(kBinLength), 0);
  EXPECT_THAT(make({.kind = PulseKind::kCw, .duration = 80e-6}).noise_bandwidth(), RelativelyNear(12500.0));
  EXPECT_THAT(make({.kind = PulseKind::kCw, .duration = 80e-6}).noise_correlation(0.015), RelativelyNear(0.75));
  EXPECT_EQ(make({.kind = PulseKind::kCw, .duration = 80e-6}).noise_correlation(0.0601), 0);
  const double pi = 3.14159265358979323846;
  for (const auto& [window, bandwidth] :
       {std::pair{PulseWindow::kRectangular, 1.0}, {PulseWindow::kHann, 1.5}, {PulseWindow::kCosine, pi * pi / 8}}) {
    const Pulse pulse = make({.kind = PulseKind::kLfm, .duration = 2e-3, .bandwidth = 40e3, .window = window});
    EXPECT_THAT(pulse.noise_bandwidth(), RelativelyNear(500 * bandwidth));
    for (const double dr : {0.0, 0.004, 0.011, 0.025, 0.04}) {
      double sum = 0, power = 0;
      for (int i = 0; i < 4000; ++i) {
        const double s = (i + 0.5) / 4000 - 0.5;
        const double w =
            window == PulseWindow::kRectangular ? 1 : std::pow(std::cos(pi * s), window == PulseWindow::kHann ? 2 : 1);
        sum += w * w * std::cos(2 * pi * s * dr / (1500 / 80e3));
        power += w * w;
      }
      EXPECT_NEAR(pulse.noise_correlation(dr), sum / power, 1e-5) << static_cast<int>(window) << ", " << dr;
    }
  }
}

// The compressed chirp extends to half the chirp's length in range on either side: 0.75 m for 1 ms.
TEST(PulseTest, ChirpEndsAtHalfItsLength) {
  EXPECT_DOUBLE_EQ(chirp(100e3).reach(), 0.75);
  EXPECT_NE(chirp(100e3).amplitude(0.749), 0);
  EXPECT_EQ(chirp(100e3).amplitude(0.751), 0);
}

TEST(PulseTest, EquivalentLengthIsTheIntegral) {
  EXPECT_NEAR(summed(make({})) / kBinLength, 1, 1e-4);
  const Pulse tone = make({.kind = PulseKind::kCw, .duration = 50e-6});
  EXPECT_NEAR(summed(tone) / tone.equivalent_length(), 1, 1e-4);
  // The pulse ends B T = 100 resolution cells from the peak; 1 / (pi^2 100) of the energy of a sinc lies beyond.
  EXPECT_NEAR(summed(chirp(100e3)) / 0.0075, 1 - 1 / (9.8696 * 100), 1e-5);
  EXPECT_NEAR(summed(chirp(100e3, true)) / 0.0075, 1.5, 1e-5);
}

// At 1 m/s a carrier of 720 kHz is shifted by 960 Hz, which with a chirp of 1 ms and 100 kHz is a range error of 7.2
// mm.
TEST(PulseTest, ChirpTurnsDopplerIntoARangeError) {
  EXPECT_THAT(doppler_shift(1, 720e3, kSoundSpeed), RelativelyNear(960));
  EXPECT_THAT(chirp(100e3).doppler_bias(960), RelativelyNear(7.2e-3));
  EXPECT_EQ(make({.kind = PulseKind::kCw}).doppler_bias(960), 0);
}

std::string refusal(const PulseSettings& settings) {
  try {
    settings.validate("fls.pulse");
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(PulseSettingsTest, InvalidSettingsAreRefused) {
  EXPECT_EQ(refusal({}), "accepted");
  EXPECT_EQ(refusal({.kind = PulseKind::kLfm}), "accepted");
  EXPECT_EQ(refusal({.duration = 0}), "fls.pulse.duration = 0 s must be greater than 0, at most 1 s");
  EXPECT_EQ(refusal({.bandwidth = -1}), "fls.pulse.bandwidth = -1 Hz must be greater than 0, at most 10000000 Hz");
  EXPECT_EQ(refusal({.kind = PulseKind::kLfm, .duration = 1e-4, .bandwidth = 5e4}),
            "fls.pulse.bandwidth = 50000 Hz times fls.pulse.duration = 0.0001 s must be at least 10");
  EXPECT_THAT([] { Pulse({.duration = -1}, 1500, 0.1); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("pulse.duration")));
}

}  // namespace
}  // namespace insonify::pulse_test
