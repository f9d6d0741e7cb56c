// digitizer_test.cpp -- counts of known levels, in both mappings.

#include "receiver/digitizer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace insonify::digitizer_test {
namespace {

std::uint16_t count_at(const SonarConfig& sonar, double full_scale_db, double level_db) {
  const std::vector<float> intensity = {static_cast<float>(std::pow(10.0, level_db / 10))};
  std::vector<std::uint16_t> count(1);
  Digitizer(sonar, full_scale_db).digitize(intensity, count);
  return count[0];
}

// 255 (1 + L / 60): L = -10 dB gives 212.5, L = -30 dB 127.5. The levels below are 0.01 dB off the halves.
TEST(DigitizerTest, SixtyDecibelsInEightBits) {
  const SonarConfig sonar;
  EXPECT_EQ(count_at(sonar, -30, -30), 255);
  EXPECT_EQ(count_at(sonar, -30, -40.01), 212);
  EXPECT_EQ(count_at(sonar, -30, -59.99), 128);
  EXPECT_EQ(count_at(sonar, -30, -89), 4);
  EXPECT_EQ(count_at(sonar, -30, -95), 0);
  EXPECT_EQ(count_at(sonar, -30, -20), 255);
}

TEST(DigitizerTest, GammaIsAPowerOfAmplitude) {
  SonarConfig sonar;
  sonar.mapping = Mapping::kGamma;
  sonar.mapping_exponent = 1;
  EXPECT_EQ(count_at(sonar, 0, -20.1), 25);  // 25.2
  EXPECT_EQ(count_at(sonar, 0, -19.9), 26);  // 25.8
  sonar.mapping_exponent = 0.5;
  EXPECT_EQ(count_at(sonar, 0, -40.2), 25);
  EXPECT_EQ(count_at(sonar, 0, -39.8), 26);
  EXPECT_EQ(count_at(sonar, 0, 0), 255);
  EXPECT_EQ(count_at(sonar, 0, 30), 255);
}

TEST(DigitizerTest, BitsSetTheGreatestCount) {
  SonarConfig sonar;
  for (const int bits : {1, 4, 12, 16}) {
    sonar.bits = bits;
    EXPECT_EQ(count_at(sonar, 10, 10), (1 << bits) - 1);
    EXPECT_EQ(count_at(sonar, 10, -20), static_cast<int>(std::nearbyint(0.5 * ((1 << bits) - 1)))) << bits;
  }
}

// An intensity of 0, whose logarithm is infinite, gives count 0 in both mappings.
TEST(DigitizerTest, ZeroIntensityIsCountZero) {
  SonarConfig sonar;
  for (const Mapping mapping : {Mapping::kGamma, Mapping::kLogarithmic}) {
    sonar.mapping = mapping;
    std::vector<std::uint16_t> counts(3, 7);
    Digitizer(sonar, -200).digitize(std::vector<float>(3, 0.0F), counts);
    EXPECT_EQ(counts, std::vector<std::uint16_t>(3, 0));
  }
}

}  // namespace
}  // namespace insonify::digitizer_test
