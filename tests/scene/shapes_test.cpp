// shapes_test.cpp -- primitives lie on their analytic surface, are closed, wound outwards, and converge.

#include <gtest/gtest.h>

#include "scene/mesh_checks.h"
#include "support/message_of.h"

namespace insonify::shapes_test {
namespace {

constexpr double kPi = std::numbers::pi;

// Vertices are stored as floats: relative rounding 6e-8, a few of which meet in a computed value.
constexpr double kFloat = 5e-7;

// Where a point stands on a surface and how it faces there.
struct Surface {
  std::function<double(const Vec3&)> distance;  // 0 on the surface [m]
  double area;                                  // [m^2]
  double volume;                                // [m^3]
};

struct Shape {
  std::string name;
  Mesh mesh;
  Mesh coarse;
  Surface surface;
  Box3 bounds;
};

void PrintTo(const Shape& shape, std::ostream* out) {
  *out << shape.name;
}

Box3 centred(double x, double y, double z) {
  return {Vec3(-x, -y, -z), Vec3(x, y, z)};
}

Shape box() {
  const Vec3 half(0.7, 1.1, 0.3);
  const auto distance = [half](const Vec3& p) { return (p.cwiseAbs() - half).maxCoeff(); };
  return {"box",
          make_box({1.4, 2.2, 0.6}),
          make_box({1.4, 2.2, 0.6}),
          {distance, 2 * (1.4 * 2.2 + 2.2 * 0.6 + 0.6 * 1.4), 1.4 * 2.2 * 0.6},
          centred(0.7, 1.1, 0.3)};
}

Shape sphere() {
  const double r = 2.5;
  const auto distance = [r](const Vec3& p) { return p.norm() - r; };
  return {"sphere",
          make_sphere(r, 0.06),
          make_sphere(r, 0.12),
          {distance, 4 * kPi * r * r, 4 * kPi / 3 * r * r * r},
          centred(r, r, r)};
}

// Surface of an ellipsoid of revolution with radii (a, a, c), c < a (oblate): 2 pi a^2 (1 + (1 - e^2) / e atanh e),
// e^2 = 1 - c^2 / a^2.
Shape ellipsoid() {
  const double a = 3, c = 0.5;
  const double e = std::sqrt(1 - c * c / (a * a));
  const auto distance = [=](const Vec3& p) {
    return (std::sqrt(p.x() * p.x() / (a * a) + p.y() * p.y() / (a * a) + p.z() * p.z() / (c * c)) - 1) * c;
  };
  return {"ellipsoid",
          make_ellipsoid({a, a, c}, 0.06),
          make_ellipsoid({a, a, c}, 0.12),
          {distance, 2 * kPi * a * a * (1 + (1 - e * e) / e * std::atanh(e)), 4 * kPi / 3 * a * a * c},
          centred(a, a, c)};
}

Shape cylinder() {
  const double r = 0.4, l = 5;
  const auto distance = [=](const Vec3& p) { return std::max(std::hypot(p.x(), p.y()) - r, std::abs(p.z()) - l / 2); };
  return {"cylinder",
          make_cylinder(r, l, 0.06),
          make_cylinder(r, l, 0.12),
          {distance, 2 * kPi * r * (r + l), kPi * r * r * l},
          centred(r, r, l / 2)};
}

Shape capsule() {
  const double r = 0.4, l = 5;
  const auto distance = [=](const Vec3& p) {
    const double along = std::max(std::abs(p.z()) - l / 2, 0.0);
    return std::hypot(p.x(), p.y(), along) - r;
  };
  return {"capsule",
          make_capsule(r, l, 0.06),
          make_capsule(r, l, 0.12),
          {distance, 2 * kPi * r * (2 * r + l), kPi * r * r * (l + 4.0 / 3 * r)},
          centred(r, r, l / 2 + r)};
}

Shape cone() {
  const double r = 0.8, l = 3;
  const double slant = std::hypot(r, l);
  const auto distance = [=](const Vec3& p) {
    const double side = (std::hypot(p.x(), p.y()) - r * (0.5 - p.z() / l)) * l / slant;
    return std::max(side, -l / 2 - p.z());
  };
  return {"cone",
          make_cone(r, l, 0.06),
          make_cone(r, l, 0.12),
          {distance, kPi * r * (r + slant), kPi / 3 * r * r * l},
          centred(r, r, l / 2)};
}

class ShapesTest : public testing::TestWithParam<Shape> {};

TEST_P(ShapesTest, VerticesLieOnTheSurface) {
  for (const Vec3f& vertex : GetParam().mesh.vertices) {
    ASSERT_NEAR(GetParam().surface.distance(vertex.cast<double>()), 0, kFloat * 5);
  }
}

TEST_P(ShapesTest, IsClosedAndWindsOutwards) {
  EXPECT_TRUE(is_closed(GetParam().mesh));
  EXPECT_GT(volume_of(GetParam().mesh), 0);
}

// A chord of angle d falls short of its arc by d^2 / 24 in length: with d at most .06 (in two directions) area and
// volume are low by less than .06^2 = .4 %, and by four times that when d is doubled.
TEST_P(ShapesTest, AreaAndVolumeConverge) {
  const auto& [name, mesh, coarse, surface, bounds] = GetParam();
  const double area_error = 1 - area_of(mesh) / surface.area;
  const double volume_error = 1 - volume_of(mesh) / surface.volume;
  EXPECT_NEAR(area_error, 0, 0.0036);
  EXPECT_NEAR(volume_error, 0, 0.0036);
  EXPECT_GE(volume_error, -1e-6) << "an inscribed solid is smaller";
  if (name != "box") {
    EXPECT_NEAR((1 - area_of(coarse) / surface.area) / area_error, 4, 0.5);
    EXPECT_NEAR((1 - volume_of(coarse) / surface.volume) / volume_error, 4, 0.5);
  }
}

TEST_P(ShapesTest, FillsItsBounds) {
  const Box3 bounds = bounds_of(GetParam().mesh);
  EXPECT_LT((bounds.low - GetParam().bounds.low).cwiseAbs().maxCoeff(), kFloat * 5);
  EXPECT_LT((bounds.high - GetParam().bounds.high).cwiseAbs().maxCoeff(), kFloat * 5);
}

// Each normal is that of the analytic surface: it climbs the distance at the full rate of 1 m a metre. The ellipsoid's
// "distance" is one only in direction, so its gradient is normalised; corners and rims have no gradient and are left
// out.
TEST_P(ShapesTest, NormalsAreThoseOfTheSurface) {
  const auto& [name, mesh, coarse, surface, bounds] = GetParam();
  EXPECT_LT(normal_length_error(mesh), kFloat);
  // Faces turn by up to 1.2 of the edge angle against the normals at their corners.
  EXPECT_GT(least_agreement(mesh), std::cos(1.2 * 0.06));

  if (name == "sphere" || name == "ellipsoid" || name == "capsule") {
    const double h = 1e-4;
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      const Vec3 p = mesh.vertices[i].cast<double>();
      Vec3 gradient;
      for (int axis = 0; axis < 3; ++axis) {
        const Vec3 step = h * Vec3::Unit(axis);
        gradient[axis] = (surface.distance(p + step) - surface.distance(p - step)) / (2 * h);
      }
      // Central differences at a step h next to a bend of radius c^2/a = .083 m err by (h / .083)^2 = 1.5e-6.
      ASSERT_GT(gradient.normalized().dot(mesh.normals[i].cast<double>()), 1 - 1e-6);
    }
  }
}

TEST_P(ShapesTest, NeighbouringNormalsKeepWithinTheEdgeAngle) {
  const Mesh& mesh = GetParam().mesh;
  double widest = 0;
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 a = mesh.normals[triangle[i]].cast<double>();
      const Vec3 b = mesh.normals[triangle[(i + 1) % 3]].cast<double>();
      widest = std::max(widest, std::atan2(a.cross(b).norm(), a.dot(b)));
    }
  }
  EXPECT_LE(widest, 0.06 + kFloat);
}

