// bottom_detection_test.cpp -- the bottom in pings made by hand: level, inclined and rough beds, rings of side lobes,
// empty water, beams that look up.

#include "insonify/survey/bottom_detection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <random>

#include "insonify/error.h"

namespace insonify::bottom_detection_test {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

SonarConfig multibeam(int beams = 81) {
  SonarConfig sonar;
  sonar.type = SonarType::kMultibeam;
  sonar.beam_count = beams;
  sonar.azimuth_aperture = 130 * kDegree;
  sonar.min_range = 0.5;
  sonar.max_range = 60.5;
  sonar.bin_count = 1500;
  return sonar;
}

Pose looking_down(double roll = 0) {
  Pose pose;
  pose.orientation = orientation_from_rpy(roll, 0, 0) * Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitY());
  return pose;
}

// Normal deviates that are the same but for a sliding window of `length`: as a pulse of so many bins leaves them.
class Correlated {
 public:
  Correlated(int length, std::mt19937& random) : window_(static_cast<std::size_t>(length)), random_(random) {
    std::ranges::generate(window_, [&] { return normal_(random_); });
  }
  double operator()() {
    window_[next_++ % window_.size()] = normal_(random_);
    return std::accumulate(window_.begin(), window_.end(), 0.0) / std::sqrt(static_cast<double>(window_.size()));
  }

 private:
  std::vector<double> window_;
  std::size_t next_ = 0;
  std::mt19937& random_;
  std::normal_distribution<double> normal_;
};

// Echoes of a bed whose range in each beam is given: as wide as a footprint of `width` on a level bed, of Rayleigh
// speckle, with the phase of a beam of that width.
// @param pulse  Bins that vary together.
Ping ping_of(const SonarConfig& sonar, const std::function<double(double)>& range_of, double width, double noise,
             unsigned seed, const Pose& pose = looking_down(), int pulse = 1) {
  std::mt19937 random(seed);
  Correlated normal(pulse, random), quadrature(pulse, random), of_phase(pulse, random);
  Ping ping;
  ping.beam_count = sonar.beam_count;
  ping.bin_count = sonar.bin_count;
  ping.world_from_sonar = pose;
  ping.intensity.resize(static_cast<std::size_t>(ping.beam_count) * static_cast<std::size_t>(ping.bin_count));
  ping.phase.resize(ping.intensity.size());
  for (int beam = 0; beam < ping.beam_count; ++beam) {
    const double azimuth = sonar.beam_azimuth(beam), range = range_of(azimuth);
    const double footprint = std::max(0.12, range * std::abs(std::tan(azimuth)) * width);
    for (int bin = 0; bin < ping.bin_count; ++bin) {
      const double off = (sonar.bin_range(bin) - range) / footprint;
      const double mean = std::exp(-4 * std::numbers::ln2 * off * off) + noise;
      const double u = normal(), v = quadrature();
      const std::size_t at = ping.index(bin, beam);
      ping.intensity[at] = static_cast<float>(0.5 * mean * (u * u + v * v));
      const double phase = std::copysign(0.88 * std::numbers::pi * off, azimuth * off) + 0.5 * of_phase();
      ping.phase[at] = static_cast<float>(std::remainder(phase, 2 * std::numbers::pi));
    }
  }
  return ping;
}

TEST(BottomDetectionTest, FindsALevelBedInEveryBeam) {
  const SonarConfig sonar = multibeam();
  constexpr double kDepth = 19.3;
  const Ping ping = ping_of(
      sonar, [](double a) { return kDepth / std::cos(a); }, 1.2 * kDegree, 1e-4, 7);
  const std::vector<Sounding> soundings = BottomDetector(sonar).detect(ping);
  ASSERT_EQ(soundings.size(), 81U);
  int by_phase = 0, outer_count = 0;
  for (const Sounding& sounding : soundings) {
    ASSERT_TRUE(sounding.found());
    const double azimuth = static_cast<double>(sounding.azimuth), range = kDepth / std::cos(azimuth);
    const double footprint = std::max(0.12, range * std::abs(std::tan(azimuth)) * 1.2 * kDegree);
    EXPECT_NEAR(static_cast<double>(sounding.range), range, 0.03 + 0.25 * footprint) << azimuth / kDegree;
    if (std::abs(azimuth) > 10 * kDegree) {  // Straight below, bins of one pulse would not vary independently.
      EXPECT_LT(std::abs(static_cast<double>(sounding.range) - range), 5 * static_cast<double>(sounding.uncertainty));
    }
    EXPECT_LT(sounding.snippet_begin, sounding.snippet_end);
    EXPECT_NEAR(sounding.quality, std::log10(sounding.range / sounding.uncertainty), 1e-3);
    const bool outer = std::abs(azimuth) > 45 * kDegree;
    outer_count += outer ? 1 : 0;
    by_phase += outer && sounding.detection == Detection::kPhase ? 1 : 0;
    if (std::abs(azimuth) < 3 * kDegree) {
      EXPECT_EQ(sounding.detection, Detection::kAmplitude) << azimuth / kDegree;
    }
  }
  EXPECT_GT(by_phase, 0.5 * outer_count);
}

