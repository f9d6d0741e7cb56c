// head_scan_test.cpp -- first returns of a scanning head, by turns and by sweeps.

#include "io/message/head_scan.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

namespace insonify::head_scan_test {
namespace {

using testing::ElementsAre;

constexpr double kTurn = 2 * std::numbers::pi;
constexpr std::uint64_t kPeriod = 50'000'000;  // [ns]
constexpr float kNone = std::numeric_limits<float>::infinity();

// Ten bins of 1 m; intensities from 0 to 1 are shown as they are.
SonarConfig head(double step, double sector_width) {
  SonarConfig sonar;
  sonar.type = SonarType::kMechanicallyScanned;
  sonar.beam_count = 1;
  sonar.bin_count = 10;
  sonar.min_range = 0;
  sonar.max_range = 10;
  sonar.head.step = step;
  sonar.head.sector_width = sector_width;
  return sonar;
}

Ping ping_of(const SonarConfig& sonar, std::uint64_t number, const std::vector<float>& intensity) {
  Ping ping;
  ping.number = number;
  ping.head_angle = sonar.head_angle(number);
  ping.bin_count = 10;
  ping.beam_count = 1;
  ping.intensity = intensity;
  return ping;
}

// An echo in the bin whose number is that of the ping, modulo 10.
std::vector<float> echo_in(std::uint64_t bin) {
  std::vector<float> intensity(10, 0.1F);
  intensity[bin % 10] = 0.6F;
  return intensity;
}

Display linear() {
  Display display;
  display.full_scale = 1;
  display.scale = Scale::kLinear;
  return display;
}

// Adds pings from `first` to before `end`, and returns the scans.
std::vector<HeadScan::Ended> scans_of(HeadScan& scan, const SonarConfig& sonar, std::uint64_t first,
                                      std::uint64_t end) {
  std::vector<HeadScan::Ended> scans;
  for (std::uint64_t number = first; number < end; ++number) {
    const Ping ping = ping_of(sonar, number, echo_in(number));
    scan.add(ping, ping, 1000 + number * kPeriod, sonar, linear());
    if (scan.ended()) {
      scans.push_back(*scan.ended());
    }
  }
  return scans;
}

TEST(FirstReturnTest, IsTheNearestBinFromHalfOfTheScaleBehindTheTransmission) {
  const SonarConfig sonar = head(1, kTurn);
  const auto of = [&](const std::vector<float>& intensity) {
    return first_return(ping_of(sonar, 0, intensity), linear());
  };
  EXPECT_EQ(of({0, 0.1F, 0.49F, 0.51F, 0.9F, 0, 0, 0.9F, 0, 0}), 3);
  EXPECT_EQ(of({1, 0.8F, 0.6F, 0.4F, 0.2F, 0.1F, 0.7F, 0, 0, 0}), 6);  // Behind the transmission.
  EXPECT_EQ(of({1, 0.8F, 0.6F, 0.4F, 0.2F, 0.1F, 0, 0, 0, 0}), std::nullopt);
  EXPECT_EQ(of(std::vector<float>(10, 1)), std::nullopt);
}

// Eight pings a turn; a turn may begin at any of them.
TEST(HeadScanTest, IsAWholeTurn) {
  const SonarConfig sonar = head(kTurn / 8, kTurn);
  HeadScan scan;
  const std::vector<HeadScan::Ended> scans = scans_of(scan, sonar, 3, 3 + 20);
  ASSERT_EQ(scans.size(), 2U);
  const HeadScan::Ended& first = scans[0];
  EXPECT_EQ(first.first_ping, 3U);
  EXPECT_EQ(first.time_ns, 1000 + 3 * kPeriod);
  EXPECT_NEAR(first.scan.first_angle, 3 * kTurn / 8, 1e-9);
  EXPECT_NEAR(first.scan.step, kTurn / 8, 1e-9);
  EXPECT_NEAR(first.scan.interval, 0.05, 1e-9);
  EXPECT_NEAR(first.scan.duration, 0.4, 1e-9);
  EXPECT_EQ(first.scan.most_range, 10);
  // Bins 3 to 9, and of ping 10 bin 0, which is above the level from the first bin on: the transmission.
  EXPECT_THAT(first.scan.ranges, ElementsAre(3.5F, 4.5F, 5.5F, 6.5F, 7.5F, 8.5F, 9.5F, kNone));
  EXPECT_NEAR(static_cast<double>(first.scan.intensities[0]), 10 * std::log10(0.6), 1e-5);
  EXPECT_EQ(first.scan.intensities[7], -kNone);
  EXPECT_EQ(scans[1].first_ping, 11U);
}

// To port and back: each sweep has both of its edges.
TEST(HeadScanTest, IsASweepFromEdgeToEdge) {
  const SonarConfig sonar = head(0.1, 0.4);
  HeadScan scan;
  const std::vector<HeadScan::Ended> scans = scans_of(scan, sonar, 1, 14);  // From within the first sweep on.
  ASSERT_EQ(scans.size(), 2U);
  EXPECT_EQ(scans[0].first_ping, 4U);
  EXPECT_NEAR(scans[0].scan.first_angle, 0.2, 1e-9);
  EXPECT_NEAR(scans[0].scan.step, -0.1, 1e-9);
  EXPECT_NEAR(scans[0].scan.duration, 0.2, 1e-9);
  EXPECT_THAT(scans[0].scan.ranges, ElementsAre(4.5F, 5.5F, 6.5F, 7.5F, 8.5F));
  EXPECT_EQ(scans[1].first_ping, 8U);
  EXPECT_NEAR(scans[1].scan.first_angle, -0.2, 1e-9);
  EXPECT_NEAR(scans[1].scan.step, 0.1, 1e-9);
}

TEST(HeadScanTest, BeginsAgainAfterAMissingPing) {
  const SonarConfig sonar = head(kTurn / 8, kTurn);
  HeadScan scan;
  EXPECT_TRUE(scans_of(scan, sonar, 0, 5).empty());
  const std::vector<HeadScan::Ended> scans = scans_of(scan, sonar, 6, 14);
  ASSERT_EQ(scans.size(), 1U);
  EXPECT_EQ(scans[0].first_ping, 6U);
}

}  // namespace
}  // namespace insonify::head_scan_test
