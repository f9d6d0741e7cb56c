// round_shapes_test.cpp -- how many triangles unequal round shapes have, and how far they are off.

#include "io/world/round_shapes.h"

#include <gmock/gmock.h>

#include "io/sdf_files.h"

namespace insonify::round_shapes_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr double kUsualAngle = 0.05;

// The i-th of 3 004 sizes from 0.05 to 0.5 m.
Shape shape_of(ShapeKind kind, int i) {
  const auto size = [&](int multiple) { return 0.05 + 0.45 * (i * multiple % 3004) / 3004; };
  return {.kind = kind, .size = Vec3(size(1), size(7), size(11)), .radius = size(1), .length = size(13)};
}

Mesh mesh_of(const Shape& shape, double angle) {
  switch (shape.kind) {
    case ShapeKind::kSphere:
      return make_sphere(shape.radius, angle);
    case ShapeKind::kEllipsoid:
      return make_ellipsoid(*shape.size, angle);
    case ShapeKind::kCylinder:
      return make_cylinder(shape.radius, shape.length, angle);
    case ShapeKind::kCapsule:
      return make_capsule(shape.radius, shape.length, angle);
    default:
      return make_cone(shape.radius, shape.length, angle);
  }
}

constexpr std::array kKinds{ShapeKind::kSphere, ShapeKind::kEllipsoid, ShapeKind::kCylinder, ShapeKind::kCapsule,
                            ShapeKind::kCone};

TEST(RoundShapesTest, ThousandsOfUnequalOnesShareABudgetOfTriangles) {
  for (const ShapeKind kind : kKinds) {
    RoundShapes shapes;
    for (int i = 0; i < 3004; ++i) {
      shapes.add(shape_of(kind, i));
      shapes.add(shape_of(kind, i));  // Equal ones share a mesh.
    }
    EXPECT_EQ(shapes.size(), 3004U);
    double triangles = 0;
    for (int i = 0; i < 3004; i += 25) {
      const Shape shape = shape_of(kind, i);
      triangles += 25. * static_cast<double>(mesh_of(shape, shapes.edge_angle(shape)).triangles.size());
    }
    // Whole numbers of rings round up, by a tenth where there are eight of them; small ones have 512 triangles.
    EXPECT_LE(triangles, 1.5 * RoundShapes::kMostTriangles) << static_cast<int>(kind);
    EXPECT_GE(triangles, 0.4 * RoundShapes::kMostTriangles) << static_cast<int>(kind);
  }
}

TEST(RoundShapesTest, FewAreAsFineAsEver) {
  RoundShapes shapes;
  for (const ShapeKind kind : kKinds) {
    for (int i = 0; i < 3; ++i) {
      shapes.add(shape_of(kind, 600 + i));
    }
  }
  EXPECT_EQ(shapes.deviation(), 0);
  EXPECT_EQ(shapes.edge_angle(shape_of(ShapeKind::kEllipsoid, 600)), kUsualAngle);
}

// Midpoints of edges of 300 spheres: the longest edges of all but the smallest are equally far within.
TEST(RoundShapesTest, FacetsAreEquallyFarOffTheSurface) {
  RoundShapes shapes;
  for (int i = 0; i < 300; ++i) {
    shapes.add(shape_of(ShapeKind::kSphere, 10 * i));
  }
  for (int i : {50, 150, 299}) {
    const Shape shape = shape_of(ShapeKind::kSphere, 10 * i);
    const Mesh mesh = mesh_of(shape, shapes.edge_angle(shape));
    double furthest = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
      for (const auto& [from, to] : {std::pair{a, b}, {b, c}, {c, a}}) {
        const double middle = static_cast<double>((mesh.vertices[from] + mesh.vertices[to]).norm()) / 2;
        furthest = std::max(furthest, shape.radius - middle);
      }
    }
    EXPECT_LE(furthest, shapes.deviation()) << shape.radius;
    EXPECT_GE(furthest, 0.7 * shapes.deviation()) << shape.radius;  // Whole numbers of rings round up.
  }
}

TEST(RoundShapesTest, SizesThatAreErrorsDoNotCount) {
  RoundShapes shapes;
  shapes.add({.kind = ShapeKind::kSphere, .radius = -1});
  shapes.add({.kind = ShapeKind::kEllipsoid, .size = Vec3(0, 1, 1)});
  shapes.add({.kind = ShapeKind::kEllipsoid, .size = std::nullopt});
  shapes.add({.kind = ShapeKind::kEllipsoid, .size = Vec3(1, 1, 10001)});
  shapes.add({.kind = ShapeKind::kSphere, .radius = NAN});
  shapes.add({.kind = ShapeKind::kBox, .size = Vec3(1, 1, 1)});
  EXPECT_EQ(shapes.size(), 0U);
}

class RoundWorldTest : public SdfTest {
 protected:
  Scene load_balls(int count) {
    std::string balls;
    for (int i = 0; i < count; ++i) {
      balls += fmt::format("<visual name='v{0}'><geometry><sphere><radius>{1}</radius></sphere></geometry></visual>", i,
                           1 + 0.01 * i);
    }
    return load("<sdf version='1.9'><model name='m'><link name='l'>" + balls + "</link></model></sdf>");
  }
};

// 43 spheres of 27 848 triangles are fewer than 1.2 million. 60 have 8.555 r / d each at the deviation d, and radii of
// 77.7 m in all: d = 0.554 mm.
TEST_F(RoundWorldTest, AWorldOfManySizesSaysHowCoarseItIs) {
  EXPECT_EQ(load_balls(43).instances[0].mesh->triangles.size(), 27848U);
  EXPECT_THAT(said, IsEmpty());
  const Scene many = load_balls(60);
  EXPECT_NEAR(static_cast<double>(many.triangle_count()), RoundShapes::kMostTriangles, 0.08e6);
  EXPECT_THAT(said, ElementsAre("scene.sdf: 60 sizes of spheres, cylinders and the like would take too much memory: "
                                "their facets are coarser, up to 0.55 mm off their surfaces"));
}

TEST_F(RoundWorldTest, RadiiOfAnEllipsoidMustNotDifferTooMuch) {
  const std::string text =
      "<sdf version='1.9'><model name='m'><link name='l'><visual name='v'><geometry><ellipsoid><radii>1 2 {}</radii>"
      "</ellipsoid></geometry></visual></link></model></sdf>";
  EXPECT_EQ(error_of(fmt::format(fmt::runtime(text), 2147483647)),
            "scene.sdf:1:51: visual 'm::l::v': <radii> = 1 2 2147483647 m: the largest must be at most 10000 times the "
            "smallest");
}

}  // namespace
}  // namespace insonify::round_shapes_test
