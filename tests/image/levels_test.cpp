// levels_test.cpp -- displayed counts; gain over range and full scale of displayed intensities.

#include <gtest/gtest.h>

#include <cmath>

#include "insonify/picture.h"
#include "support/message_of.h"

namespace insonify::levels_test {
namespace {

Ping ping_of(int bins, int beams, float intensity) {
  Ping ping;
  ping.bin_count = bins;
  ping.beam_count = beams;
  ping.intensity.assign(static_cast<std::size_t>(bins) * beams, intensity);
  return ping;
}

TEST(LevelsTest, GainOverRangeCompensatesTheFallWithRange) {
  SonarConfig sonar;
  sonar.beam_count = 3;
  sonar.bin_count = 40;
  sonar.min_range = 2;
  sonar.max_range = 22;
  Ping ping = ping_of(40, 3, 0);
  for (int bin = 0; bin < 40; ++bin) {
    for (int beam = 0; beam < 3; ++beam) {
      ping.intensity[ping.index(bin, beam)] = static_cast<float>((beam + 1) * std::pow(sonar.bin_range(bin), -3));
    }
  }
  const Ping raised = raised_by_range(ping, sonar, 30);
  for (int bin = 0; bin < 40; ++bin) {
    for (int beam = 0; beam < 3; ++beam) {
      EXPECT_NEAR(raised.intensity[raised.index(bin, beam)], beam + 1, 1e-5);
    }
  }
}

TEST(LevelsTest, FullScaleIsAboveAllButAThousandth) {
  std::vector<float> intensities(10000, 2e-6F);
  EXPECT_NEAR(10 * std::log10(fitting_full_scale(intensities)), -55, 1e-9);  // -56.99 dB, rounded up.
  intensities[7] = 3e-4F;                                                    // One in ten thousand, -35.2 dB.
  EXPECT_NEAR(10 * std::log10(fitting_full_scale(intensities)), -55, 1e-9);
  intensities[7] = 1;  // A point in noise: the scale ends 25 dB below it.
  EXPECT_NEAR(10 * std::log10(fitting_full_scale(intensities)), -25, 1e-9);
  std::fill_n(intensities.begin(), 20, 0.5F);  // Two in a thousand.
  EXPECT_NEAR(10 * std::log10(fitting_full_scale(intensities)), 0, 1e-9);
  EXPECT_EQ(fitting_full_scale(std::vector<float>(9, 0.0F)), 1);
}

// The transmit leak, 90 dB above all echoes in a tenth of the bins, does not count: bins of 0.2 m from 0, dead up to 2
// m.
TEST(LevelsTest, FullScaleIsThatOfEchoesBeyondTheDeadRange) {
  SonarConfig sonar;
  sonar.type = SonarType::kMechanicallyScanned;
  sonar.beam_count = 1;
  sonar.bin_count = 100;
  sonar.min_range = 0;
  sonar.max_range = 20;
  sonar.dead_range = 2;
  Ping ping = ping_of(100, 1, 2e-6F);
  std::fill_n(ping.intensity.begin(), 10, 2e3F);
  EXPECT_EQ(intensities_to_fit(ping, sonar), std::vector<float>(90, 2e-6F));
  ScanView view(sonar);
  view.add(ping);
  EXPECT_NEAR(10 * std::log10(view.fitting_full_scale()), -55, 1e-9);
  sonar.dead_range = 0;
  EXPECT_EQ(intensities_to_fit(ping, sonar), ping.intensity);
  sonar.dead_range = 25;  // Nothing else is received.
  EXPECT_EQ(intensities_to_fit(ping, sonar), ping.intensity);
}

// Full scale is that of all pings of a scan, not of its first.
TEST(LevelsTest, ScaleOfAScanFitsAllOfItsPings) {
  SonarConfig sonar;
  sonar.type = SonarType::kMechanicallyScanned;
  sonar.beam_count = 1;
  sonar.bin_count = 100;
  ScanView view(sonar);
  view.add(ping_of(100, 1, 2e-6F));
  EXPECT_NEAR(10 * std::log10(view.fitting_full_scale()), -55, 1e-9);
  view.add(ping_of(100, 1, 0.5F));
  EXPECT_NEAR(10 * std::log10(view.fitting_full_scale()), 0, 1e-9);
}

TEST(LevelsTest, CountsAreShownFromNoneToTheGreatest) {
  SonarConfig sonar;
  sonar.bits = 10;
  Ping ping = ping_of(1, 3, 0.5F);
  ping.counts = {0, 341, 1023};
  const Ping shown = counts_as_intensities(ping);
  const Display display = counts_display(sonar);
  EXPECT_NO_THROW(display.validate());
  EXPECT_EQ(shown_level(display, shown.intensity[0]), 0);
  EXPECT_DOUBLE_EQ(shown_level(display, shown.intensity[1]), 1 / 3.0);
  EXPECT_EQ(shown_level(display, shown.intensity[2]), 1);
}

TEST(LevelsTest, PingsWithoutCountsCannotBeShownAsSuch) {
  Ping ping = ping_of(1, 3, 0.5F);
  ping.number = 7;
  EXPECT_EQ(message_of([&] { static_cast<void>(counts_as_intensities(ping)); }),
            "ping 7 has no counts; receiver.counts: true adds them (calibrated)");
}

}  // namespace
}  // namespace insonify::levels_test
