// refraction_test.cpp -- true and apparent places: each the inverse of the other, and the tables of the exact rays.

#include "echo/model/refraction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace insonify::refraction_test {
namespace {

constexpr double kReach = 80, kDepth = 12;

std::shared_ptr<const SoundSpeedProfile> summer() {
  const ProfilePoint points[] = {{.depth = 0, .sound_speed = 1516},
                                 {.depth = 9, .sound_speed = 1516},
                                 {.depth = 16, .sound_speed = 1493},
                                 {.depth = 60, .sound_speed = 1489}};
  return std::make_shared<const SoundSpeedProfile>(points);
}

class RefractionTest : public testing::Test {
 protected:
  Workers workers{2};
  const Vec3 sonar{5, -3, -2};
  const std::shared_ptr<const SoundSpeedProfile> water = summer();
  const Refraction refraction{water, sonar, sonar.z() + kDepth, water->speed_at(kDepth), kReach, workers};

  std::mt19937 random{5};
  Vec3 place() {  // Within the reach, and between the surface and 45 m.
    std::uniform_real_distribution<double> level(-50, 50), height(-30, 11);
    return sonar + Vec3(level(random), level(random), height(random));
  }
};

TEST_F(RefractionTest, TrueAndApparentPlacesAreInverse) {
  int seen = 0;
  for (int i = 0; i < 200; ++i) {
    const Vec3 there = place();
    if (const auto apparent = refraction.apparent_place(there)) {
      EXPECT_LT((refraction.true_place(*apparent) - there).norm(), 1e-7);
      ++seen;
    }
  }
  EXPECT_GT(seen, 150);
}

TEST_F(RefractionTest, TablesGiveTheExactRays) {
  for (int i = 0; i < 2000; ++i) {
    const Vec3 apparent = place();
    const Vec3 exact = refraction.true_place(apparent);
    const Vec3 look_up = sonar + refraction.true_offset((apparent - sonar).cast<float>()).cast<double>();
    constexpr double kNearTurns = 5e-3;  // [m] Where launch angles a table step apart turn back metres apart.
    EXPECT_LT((look_up - exact).norm(), kNearTurns) << apparent.transpose();
  }
}

// A ray's direction where it arrives becomes that in which it left; lengths and bearings stay.
TEST_F(RefractionTest, DirectionsTurnAsTheRayDoes) {
  for (int i = 0; i < 200; ++i) {
    const Vec3 apparent = place(), launch = (apparent - sonar).normalized();
    const RayPoint there =
        water->after_time(kDepth, std::asin(-launch.z()), (apparent - sonar).norm() / water->speed_at(kDepth));
    const Vec3 level = Vec3(launch.x(), launch.y(), 0).normalized();
    const Vec3 arrival = std::cos(there.angle) * level - std::sin(there.angle) * Vec3::UnitZ();
    EXPECT_LT((refraction.apparent_direction(apparent, arrival) - launch).norm(), 1e-9);
    const Vec3f by_table =
        refraction.apparent_direction(Vec3f((apparent - sonar).cast<float>()), Vec3f(arrival.cast<float>()));
    EXPECT_LT((by_table.cast<double>() - launch).norm(), 2e-3);
    const Vec3 across = level.cross(Vec3::UnitZ());
    EXPECT_LT((refraction.apparent_direction(apparent, across) - across).norm(), 1e-12);
  }
}

// Chords of 1.15 m are off a bend of R = 1493/(23/7) = 454 m by L^2/(8 R) = .00025 m at most.
TEST_F(RefractionTest, ChordsKeepToTheRay) {
  const double longest = std::sqrt(8 * Refraction::kOffChord * 1493 / (23.0 / 7));
  EXPECT_LE(double{refraction.chord()}, longest);
  EXPECT_GT(double{refraction.chord()}, 0.98 * longest);
}

TEST_F(RefractionTest, SonarsAtOneDepthShareTables) {
  const Refraction beside(water, sonar + Vec3(7, 2, 0), sonar.z() + kDepth, water->speed_at(kDepth), kReach, workers,
                          &refraction);
  const Vec3f there(20, 3, -10);
  EXPECT_EQ(beside.true_offset(there), refraction.true_offset(there));
}

}  // namespace
}  // namespace insonify::refraction_test
