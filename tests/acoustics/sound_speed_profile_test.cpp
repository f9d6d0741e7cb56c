// sound_speed_profile_test.cpp -- rays through layers: closed forms, quadrature, shadow zones, reciprocity.

#include "insonify/acoustics/sound_speed_profile.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "insonify/acoustics/sound_speed.h"
#include "insonify/geometry.h"
#include "support/message_of.h"
#include "support/relative.h"

namespace insonify::sound_speed_profile_test {
namespace {

SoundSpeedProfile profile_of(const std::vector<std::pair<double, double>>& speeds) {
  std::vector<ProfilePoint> points;
  for (const auto& [depth, speed] : speeds) {
    points.push_back({.depth = depth, .sound_speed = speed});
  }
  return SoundSpeedProfile(points);
}

// From 50 m to 150 m, with a speed at the depth of 100 m.
SoundSpeedProfile linear(double speed, double gradient) {
  return profile_of({{50, speed - 50 * gradient}, {150, speed + 50 * gradient}});
}

// A summer's thermocline under a mixed layer, a channel, and water that gets faster towards the bed.
SoundSpeedProfile summer() {
  return profile_of({{2, 1518}, {12, 1518.2}, {18, 1496}, {30, 1488}, {45, 1488}, {80, 1489.5}, {120, 1490}});
}

// ---------------------------------------------------------------- Closed forms

struct Bend {
  double speed, gradient, launch_deg, distance, drop, time;
};
// From the physics reference: an arc of a circle, checked there by Runge-Kutta's method.
constexpr Bend kBends[] = {{1500, -1, 0, 50, .8335649435050052, .033345687249336106},
                           {1520, -2, 5, 60, 7.656306010055174, .03998507733566325},
                           {1490, .5, -3, 40, -2.36570656856449, .02690302567400217}};

TEST(SoundSpeedProfileTest, RaysAreTheArcsOfTheReference) {
  for (const Bend& bend : kBends) {
    const SoundSpeedProfile water = linear(bend.speed, bend.gradient);
    const double launch = radians_from_degrees(bend.launch_deg);
    const RayPoint there = water.at_distance(100, launch, bend.distance);
    EXPECT_THAT(there.depth - 100, RelativelyNear(bend.drop));
    EXPECT_THAT(there.time, RelativelyNear(bend.time));
    const RayPoint then = water.after_time(100, launch, bend.time);
    EXPECT_THAT(then.depth - 100, RelativelyNear(bend.drop));
    EXPECT_THAT(then.distance, RelativelyNear(bend.distance));
    const auto back = water.eigenray(100, 100 + bend.drop, bend.distance);
    ASSERT_TRUE(back);
    EXPECT_NEAR(back->launch_angle, launch, 1e-12);
    EXPECT_THAT(back->time, RelativelyNear(bend.time));
  }
}

// Uniform water: a straight line of c t, whatever the angle, also straight down.
TEST(SoundSpeedProfileTest, RaysAreStraightWhereSpeedIsConstant) {
  const SoundSpeedProfile water = profile_of({{10, 1480}});
  EXPECT_TRUE(water.is_constant());
  for (const double launch_deg : {-90.0, -35.0, 0.0, 1e-9, 89.99, 90.0}) {
    const double launch = radians_from_degrees(launch_deg);
    const RayPoint there = water.after_time(40, launch, 0.05);
    EXPECT_NEAR(there.distance, 74 * std::cos(launch), 1e-12);
    EXPECT_NEAR(there.depth, 40 + 74 * std::sin(launch), 1e-12);
    EXPECT_EQ(there.angle, launch);
  }
}

// Straight down through linear water: t = ln(c1/c0)/g.
TEST(SoundSpeedProfileTest, TheVerticalRayTakesTheIntegralOfSlowness) {
  const SoundSpeedProfile water = profile_of({{0, 1520}, {50, 1480}, {90, 1492}});
  const double first = std::log(1480.0 / 1520) / (-40.0 / 50), second = std::log(1492.0 / 1480) / (12.0 / 40);
  const auto ray = water.eigenray(0, 90, 0);
  ASSERT_TRUE(ray);
  EXPECT_THAT(ray->time, RelativelyNear(first + second));
  const RayPoint end = water.after_time(0, std::numbers::pi / 2, first + second);
  EXPECT_NEAR(end.depth, 90, 1e-10);
  EXPECT_NEAR(end.distance, 0, 1e-10);
}

// ---------------------------------------------------------------- Numerically sound

// To first order in a gradient g a ray of launch angle a and time t sinks by -g (c t cos a)^2/(2 c) across its chord.
TEST(SoundSpeedProfileTest, TinyGradientsBendByTheirFirstOrder) {
  constexpr double kGradient = 1e-9, kTime = 0.06;
  const SoundSpeedProfile water = linear(1500, kGradient);
  for (const double launch : {-0.3, -1e-8, 0.0, 1e-8, 0.2, 0.5}) {
    const RayPoint there = water.after_time(100, launch, kTime);
    const double length = 1500 * kTime;
    EXPECT_NEAR(there.distance, length * std::cos(launch), 2e-8);
    EXPECT_NEAR(there.depth, 100 + length * std::sin(launch), 2e-8);
    const double turned = -kGradient * std::cos(launch) * kTime;
    EXPECT_NEAR(there.angle - launch, turned, 1e-15);
  }
}

TEST(SoundSpeedProfileTest, NearlyVerticalRaysReachTheirTarget) {
  const SoundSpeedProfile water = summer();
  for (const double distance : {1e-7, 1e-4, 0.01, 0.5}) {
    const auto ray = water.eigenray(5, 110, distance);
    ASSERT_TRUE(ray) << distance;
    const RayPoint there = water.after_time(5, ray->launch_angle, ray->time);
    EXPECT_NEAR(there.depth, 110, 1e-9) << distance;
    EXPECT_NEAR(there.distance, distance, 1e-9) << distance;
  }
}

// Where speed is least the axis of a channel is a ray.
TEST(SoundSpeedProfileTest, TheAxisOfAChannelIsARay) {
  const SoundSpeedProfile water = profile_of({{0, 1510}, {50, 1480}, {100, 1500}});
  for (const double launch : {0.0, 1e-12, -1e-9}) {
    const RayPoint there = water.after_time(50, launch, 0.2);
    EXPECT_NEAR(there.distance, 296, 1e-9);
    EXPECT_NEAR(there.depth, 50, 1e-6);
  }
}

// A ray that has travelled for one time and then for another is where it is after both.
TEST(SoundSpeedProfileTest, WaysAddUp) {
  const SoundSpeedProfile water = summer();
  for (const double launch : {-0.4, -0.05, -0.001, 0.001, 0.02, 0.3, 1.2}) {
    const RayPoint half = water.after_time(31, launch, 0.09), whole = water.after_time(31, launch, 0.2);
    const RayPoint rest = water.after_time(half.depth, half.angle, 0.11);
    EXPECT_NEAR(half.distance + rest.distance, whole.distance, 1e-8);
    EXPECT_NEAR(rest.depth, whole.depth, 1e-8);
    const RayPoint by_distance = water.at_distance(31, launch, whole.distance);
    EXPECT_NEAR(by_distance.depth, whole.depth, 1e-8);
    EXPECT_NEAR(by_distance.time, 0.2, 1e-11);
  }
}

// ---------------------------------------------------------------- Against integration

using Speeds = std::vector<std::pair<double, double>>;
using State = std::array<double, 3>;  // Distance, depth, angle.

// One step of the classical method of Runge and Kutta for the equations of a ray, dx/dt = c cos, dz/dt = c sin,
// d(angle)/dt = -dc/dz cos, in water of linear speed.
State stepped(const State& at, double step, double depth, double speed, double gradient) {
  const auto slope = [&](const State& s) {
    const double here = speed + gradient * (s[1] - depth);
    return State{here * std::cos(s[2]), here * std::sin(s[2]), -gradient * std::cos(s[2])};
  };
  const auto plus = [&](const State& d, double by) {
    return State{at[0] + by * d[0], at[1] + by * d[1], at[2] + by * d[2]};
  };
  const State a = slope(at), b = slope(plus(a, step / 2)), c = slope(plus(b, step / 2)), d = slope(plus(c, step));
  State next = at;
  for (std::size_t k = 0; k < at.size(); ++k) {
    next[k] += step / 6 * (a[k] + 2 * b[k] + 2 * c[k] + d[k]);
  }
  return next;
}

// The ray by small steps, which end where layers end: found by halving the step.
State integrated(const Speeds& speeds, double depth, double launch, double time) {
  std::size_t layer = 0;  // Above the first point; the last is below the last.
  while (layer < speeds.size() && depth > speeds[layer].first) {
    ++layer;
  }
  State at{0, depth, launch};
  for (double rest = time; rest > 0;) {
    const bool inside = layer > 0 && layer < speeds.size();
    const auto [z, c] = speeds[layer > 0 ? layer - 1 : 0];
    const double gradient = inside ? (speeds[layer].second - c) / (speeds[layer].first - z) : 0;
    const double top = layer > 0 ? z : -1e9, bottom = layer < speeds.size() ? speeds[layer].first : 1e9;
    const auto leaves = [&](const State& s) { return s[1] < top ? -1 : s[1] > bottom ? 1 : 0; };
    double step = std::min(rest, time / 4000);
    State next = stepped(at, step, z, c, gradient);
    if (const int way = leaves(next); way != 0) {
      double least = 0;
      for (int i = 0; i < 60; ++i) {
        const double middle = (least + step) / 2;
        (leaves(stepped(at, middle, z, c, gradient)) != 0 ? step : least) = middle;
      }
      next = stepped(at, step, z, c, gradient);
      layer += static_cast<std::size_t>(way);
    }
    at = next;
    rest -= step;
  }
  return at;
}

TEST(SoundSpeedProfileTest, TwentyRaysAreThoseOfRungeAndKutta) {
  const Speeds speeds = {{0, 1515}, {8, 1514}, {15, 1492}, {40, 1486}, {150, 1489}};
  const SoundSpeedProfile water = profile_of(speeds);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> depth(1, 140), launch(-0.6, 1.4), time(0.01, 0.15);
  for (int i = 0; i < 20; ++i) {
    const double z = depth(random), a = launch(random), t = time(random);
    const RayPoint exact = water.after_time(z, a, t);
    const State expected = integrated(speeds, z, a, t);
    EXPECT_NEAR(exact.distance, expected[0], 1e-8) << i;
    EXPECT_NEAR(exact.depth, expected[1], 1e-8) << i;
    EXPECT_NEAR(exact.angle, expected[2], 1e-9) << i;
  }
}

// By Snell's law a ray without a turn covers dx = dz p c/sqrt(1 - p^2 c^2) in dt = dz/(c sqrt(1 - p^2 c^2)).
TEST(SoundSpeedProfileTest, TimeAndDistanceAreTheIntegralsOverDepth) {
  const SoundSpeedProfile water = summer();
  for (const double launch : {0.35, 0.8, 1.3}) {
    const double slowness = std::cos(launch) / water.speed_at(3);
    double distance = 0, time = 0;
    constexpr int kCells = 400'000;  // Of the midpoint rule, whose cells end where layers do.
    for (int i = 0; i < kCells; ++i) {
      const double step = (118.0 - 3) / kCells, speed = water.speed_at(3 + (i + 0.5) * step);
      const double sine = std::sqrt(1 - slowness * slowness * speed * speed);
      distance += step * slowness * speed / sine;
      time += step / (speed * sine);
    }
    const auto ray = water.eigenray(3, 118, distance);
    ASSERT_TRUE(ray);
    EXPECT_NEAR(ray->launch_angle, launch, 1e-9);
    EXPECT_THAT(ray->time, RelativelyNear(time));
  }
}

// ---------------------------------------------------------------- Shadow zones

// Speed falls from 1520 m/s at the surface by 0.5 m/s a metre. The ray from 20 m that grazes the surface is a circle of
// R = 1520/0.5 = 3040 m. It meets the surface after sqrt(R^2 - (R - 20)^2) and a depth of 30 m after
// sqrt(R^2 - (R - 30)^2) more; nothing without a reflection gets further there.
TEST(SoundSpeedProfileTest, TheShadowBeginsWhereTheRayThatGrazesTheSurfaceSinks) {
  const SoundSpeedProfile water = profile_of({{0, 1520}, {400, 1320}});
  constexpr double kRadius = 3040;
  const auto reach = [](double depth) { return std::sqrt(kRadius * kRadius - std::pow(kRadius - depth, 2)); };
  const double edge = reach(20) + reach(30);
  EXPECT_TRUE(water.eigenray(20, 30, edge - 1e-3));
  EXPECT_FALSE(water.eigenray(20, 30, edge + 1e-3));
  EXPECT_FALSE(water.eigenray(20, 30, 2 * edge));
  EXPECT_TRUE(water.eigenray(20, 300, edge + 1e-3));
}

TEST(SoundSpeedProfileTest, RaysAreReciprocal) {
  const SoundSpeedProfile water = summer();
  std::mt19937 random(11);
  std::uniform_real_distribution<double> depth(1, 118), distance(0.1, 150);
  for (int i = 0; i < 30; ++i) {
    const double a = depth(random), b = depth(random), x = distance(random);
    const auto there = water.eigenray(a, b, x), back = water.eigenray(b, a, x);
    ASSERT_EQ(there.has_value(), back.has_value()) << i;
    if (there) {
      EXPECT_THAT(there->time, RelativelyNear(back->time)) << i;
      EXPECT_NEAR(there->launch_angle, -back->arrival_angle, 1e-6) << i;
      EXPECT_NEAR(there->arrival_angle, -back->launch_angle, 1e-6) << i;
    }
  }
}

// In a channel several rays meet: 10 m above its axis and 10 m below, the one that has turned least is not always
// first.
TEST(SoundSpeedProfileTest, TheEarliestOfSeveralRaysIsFound) {
  const SoundSpeedProfile water = profile_of({{0, 1560}, {50, 1480}, {100, 1560}});
  const auto ray = water.eigenray(50, 50, 300);
  ASSERT_TRUE(ray);
  for (double angle = -0.5; angle < 0.5; angle += 1e-3) {
    const RayPoint there = water.at_distance(50, angle, 300);
    if (std::abs(there.depth - 50) < 0.05) {
      EXPECT_LE(ray->time, there.time + 1e-5);
    }
  }
}

// ---------------------------------------------------------------- Input

TEST(SoundSpeedProfileTest, SpeedIsLinearBetweenPointsAndConstantBeyond) {
  const SoundSpeedProfile water = profile_of({{10, 1500}, {20, 1480}});
  EXPECT_EQ(water.speed_at(0), 1500);
  EXPECT_EQ(water.speed_at(15), 1490);
  EXPECT_EQ(water.speed_at(900), 1480);
  EXPECT_EQ(water.first_depth(), 10);
  EXPECT_EQ(water.last_depth(), 20);
  EXPECT_FALSE(water.is_constant());
  EXPECT_EQ(water.least_radius(), 740);  // 1480 m/s over 2 1/s.
}

TEST(SoundSpeedProfileTest, TemperatureAndSalinityGiveTheSpeedOfChenAndMillero) {
  const ProfilePoint point{.depth = 100, .temperature_c = 10, .salinity = 35};
  EXPECT_EQ(point.speed(), chen_millero_sound_speed(10, 35, 100));
}

TEST(SoundSpeedProfileTest, SaysWhatIsWrongWithAPoint) {
  const auto fault = [](const std::vector<ProfilePoint>& points) {
    return message_of([&] { check_profile(points, "water.profile"); });
  };
  const ProfilePoint first{.depth = 5, .sound_speed = 1500};
  EXPECT_EQ(fault({first, {.depth = 5, .sound_speed = 1500}}),
            "water.profile[1].depth = 5 m must be greater than water.profile[0].depth = 5 m");
  EXPECT_EQ(fault({first, {.depth = NAN, .sound_speed = 1500}}),
            "water.profile[1].depth = nan m must be from 0 to 12000 m");
  EXPECT_EQ(fault({first, {.depth = 9, .sound_speed = 1701}}),
            "water.profile[1].sound_speed = 1701 m/s must be from 1300 to 1700 m/s");
  EXPECT_EQ(fault({{.depth = -1, .sound_speed = 1500}}), "water.profile[0].depth = -1 m must be from 0 to 12000 m");
  EXPECT_EQ(fault({{.depth = 1, .temperature_c = 4}}),
            "water.profile[0] must have a sound_speed, or temperature_c and salinity");
  EXPECT_EQ(fault({first, {.depth = 5.1, .sound_speed = 1511}}),
            "water.profile[1] changes by 110 m/s in each metre from water.profile[0]; must be at most 100 m/s");
  EXPECT_EQ(message_of([] { (void)SoundSpeedProfile({}); }), "profile must have a point");
}

}  // namespace
}  // namespace insonify::sound_speed_profile_test
