// path_footprint_test.cpp -- footprint segments of paths by way of a mirror, against neighbouring paths traced exactly.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "echo/laws/laws.h"

namespace insonify::path_footprint_test {
namespace {

Triple triple(const Vec3& v) {
  return triple_of(v.cast<float>());
}

struct Plane {
  Vec3 normal;
  double offset;

  [[nodiscard]] double distance(const Vec3& from, const Vec3& direction) const {
    return (offset - normal.dot(from)) / normal.dot(direction);
  }
};

// A path from the origin by way of a mirror to a plane and straight back, with its lengths.
struct Path {
  MirrorSample sample;
  PathEnd end;
  double whole, there;  // Length of the closed path, and one way by the mirror [m].

  Path(const Vec3& direction, const Vec3& normal, double range, const Plane& second) {
    const Vec3 reflected = direction - 2 * direction.dot(normal) * normal;
    const double across = second.distance(range * direction, reflected);
    const Vec3 point = range * direction + across * reflected;
    there = range + across;
    whole = there + point.norm();
    sample = mirror_sample(triple(direction), triple(normal), static_cast<float>(range));
    end = {static_cast<float>(across), triple(reflected),         triple(second.normal),
           triple(point.normalized()), static_cast<float>(there), static_cast<float>(point.norm())};
  }
};

Path by_plane(const Vec3& direction, const Plane& mirror, const Plane& second) {
  return {direction, mirror.normal, mirror.distance(Vec3::Zero(), direction), second};
}

Path by_sphere(const Vec3& direction, const Vec3& centre, double radius, const Plane& second) {
  const double nearest = direction.dot(centre);
  const double range = nearest - std::sqrt(nearest * nearest - centre.squaredNorm() + radius * radius);
  return {direction, (range * direction - centre).normalized(), range, second};
}

Vec3 towards(double azimuth_deg, double elevation_deg) {
  const double degree = std::numbers::pi / 180, a = azimuth_deg * degree, e = elevation_deg * degree;
  return {std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)};
}

constexpr double kStep = 0.02;  // [deg]

// Checks the footprint of one change (along or across the column, in either argument) against the difference of the
// lengths of both paths.
void expect_change(const Path& here, const Path& beside) {
  const MirrorChange change = mirror_change(here.sample, beside.sample);
  const double once = 0.25 * std::abs(beside.whole - here.whole);
  const double twice = 0.5 * std::abs(beside.there - here.there);
  for (const auto& [footprint, rows] : {std::pair(path_footprint({}, 1, change, here.end), 1.0),
                                        std::pair(path_footprint(change, 1, {}, here.end), 1.0),
                                        std::pair(path_footprint(change, 3, {}, here.end), 3.0)}) {
    EXPECT_NEAR(footprint.once, rows * once, 0.02 * rows * once + 2e-6);
    EXPECT_NEAR(footprint.twice, rows * twice, 0.02 * rows * twice + 2e-6);
  }
}

TEST(PathFootprintTest, MatchesTracedPathsByPlanes) {
  const Plane floor{Vec3(0.1, -0.05, 1).normalized(), -3}, wall{Vec3(1, 0.3, 0.1).normalized(), 14};
  for (const double azimuth : {-30.0, 0.0, 25.0}) {
    for (const double elevation : {-40.0, -25.0}) {
      const Path here = by_plane(towards(azimuth, elevation), floor, wall);
      expect_change(here, by_plane(towards(azimuth, elevation + kStep), floor, wall));
      expect_change(here, by_plane(towards(azimuth + kStep, elevation), floor, wall));
      EXPECT_GT(std::abs(by_plane(towards(azimuth, elevation + kStep), floor, wall).whole - here.whole), 1e-4);
    }
  }
}

TEST(PathFootprintTest, MatchesTracedPathsBySpheres) {
  const Vec3 centre(6, 0.5, -1);
  const Plane floor{Vec3::UnitZ(), -3};
  constexpr double kLittle = 0.1 * kStep;  // Smaller steps, because a sphere makes rays diverge strongly.
  for (const double elevation : {-13.0, -12.0, -11.0}) {
    const Path here = by_sphere(towards(4, elevation), centre, 0.5, floor);
    ASSERT_GT(here.end.across, 0);
    expect_change(here, by_sphere(towards(4, elevation + kLittle), centre, 0.5, floor));
    expect_change(here, by_sphere(towards(4 + kLittle, elevation), centre, 0.5, floor));
  }
}

TEST(PathFootprintTest, BothChangesAddAsVariances) {
  const Plane floor{Vec3::UnitZ(), -3}, wall{Vec3::UnitX(), 14};
  const Path here = by_plane(towards(10, -25), floor, wall);
  const MirrorChange above = mirror_change(here.sample, by_plane(towards(10, -24.98), floor, wall).sample);
  const MirrorChange across = mirror_change(here.sample, by_plane(towards(10.05, -25), floor, wall).sample);
  const float up = path_footprint(above, 1, {}, here.end).once, side = path_footprint({}, 1, across, here.end).once;
  EXPECT_NEAR(path_footprint(above, 2, across, here.end).once, std::hypot(2 * up, side), 1e-6);
}

// In a corner, all specular double-bounce paths have the length of the path to the apex and back.
TEST(PathFootprintTest, VanishesAtTheApexOfACorner) {
  const Plane mirror{Vec3::UnitX(), 8}, second{Vec3::UnitY(), 6};
  const double apex = 36.86989764584402;
  const Path at_apex = by_plane(towards(apex - 0.01, 0), mirror, second);
  const Path beside = by_plane(towards(apex - 0.05, 0), mirror, second);
  const Path off = by_plane(towards(apex - 10, 0), mirror, second);
  const auto segment = [](const Path& from, const Path& to) {
    return path_footprint({}, 1, mirror_change(from.sample, to.sample), from.end).once;
  };
  EXPECT_LT(segment(at_apex, beside), 2e-6);
  EXPECT_GT(segment(off, by_plane(towards(apex - 10.04, 0), mirror, second)), 2e-4);
}

TEST(PathFootprintTest, IsZeroAcrossAnEdge) {
  const MirrorSample wall = mirror_sample({1, 0, 0}, {-1, 0, 0}, 5);
  const MirrorSample behind = mirror_sample({0.9999995F, 0.001F, 0}, {-1, 0, 0}, 9);
  const MirrorSample turned = mirror_sample({0.9999995F, 0.001F, 0}, {0, -1, 0}, 5);
  for (const MirrorSample& beside : {behind, turned}) {
    const MirrorChange change = mirror_change(wall, beside);
    EXPECT_EQ(change.range, 0);
    EXPECT_EQ(dot(change.place, change.place), 0);
    EXPECT_EQ(dot(change.turn, change.turn), 0);
  }
}

TEST(PathFootprintTest, IsAtMostATwentiethOfThePath) {
  MirrorChange wild = {};
  wild.turn = {0, 0, 0.5F};
  const PathEnd end{4, {0, 0, -1}, {0, 0, 1}, {0, 0.6F, -0.8F}, 9, 6};
  const PathFootprint footprint = path_footprint(wild, 1, wild, end);
  EXPECT_FLOAT_EQ(footprint.once, 0.025F * 15);
  EXPECT_FLOAT_EQ(footprint.twice, 0.025F * 18);
}

// One row's change is known; that of the rows beyond is extrapolated, at most to a two hundredth of the path.
TEST(PathFootprintTest, IsExtrapolatedToATwoHundredthOfThePath) {
  MirrorChange slight = {};
  slight.turn = {0, 0, 0.02F};
  const PathEnd end{4, {0, 0, -1}, {0, 0, 1}, {0, 0.6F, -0.8F}, 9, 6};
  const PathFootprint one = path_footprint(slight, 1, {}, end), many = path_footprint(slight, 16, {}, end);
  EXPECT_FLOAT_EQ(path_footprint(slight, 2, {}, end).twice, std::min(2 * one.twice, 0.0025F * 18));
  EXPECT_FLOAT_EQ(many.once, 0.0025F * 15);
  EXPECT_FLOAT_EQ(many.twice, 0.0025F * 18);
  MirrorChange strong = slight;
  strong.turn = {0, 0, 0.2F};
  EXPECT_FLOAT_EQ(path_footprint(strong, 16, {}, end).twice, path_footprint(strong, 1, {}, end).twice);
}

// At grazing incidence on the second surface, the angle is limited from below.
TEST(PathFootprintTest, IsBoundedAtGrazingIncidence) {
  const MirrorChange change{0, {0, 0, 0.001F}, {}};
  const auto segment = [&](float sine) {
    const PathEnd end{4, {std::sqrt(1 - sine * sine), 0, sine}, {0, 0, 1}, {1, 0, 0}, 9, 6};
    return path_footprint(change, 1, {}, end).twice;
  };
  EXPECT_FLOAT_EQ(segment(0.4F), 0.25F * 2 * 0.001F / 0.4F);
  EXPECT_FLOAT_EQ(segment(1e-4F), 0.25F * 2 * 0.001F / 0.2F);
  EXPECT_FLOAT_EQ(segment(-1e-4F), 0.25F * 2 * 0.001F / 0.2F);
}

}  // namespace
}  // namespace insonify::path_footprint_test