// The deviation that detection states is that of its errors, over many pings.
TEST(BottomDetectionTest, StatesItsUncertainty) {
  const SonarConfig sonar = multibeam(31);
  constexpr double kDepth = 22.9;
  for (const int beam : {3, 8, 15, 26}) {
    const double azimuth = sonar.beam_azimuth(beam), range = kDepth / std::cos(azimuth);
    double squares = 0, stated = 0;
    constexpr int kPings = 30;
    for (int i = 0; i < kPings; ++i) {
      const Ping ping = ping_of(
          sonar, [](double a) { return kDepth / std::cos(a); }, 1.2 * kDegree, 1e-4, static_cast<unsigned>(100 + i));
      const Sounding sounding = BottomDetector(sonar).detect(ping)[static_cast<std::size_t>(beam)];
      squares += std::pow(static_cast<double>(sounding.range) - range, 2);
      stated += std::pow(static_cast<double>(sounding.uncertainty), 2);
    }
    EXPECT_GT(std::sqrt(stated / squares), 0.5) << beam;
    EXPECT_LT(std::sqrt(stated / squares), 2.5) << beam;
  }
}

// The same with pulses of 7 bins, which vary together: as many bins are fewer samples.
TEST(BottomDetectionTest, StatesItsUncertaintyWithLongPulses) {
  const SonarConfig sonar = multibeam(31);
  constexpr double kDepth = 22.9;
  constexpr int kPulse = 7, kPings = 60;
  const BottomDetector detector(sonar, {.resolution = kPulse * sonar.bin_length()});
  double ratios = 0;
  for (const int beam : {0, 1, 29, 30}) {
    const double azimuth = sonar.beam_azimuth(beam), range = kDepth / std::cos(azimuth);
    double squares = 0, stated = 0;
    int by_phase = 0;
    for (int i = 0; i < kPings; ++i) {
      const Ping ping = ping_of(
          sonar, [](double a) { return kDepth / std::cos(a); }, 1.3 * kDegree, 1e-4, static_cast<unsigned>(300 + i),
          looking_down(), kPulse);
      const Sounding sounding = detector.detect(ping)[static_cast<std::size_t>(beam)];
      by_phase += sounding.detection == Detection::kPhase ? 1 : 0;
      squares += std::pow(static_cast<double>(sounding.range) - range, 2);
      stated += std::pow(static_cast<double>(sounding.uncertainty), 2);
    }
    EXPECT_GT(by_phase, kPings / 3) << beam;
    ratios += std::sqrt(stated / squares) / 4;
  }
  EXPECT_GT(ratios, 0.8);
  EXPECT_LT(ratios, 2);
}

TEST(BottomDetectionTest, FollowsASlopeAndAStep) {
  const SonarConfig sonar = multibeam();
  const double slope = std::tan(25 * kDegree);
  const auto inclined = [&](double a) { return 18 / (std::cos(a) + slope * std::sin(a)); };
  const Ping ping = ping_of(sonar, inclined, 1.2 * kDegree, 1e-4, 3);
  for (const Sounding& sounding : BottomDetector(sonar).detect(ping)) {
    const double range = inclined(static_cast<double>(sounding.azimuth));
    if (range < 55) {
      ASSERT_TRUE(sounding.found());
      EXPECT_NEAR(static_cast<double>(sounding.range), range, 0.03 + 0.012 * range);
    }
  }
  const auto step = [](double a) { return (a > 0.2 ? 14 : 20) / std::cos(a); };
  const Ping cliff = ping_of(sonar, step, 1.2 * kDegree, 1e-4, 4);
  for (const Sounding& sounding : BottomDetector(sonar).detect(cliff)) {
    EXPECT_NEAR(static_cast<double>(sounding.range), step(static_cast<double>(sounding.azimuth)), 1);
  }
}

// Beams whose bottom is farther away than the last bin hear its near edge, or side lobes: neither is a sounding.
TEST(BottomDetectionTest, FindsNothingThatTheRangeCuts) {
  SonarConfig sonar = multibeam();
  sonar.max_range = 30.5;
  sonar.bin_count = 750;
  constexpr double kDepth = 19.3;
  const Ping ping = ping_of(
      sonar, [](double a) { return kDepth / std::cos(a); }, 1.2 * kDegree, 1e-4, 17);
  int beyond = 0;
  for (const Sounding& sounding : BottomDetector(sonar).detect(ping)) {
    const double range = kDepth / std::cos(static_cast<double>(sounding.azimuth));
    const double footprint =
        std::max(0.12, range * std::abs(std::tan(static_cast<double>(sounding.azimuth))) * 1.2 * kDegree);
    if (range > sonar.max_range) {
      EXPECT_FALSE(sounding.found()) << range;
      ++beyond;
    } else if (range < sonar.max_range - 1.5 * footprint) {
      EXPECT_TRUE(sounding.found()) << range;
    }
    if (sounding.found()) {
      EXPECT_NEAR(static_cast<double>(sounding.range), range, 0.03 + 0.35 * footprint);
    }
  }
  EXPECT_GT(beyond, 10);
  // The same where the bottom comes nearer than what is searched.
  BottomDetectionOptions options;
  options.least_range = 19.4;
  EXPECT_FALSE(BottomDetector(sonar, options).detect(ping)[40].found());
}