TEST_P(ShapesTest, NeedsNoCleaning) {
  Mesh mesh = GetParam().mesh;
  const MeshReport report = clean_mesh(mesh);
  EXPECT_EQ(report.dropped(), 0U);
  EXPECT_EQ(report.normals_flipped, 0U);
  EXPECT_FALSE(report.normals_computed);
}

INSTANTIATE_TEST_SUITE_P(All, ShapesTest, testing::Values(box(), sphere(), ellipsoid(), cylinder(), capsule(), cone()),
                         [](const auto& shape) { return shape.param.name; });

TEST(SphereTest, HasTrianglesOfOneSize) {
  const Mesh mesh = make_sphere(1, 0.05);
  double smallest = 1e9, largest = 0;
  for (const auto& triangle : mesh.triangles) {
    const double area = doubled_area(mesh, triangle).norm() / 2;
    smallest = std::min(smallest, area);
    largest = std::max(largest, area);
  }
  EXPECT_LT(largest / smallest, 2);
}

TEST(PlaneTest, LiesAcrossItsNormal) {
  const Mesh mesh = make_plane({3, 0, 4}, 6, 2);
  EXPECT_NEAR(area_of(mesh), 12, 1e-5);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(mesh.vertices[i].dot(Vec3f(0.6F, 0, 0.8F)), 0, 1e-6);
    EXPECT_LT((mesh.normals[i] - Vec3f(0.6F, 0, 0.8F)).norm(), 1e-6);
  }
  EXPECT_GT(least_agreement(mesh), 0.999999);
}

TEST(PlaneTest, KeepsItsSidesAlongTheAxesWhenLevel) {
  for (const double z : {5.0, -5.0}) {
    const Mesh mesh = make_plane({0, 0, z}, 6, 2);
    EXPECT_LT((bounds_of(mesh).high - Vec3(3, 1, 0)).norm(), 1e-6);
    EXPECT_EQ(mesh.normals[0].z(), z > 0 ? 1 : -1);
  }
}

TEST(ShapesErrorTest, NamesTheSizeThatIsWrong) {
  EXPECT_EQ(message_of([] { (void)make_box({1, -2, 3}); }), "box.size_y = -2 m must be greater than 0 m");
  EXPECT_EQ(message_of([] { (void)make_sphere(0); }), "sphere.radius = 0 m must be greater than 0 m");
  EXPECT_EQ(message_of([] {
              return make_ellipsoid({1, 2, NAN});
            }),
            "ellipsoid.radius_z = nan m must be greater than 0 m");
  EXPECT_EQ(message_of([] { (void)make_cylinder(1, 0); }), "cylinder.length = 0 m must be greater than 0 m");
  EXPECT_EQ(message_of([] { (void)make_plane({0, 0, 0}, 1, 1); }), "plane.normal's length = 0 must be greater than 0");
}

}  // namespace
}  // namespace insonify::shapes_test
