// coarse_bins_test.cpp -- what a bin keeps of extended and compact echoes, by hand.

#include "receiver/pulse/coarse_bins.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace insonify::coarse_bins_test {
namespace {

// A tone of 80 us is 40 mm long after its filter (c tau / 3): bins of 160 mm hold four looks.
constexpr double kSoundSpeed = 1500, kBin = 0.16;

CoarseBins bins_that_keep(Decimation decimation) {
  const Pulse tone({.kind = PulseKind::kCw, .duration = 80e-6}, kSoundSpeed, kBin);
  return {tone, kBin, RangeResponse(tone, kBin), decimation};
}

// Of a row with the extended energy 1 and a compact echo in the middle, each bin keeps a quarter of what is extended.
// Beside its neighbours the middle has 11, of which twice theirs, 2, count as extended and 9 as compact.
TEST(CoarseBinsTest, AQuarterOfExtendedEchoesAndAllOfCompactOnesIsKept) {
  const CoarseBins bins = bins_that_keep(Decimation::kPeak);
  std::vector<float> energy = {1, 1, 11, 1, 1}, extended(5);
  bins.receive(energy, extended);
  const std::vector<float> kept = {0.25F, 0.25F, 9 + 0.5F, 0.25F, 0.25F};
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(energy[i], kept[i], 1e-5) << i;
    EXPECT_NEAR(extended[i], i == 2 ? 0.5 : 0.25, 1e-5) << i;
  }
}

// A compact echo on the edge of two bins, 11 and 9 on an extended 1: of what both have above 2, the share w = ln 4 / 3
// counts as compact, so that (1 + ln 4) / 4 of it is kept. That is the mean of min(1, 2 l / d) over depths d up to 2 L.
TEST(CoarseBinsTest, MostOfAnEchoOnTheEdgeOfTwoBinsIsKept) {
  const CoarseBins bins = bins_that_keep(Decimation::kSample);
  std::vector<float> energy = {1, 1, 11, 9, 1, 1};
  bins.receive(energy);
  double mean = 0;
  constexpr int kSteps = 10000;
  for (int i = 0; i < kSteps; ++i) {
    mean += std::min(1.0, 0.5 / (2 * (i + 0.5) / kSteps)) / kSteps;  // l = L / 4.
  }
  const std::vector<double> kept = {0.25, 0.25, 9 * mean + 0.5, 7 * mean + 0.5, 0.25, 0.25};
  for (std::size_t i = 0; i < kept.size(); ++i) {
    EXPECT_NEAR(energy[i], kept[i], 1e-3) << i;
  }
}

// Where bins are hardly longer than the pulse, all of it is kept.
TEST(CoarseBinsTest, FineBinsKeepAll) {
  const Pulse tone({.kind = PulseKind::kCw, .duration = 80e-6}, kSoundSpeed, 0.0401);
  const CoarseBins bins(tone, 0.0401, RangeResponse(tone, 0.0401), Decimation::kSample);
  std::vector<float> energy = {0, 0, 1, 1, 0, 0};
  bins.receive(energy);
  EXPECT_NEAR(energy[2] + energy[3], 2, 0.02);
}

// Rows of any length, longer than what is computed together: each bin by the definition, with its neighbours before
// any of them is replaced.
TEST(CoarseBinsTest, EachBinIsComparedWithItsNeighbours) {
  const CoarseBins bins = bins_that_keep(Decimation::kSample);
  for (const std::size_t size : {1U, 2U, 3U, 127U, 128U, 129U, 130U, 300U}) {
    std::vector<float> energy;
    for (std::size_t i = 0; i < size; ++i) {
      energy.push_back(1 + static_cast<float>(i * i * 37 % 101));  // From bin to bin much more or less than twice.
    }
    const std::vector<float> before = energy;
    bins.receive(energy);
    const auto at = [&](std::size_t i, int away) {
      const auto place = static_cast<std::int64_t>(i) + away;
      return place >= 0 && place < static_cast<std::int64_t>(size) ? double{before[place]} : 0.0;
    };
    for (std::size_t i = 0; i < size; ++i) {
      const double alone = std::min(at(i, 0), 2 * std::max(at(i, -1), at(i, 1)));
      const double pair = 2 * std::min(std::max(at(i, -1), at(i, 2)), std::max(at(i, -2), at(i, 1)));
      const double extended = alone - std::log(4) / 3 * std::max(0.0, alone - pair);
      EXPECT_NEAR(energy[i], at(i, 0) - 0.75 * extended, 1e-4) << size << ", " << i;
    }
  }
}

// The greatest of 1 + 3 s looks, s the share that every look has. P(I < y) = (1 - e^-y)^n must be the 1 - e^-x of the x
// that y is made of.
TEST(CoarseBinsTest, OnlyTheShareThatIsInEveryLookCountsAsManyLooks) {
  const CoarseBins bins = bins_that_keep(Decimation::kPeak);
  for (const float share : {0.0F, 0.5F, 1.0F}) {
    const double looks = 1 + 3 * share;
    for (const float x : {0.01F, 0.5F, 1.0F, 3.0F, 8.0F}) {
      const double y = bins.kept(2 * x, 2, share) / 2.0;
      EXPECT_NEAR(std::pow(-std::expm1(-y), looks), -std::expm1(-double{x}), 2e-3) << share << ", " << x;
    }
  }
}

// Of a mean with the share s in every look, the rest fluctuates as one look does.
TEST(CoarseBinsTest, AMeanLeavesAloneWhatIsInOneLook) {
  const CoarseBins bins = bins_that_keep(Decimation::kMean);
  for (const float x : {0.1F, 1.0F, 4.0F}) {
    EXPECT_FLOAT_EQ(bins.kept(3 * x, 3, 0), 3 * x);
    const float all = bins.kept(3 * x, 3, 1);
    EXPECT_NEAR(bins.kept(3 * x, 3, 0.3F), 0.3F * all + 0.7F * 3 * x, 1e-4);
    EXPECT_NE(all, 3 * x);
  }
}

}  // namespace
}  // namespace insonify::coarse_bins_test