// Straight below the bed mirrors sound into the side lobes of all beams: a ring, stronger than their own echoes.
TEST(BottomDetectionTest, IsNotCaughtByTheRing) {
  const SonarConfig sonar = multibeam();
  constexpr double kDepth = 19.3;
  Ping ping = ping_of(
      sonar, [](double a) { return kDepth / std::cos(a); }, 1.2 * kDegree, 1e-4, 11);
  for (int beam = 0; beam < ping.beam_count; ++beam) {
    for (int bin = 468; bin < 473; ++bin) {
      ping.intensity[ping.index(bin, beam)] += 4;
    }
  }
  for (const Sounding& sounding : BottomDetector(sonar).detect(ping)) {
    const double azimuth = static_cast<double>(sounding.azimuth), range = kDepth / std::cos(azimuth);
    if (std::abs(azimuth) > 57 * kDegree) {
      EXPECT_NEAR(static_cast<double>(sounding.range), range, 0.03 * range) << azimuth / kDegree;
    }
  }
}

// The ring of an echo in the last bins ends behind them: there is no bin beyond it.
TEST(BottomDetectionTest, FindsWhatIsAtTheEndOfTheRange) {
  const SonarConfig sonar = multibeam();
  const Ping ping = ping_of(
      sonar, [](double a) { return std::abs(a) < 5 * kDegree    ? 60.3
                                   : std::abs(a) > 30 * kDegree ? 58.0
                                                                : 1000.0; },
      1.2 * kDegree, 1e-4, 12);
  const std::vector<Sounding> soundings = BottomDetector(sonar).detect(ping);
  EXPECT_TRUE(soundings[40].found());
  EXPECT_FALSE(soundings[30].found());  // 16 degrees.
  ASSERT_TRUE(soundings[21].found());   // 31 degrees.
  EXPECT_NEAR(soundings[21].range, 58, 0.5);
}

TEST(BottomDetectionTest, FindsNothingWhereThereIsNothing) {
  const SonarConfig sonar = multibeam();
  const Ping noise = ping_of(
      sonar, [](double) { return 1e3; }, 1.2 * kDegree, 1, 5);
  int found = 0;
  for (const Sounding& sounding : BottomDetector(sonar).detect(noise)) {
    found += sounding.found() ? 1 : 0;
    EXPECT_TRUE(sounding.found() || std::isnan(sounding.range));
  }
  EXPECT_LE(found, 2);
  Ping silent = noise;
  silent.intensity.assign(silent.intensity.size(), 0);
  for (const Sounding& sounding : BottomDetector(sonar).detect(silent)) {
    EXPECT_FALSE(sounding.found());
  }
  // Rolled by 60 degrees, the port beams look up.
  const Ping rolled = ping_of(
      sonar, [](double a) { return 15 / std::max(0.05, std::cos(a + 60 * kDegree)); }, 1.2 * kDegree, 1e-4, 6,
      looking_down(60 * kDegree));
  const std::vector<Sounding> soundings = BottomDetector(sonar).detect(rolled);
  EXPECT_FALSE(soundings.front().found());
  EXPECT_TRUE(soundings.back().found());
}

TEST(BottomDetectionTest, LooksWhereItIsTold) {
  const SonarConfig sonar = multibeam();
  const Ping ping = ping_of(
      sonar, [](double a) { return 12 / std::cos(a); }, 1.2 * kDegree, 1e-4, 8);
  for (const Sounding& sounding : BottomDetector(sonar, {.least_range = 35}).detect(ping)) {
    EXPECT_FALSE(sounding.found());
  }
  EXPECT_THROW(BottomDetector(sonar, {.least_range = -1}), Error);
  EXPECT_THROW(BottomDetector(sonar, {.least_range = 5, .greatest_range = 5}), Error);
  EXPECT_THROW(BottomDetector(sonar, {.resolution = NAN}), Error);
  Ping other = ping;
  other.beam_count = 80;
  EXPECT_THROW(BottomDetector(sonar).detect(other), Error);
}

TEST(BottomDetectionTest, PlacesSoundingsInTheWorld) {
  Sounding sounding;
  sounding.azimuth = static_cast<float>(30 * kDegree);
  sounding.range = 20;
  Pose pose = looking_down();
  pose.position = {3, 4, -5};
  const Vec3 at = position_of(sounding, pose, 1.01);
  EXPECT_NEAR((at - Vec3(3, 4 + 20.2 * 0.5, -5 - 20.2 * std::cos(30 * kDegree))).norm(), 0, 1e-5);
}

}  // namespace
}  // namespace insonify::bottom_detection_test
