// pulse_test.cpp -- range point-spread functions against closed forms and independently computed values (formulas in
// docs/concepts/array-and-pulse.md).

#include "insonify/pulse.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "insonify/error.h"
#include "support/relative.h"

namespace insonify {
namespace {

constexpr double kSoundSpeed = 1500, kBinLength = 0.04;

Pulse make(const PulseSettings& settings) {
  return {settings, kSoundSpeed, kBinLength};
}

Pulse chirp(double bandwidth, bool hann = false) {
  return make({.kind = PulseKind::kLfm, .duration = 1e-3, .bandwidth = bandwidth, .hann = hann});
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
}  // namespace insonify
