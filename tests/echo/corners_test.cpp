// corners_test.cpp -- corners of three mirrors: where they are found, and how much they reflect back.

#include "echo/targets/corners.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "echo/trihedral.h"

namespace insonify::corners_test {
namespace {

constexpr double kWavelength = 1500 / 720e3;

Instance instance_of(Mesh mesh, const Pose& pose = {}) {
  Instance instance;
  instance.name = "part";
  instance.mesh = std::make_shared<const Mesh>(std::move(mesh));
  instance.world_from_mesh = pose;
  instance.materials = {0};
  return instance;
}

Scene scene_of_parts(std::vector<Instance> parts) {
  Scene scene;
  scene.materials.emplace_back();
  scene.instances = std::move(parts);
  return scene;
}

std::vector<Corner> corners_of(const Scene& scene, const std::optional<WaterMirror>& water) {
  Workers workers(2);
  std::vector<PlaneMirror> still = find_plane_mirrors(scene, -1, workers);
  return find_corners(scene, still, water, workers);
}

const Pose kPose{.position = {104.3, -51.2, -7.7}, .orientation = orientation_from_rpy(0.31, -0.52, 1.9)};

Corner only_corner(const Scene& scene) {
  const std::vector<Corner> corners = corners_of(scene, {});
  EXPECT_EQ(corners.size(), 1U);
  return corners.at(0);
}

// Area of the outline, from the far field A^2 / (lambda^2 r^4).
double area_of(const Corner& corner, const Vec3& sight) {
  const double range = 1e6;
  return std::sqrt(corner.reflected(sight, range, kWavelength)) * kWavelength * range * range;
}

// PHYSICS of a triangular corner on its axis: a^4 / (3 lambda^2), of a square one 3 a^4 / lambda^2.
TEST(CornerTest, HasTheTargetStrengthOfTheBooksOnItsAxis) {
  const Vec3 axis = Vec3::Ones().normalized();
  for (const double edge : {0.07, 0.32}) {
    const double wavelength = 1500 / 375e3, range = 1e4, fourth = std::pow(edge, 4) / (wavelength * wavelength);
    for (const bool square : {false, true}) {
      const Corner corner = only_corner(scene_of_parts({instance_of(trihedral(edge, square), kPose)}));
      EXPECT_TRUE(corner.apex.isApprox(kPose.position, 1e-6));
      const double cross_section = corner.reflected(axis, range, wavelength) * std::pow(range, 4);
      EXPECT_NEAR(10 * std::log10(cross_section / (square ? 3 * fourth : fourth / 3)), 0, 0.02);
    }
  }
  // .1 m at 720 kHz: 10 log10(1e-4 / (3 x 4.3403e-6)) = 8.854 dB.
  const Corner corner = only_corner(scene_of_parts({instance_of(trihedral(0.1, false))}));
  EXPECT_NEAR(10 * std::log10(corner.reflected(axis, 1e4, kWavelength) * 1e16), 8.8536, 0.02);
}

// Spencer (1944); Siegel et al. (1959): with the direction cosines l <= m <= n of the line of sight, sum s,
//     A = a^2 (s - 2/s) where n <= l + m, else a^2 4 l m / s.
TEST(CornerTest, TriangularOutlineFollowsSpencersFormula) {
  const double edge = 0.23;
  const Corner corner = only_corner(scene_of_parts({instance_of(trihedral(edge, false), kPose)}));
  for (const Vec3& direction : {Vec3(1, 1, 1), Vec3(1, 2, 2.5), Vec3(3, 1, 2.2), Vec3(1, 1, 4), Vec3(0.3, 1, 2)}) {
    const Vec3 sight = direction.normalized();
    std::array<double, 3> c = {sight.x(), sight.y(), sight.z()};
    std::ranges::sort(c);
    const double s = c[0] + c[1] + c[2];
    const double area = edge * edge * (c[2] <= c[0] + c[1] ? s - 2 / s : 4 * c[0] * c[1] / s);
    EXPECT_NEAR(area_of(corner, sight) / area, 1, 0.004) << direction.transpose();
  }
}

// By brute force: parallel rays that meet three mirrors one after the other and leave where they came from. Mirrors of
// unequal sides.
TEST(CornerTest, OutlineIsThatOfTheRaysThatComeBack) {
  const Vec3 sides(0.2, 0.35, 0.5);
  std::vector<Instance> walls;
  for (int k = 0; k < 3; ++k) {
    const double one = sides[(k + 1) % 3], two = sides[(k + 2) % 3];
    Mesh mesh = make_plane(Vec3::Unit(k), 1, 1);
    for (Vec3f& vertex : mesh.vertices) {
      vertex = (vertex.array() > 0).select(sides.cast<float>(), Vec3f::Zero());
      vertex[k] = 0;
    }
    EXPECT_GT(one * two, 0);
    walls.push_back(instance_of(std::move(mesh)));
  }
  const Corner corner = only_corner(scene_of_parts(std::move(walls)));
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const Vec3& direction : {Vec3(1, 1, 1), Vec3(1, 2, 0.7), Vec3(0.4, 0.5, 2)}) {
    const Vec3 sight = direction.normalized(), one = sight.unitOrthogonal(), two = sight.cross(one);
    constexpr int kRays = 200'000;
    int back = 0;
    for (int i = 0; i < kRays; ++i) {
      Vec3 place = uniform(random) * one + uniform(random) * two + 5 * sight, way = -sight;
      int mirrors = 0;
      for (int bounce = 0; bounce < 3; ++bounce) {
        double nearest = 1e9;
        int hit = -1;
        for (int k = 0; k < 3; ++k) {
          const double distance = -place[k] / way[k];
          const Vec3 there = place + distance * way;
          const bool inside = there[(k + 1) % 3] >= 0 && there[(k + 1) % 3] <= sides[(k + 1) % 3] &&
                              there[(k + 2) % 3] >= 0 && there[(k + 2) % 3] <= sides[(k + 2) % 3];
          if (distance > 1e-9 && distance < nearest && inside) {
            nearest = distance;
            hit = k;
          }
        }
        if (hit < 0) {
          break;
        }
        place += nearest * way;
        way[hit] *= -1;
        mirrors |= 1 << hit;
      }
      back += mirrors == 7 ? 1 : 0;
    }
    const double share = static_cast<double>(back) / kRays, area = 4 * share;
    const double sigma = std::sqrt((1 - share) / (share * kRays));
    EXPECT_NEAR(area_of(corner, sight) / area, 1, 4 * sigma + 0.004) << direction.transpose();
  }
}

// Near the corner the echo is that of the image in the apex, 1/(4 r^2), with the ripples of Fresnel diffraction: for a
// round outline |1 - e^(i A k / (pi r))|^2 times that.
TEST(CornerTest, NearItIsTheImageInTheApex) {
  const Corner corner = only_corner(scene_of_parts({instance_of(trihedral(2.5, true), kPose)}));
  const Vec3 sight = Vec3(1, 1.3, 1.6).normalized();
  double sum = 0;
  constexpr int kRanges = 60;
  for (int i = 0; i < kRanges; ++i) {
    const double range = 3 + 0.02 * i;
    const double relative = corner.reflected(sight, range, kWavelength) * 4 * range * range;
    EXPECT_NEAR(relative, 1, 0.45) << range;
    sum += relative / kRanges;
  }
  EXPECT_NEAR(sum, 1, 0.06);
}

// A hexagonal outline, by summing Kirchhoff's integral over small squares. Triangular corner on the axis, where the
// outline is a regular hexagon with the corners a sqrt(2)/3 from the apex... of the area a^2/sqrt(3).
TEST(CornerTest, BetweenNearAndFarItIsKirchhoffsIntegral) {
  const double edge = 0.15;
  const Corner corner = only_corner(scene_of_parts({instance_of(trihedral(edge, false))}));
  const Vec3 sight = Vec3::Ones().normalized();
  const double side = edge * std::sqrt(2.0) / 3,
               apothem = side * std::sqrt(3.0) / 2;  // 6 side apothem / 2 = a^2/sqrt(3)
  for (const double range : {1.5, 2.0, 4.3, 9.0, 20.0}) {
    constexpr int kSquares = 1500;
    const double step = 2 * side / kSquares, k = 2 * std::numbers::pi / kWavelength;
    double re = 0, im = 0;
    for (int i = 0; i < kSquares; ++i) {
      for (int j = 0; j < kSquares; ++j) {
        const double x = -side + (i + 0.5) * step, y = -side + (j + 0.5) * step;
        bool inside = true;
        for (int n = 0; n < 3; ++n) {
          const double angle = n * std::numbers::pi / 3;
          inside = inside && std::abs(x * std::cos(angle) + y * std::sin(angle)) < apothem;
        }
        if (inside) {
          re += std::cos(k * (x * x + y * y) / range);
          im += std::sin(k * (x * x + y * y) / range);
        }
      }
    }
    const double amplitude = std::hypot(re, im) * step * step / (kWavelength * range * range);
    EXPECT_NEAR(20 * std::log10(amplitude), 10 * std::log10(corner.reflected(sight, range, kWavelength)), 0.15)
        << range;
  }
}

TEST(CornersTest, FiveBoxesOfATankHaveFourInside) {
  const auto box = [](const Vec3& size, const Vec3& at) { return instance_of(make_box(size), {.position = at}); };
  // Inside 2 x 1.2 x 0.9 m, walls of 5 cm on a floor that reaches beneath them.
  const Scene tank =
      scene_of_parts({box({2.1, 1.3, 0.05}, {0, 0, -0.925}), box({0.05, 1.2, 0.9}, {1.025, 0, -0.45}),
                      box({0.05, 1.2, 0.9}, {-1.025, 0, -0.45}), box({2.1, 0.05, 0.9}, {0, 0.625, -0.45}),
                      box({2.1, 0.05, 0.9}, {0, -0.625, -0.45})});
  const auto inside = [](const std::vector<Corner>& corners, double z) {
    int count = 0;
    for (const Corner& corner : corners) {
      const Vec3 at = corner.apex.cwiseAbs();
      const Vec3 into = corner.axes * Vec3::Ones();
      const bool here = std::abs(at.x() - 1) < 1e-6 && std::abs(at.y() - 0.6) < 1e-6;
      count += here && std::abs(corner.apex.z() - z) < 1e-6 && into.x() * corner.apex.x() < 0 &&
                       into.y() * corner.apex.y() < 0 && into.z() * (corner.apex.z() + 0.45) < 0 && !corner.from_behind
                   ? 1
                   : 0;
    }
    return count;
  };
  const std::vector<Corner> dry = corners_of(tank, {});
  EXPECT_EQ(inside(dry, -0.9), 4);
  EXPECT_EQ(inside(dry, -0.1), 0);
  // Water up to 10 cm below the rim: four more, with the surface.
  const std::vector<Corner> wet = corners_of(tank, WaterMirror{.level = -0.1, .surface = 77});
  EXPECT_EQ(inside(wet, -0.9), 4);
  EXPECT_EQ(inside(wet, -0.1), 4);
}

TEST(CornersTest, ThreeCrossingPlatesHaveEight) {
  std::vector<Instance> plates;
  for (int k = 0; k < 3; ++k) {
    plates.push_back(instance_of(make_plane(Vec3::Unit(k), 0.4, 0.4), kPose));
  }
  EXPECT_EQ(corners_of(scene_of_parts(plates), {}).size(), 8U);
  // One of them does not reach the others, or is not perpendicular, or has gone.
  std::vector<Instance> apart = plates;
  apart[1].world_from_mesh.position += 0.25 * (kPose.orientation * Vec3::UnitX());
  EXPECT_EQ(corners_of(scene_of_parts(apart), {}).size(), 0U);
  std::vector<Instance> oblique = plates;
  oblique[1].world_from_mesh.orientation = kPose.orientation * orientation_from_rpy(0.01, 0, 0);
  EXPECT_EQ(corners_of(scene_of_parts(oblique), {}).size(), 0U);
  std::vector<Instance> gone = plates;
  gone[2].present = false;
  EXPECT_EQ(corners_of(scene_of_parts(gone), {}).size(), 0U);
}

// 20 000 copies of each mirror, in both windings, are one. Pairs of copies are not compared, of which there are 1.2e9.
TEST(CornersTest, CopiesOfAMirrorAreOne) {
  const Corner one = only_corner(scene_of_parts({instance_of(trihedral(0.3, false), kPose)}));
  Mesh mesh = trihedral(0.3, false);
  for (std::size_t i = 0; i < 3 * 20'000; ++i) {
    const auto [a, b, c] = mesh.triangles[i % 3];
    mesh.triangles.push_back(i % 2 == 0 ? std::array{a, b, c} : std::array{a, c, b});
  }
  const Corner corner = only_corner(scene_of_parts({instance_of(std::move(mesh), kPose)}));
  EXPECT_TRUE(corner.apex.isApprox(one.apex, 1e-9));
  EXPECT_EQ(corner.extents, one.extents);
}

TEST(CornersTest, CurvedAndRuggedSurfacesHaveNone) {
  EXPECT_EQ(corners_of(scene_of_parts({instance_of(make_sphere(1, 0.3))}), {}).size(), 0U);
  Instance rugged = instance_of(trihedral(0.3, true));
  rugged.reliefs = {std::make_shared<const Relief>()};
  EXPECT_EQ(corners_of(scene_of_parts({rugged}), {}).size(), 0U);
}

TEST(CornersTest, OfAMovingObjectGoWithIt) {
  Instance moving = instance_of(trihedral(0.3, true), kPose);
  moving.moving = true;
  const std::vector<Corner> corners = corners_of(scene_of_parts({instance_of(make_box({1, 1, 1})), moving}), {});
  const auto own = std::ranges::find(corners, 1, &Corner::instance);
  ASSERT_NE(own, corners.end());
  EXPECT_LT(own->apex.norm(), 1e-6);  // In the frame of its mesh.
}

// Their 1800 mirrors are in planes that cross everywhere; only those of one reflector meet.
TEST(CornersTest, AmongManyParallelMirrorsThoseThatMeetMakeCorners) {
  constexpr int kReflectors = 600;
  std::mt19937 random(9);
  std::uniform_real_distribution<double> anywhere(-200, 200);
  std::vector<Instance> parts;
  for (int i = 0; i < kReflectors; ++i) {
    const Vec3 at(anywhere(random), anywhere(random), anywhere(random));
    parts.push_back(instance_of(trihedral(0.1 + 0.0005 * i, i % 2 == 0), {.position = at}));
  }
  const Scene scene = scene_of_parts(parts);
  const std::vector<Corner> corners = corners_of(scene, {});
  EXPECT_EQ(corners.size(), static_cast<std::size_t>(kReflectors));
  for (const Instance& part : parts) {  // Mirrors as close as kFlush are one.
    const auto is_here = [&](const Corner& corner) {
      return (corner.apex - part.world_from_mesh.position).norm() < 2 * PlaneMirror::kFlush;
    };
    EXPECT_EQ(std::ranges::count_if(corners, is_here), 1);
  }
}

// 5000 squares of two triangles each in a stack: the first 2000 are mirrors, in their order.
TEST(CornerTest, ManyPlanesAreToldApart) {
  constexpr std::uint32_t kSquares = 5000;
  Mesh stack;
  for (std::uint32_t i = 0; i < kSquares; ++i) {
    const float height = 0.125F * static_cast<float>(i);
    for (const auto& [x, y] : {std::pair(0.F, 0.F), {1.F, 0.F}, {1.F, 1.F}, {0.F, 1.F}}) {
      stack.vertices.emplace_back(x, y, height);
      stack.normals.emplace_back(Vec3f::UnitZ());
    }
    stack.triangles.push_back({4 * i, 4 * i + 1, 4 * i + 2});
    stack.triangles.push_back({4 * i, 4 * i + 2, 4 * i + 3});
  }
  Workers workers(2);
  const std::vector<PlaneMirror> mirrors =
      find_plane_mirrors(scene_of_parts({instance_of(std::move(stack))}), -1, workers);
  ASSERT_EQ(mirrors.size(), PlaneMirror::kMostMirrors);
  for (std::size_t i = 0; i < mirrors.size(); ++i) {
    EXPECT_EQ(mirrors[i].offset, 0.125 * static_cast<double>(i));
    EXPECT_EQ(mirrors[i].triangles.size(), 2U);
    EXPECT_DOUBLE_EQ(mirrors[i].area, 1);
    EXPECT_EQ(mirrors[i].high - mirrors[i].low, Vec3(1, 1, 0));
  }
}

}  // namespace
}  // namespace insonify::corners_test
