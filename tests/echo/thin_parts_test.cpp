// thin_parts_test.cpp -- what counts as thin, and that the pieces have the surface of what they are cut from.

#include "echo/thin/thin_parts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "support/test_engine.h"

namespace insonify::thin_parts_test {
namespace {

Scene scene_of(Mesh mesh, const Pose& world_from_mesh = {}) {
  Scene scene;
  scene.materials.resize(1);
  Instance instance;
  instance.name = "thing";
  instance.mesh = std::make_shared<const Mesh>(std::move(mesh));
  instance.world_from_mesh = world_from_mesh;
  instance.materials = {0};
  scene.instances = {std::move(instance)};
  return scene;
}

ThinParts parts_of(const Scene& scene) {
  const std::unique_ptr<TestEngine> engine = test_engine("cpu", 2);
  engine->set_scene(scene);
  Workers workers(2);
  return find_thin_parts(scene, engine->engine(), workers);
}

std::vector<ThinTriangle> triangles_of(const Scene& scene) {
  const std::unique_ptr<TestEngine> engine = test_engine("cpu", 2);
  engine->set_scene(scene);
  Workers workers(2);
  return find_thin_triangles(scene, 0, engine->engine(), workers);
}

// Adds another mesh, moved, and with its inside out.
void append(const Mesh& other, const Vec3f& offset, bool inside_out, Mesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (std::size_t i = 0; i < other.vertices.size(); ++i) {
    mesh.vertices.emplace_back(other.vertices[i] + offset);
    mesh.normals.emplace_back((inside_out ? -1 : 1) * other.normals[i]);
  }
  for (const auto& [a, b, c] : other.triangles) {
    mesh.triangles.push_back({first + a, first + (inside_out ? c : b), first + (inside_out ? b : c)});
  }
}

// Whether a triangle of a shape around the z axis is a side of it, not an end.
bool is_side(const Mesh& mesh, std::uint32_t triangle) {
  return std::abs(mesh.normals[mesh.triangles[triangle][0]].z()) < 0.5F;
}

double area_of(const ThinParts& parts) {
  double sum = 0;
  for (const ThinParts::Patch& patch : parts.patches) {
    sum += patch.area;
  }
  return sum;
}

TEST(ThinPartsTest, BoxesPlatesAndLargeBodiesAreNotThin) {
  EXPECT_TRUE(parts_of(scene_of(make_box({0.3, 0.3, 0.3}))).pieces.empty());
  EXPECT_TRUE(parts_of(scene_of(make_box({0.02, 1, 1}))).pieces.empty());
  EXPECT_TRUE(parts_of(scene_of(make_sphere(0.55, 0.2))).pieces.empty());
  EXPECT_TRUE(parts_of(scene_of(make_cylinder(0.6, 4, 0.2))).pieces.empty());
  EXPECT_TRUE(parts_of(scene_of(make_plane(Vec3::UnitZ(), 0.02, 5))).pieces.empty());
  EXPECT_EQ(parts_of(scene_of(make_box({0.3, 0.3, 0.3}))).triangles, nullptr);
}

// Bars of exactly the limits' size: 0.1 m, and the step of 4 mm that thickness is rounded up to. Where and how they lie
// decides nothing; nor for bars that are 3 % thicker.
TEST(ThinPartsTest, WhereABodyLiesDoesNotDecideWhetherItIsThin) {
  for (int i = 0; i < 60; ++i) {
    const Pose place{.position = {7.3 + 41.7 * (i % 8), 0.4 * i - 8.2, 0.17 * (i % 5)},
                     .orientation = orientation_from_rpy(0.37 * i, 0.21 * i, 0.11 * i)};
    for (const double width : {0.1, 0.004}) {
      const std::vector<ThinTriangle> thin = triangles_of(scene_of(make_box({width, width, 1}), place));
      ASSERT_EQ(thin.size(), 8U) << i;
      for (const ThinTriangle& triangle : thin) {
        EXPECT_EQ(triangle.along, 2);
        EXPECT_NEAR(triangle.thickness, width, 2e-3 * width) << i;
      }
    }
    EXPECT_TRUE(triangles_of(scene_of(make_box({0.103, 0.103, 1}), place)).empty()) << i;
    for (const ThinParts::Piece& piece : parts_of(scene_of(make_box({0.004, 0.004, 0.5}), place)).pieces) {
      EXPECT_NEAR(piece.thickness, 0.004F, 1e-6F) << i;
    }
  }
}

// 4 pi a^2, also with something 9 km away, which makes coordinates coarser: 0.5 mm.
TEST(ThinPartsTest, ARoundBodyIsOnePiece) {
  for (const float radius : {0.019F, 0.1F, 0.45F}) {
    Scene scene = scene_of(make_sphere(radius, 0.13), {.position = {25, 0, 0}});
    scene.instances.push_back(scene_of(make_plane(Vec3::UnitX(), 1, 1), {.position = {0, 9000, 0}}).instances[0]);
    const ThinParts parts = parts_of(scene);
    ASSERT_EQ(parts.pieces.size(), 1U) << radius;
    EXPECT_NEAR(area_of(parts), 4 * std::numbers::pi * radius * radius, 0.01 * 4 * std::numbers::pi * radius * radius);
    EXPECT_NEAR(parts.pieces[0].middle.norm(), 0, 1e-3);
    EXPECT_NEAR(parts.pieces[0].thickness / (2 * radius), 1.09, 0.1);  // Rounded up to fourths of an octave.
  }
}

// More triangles than are measured together, behind some that are too wide for sides of thin parts.
TEST(ThinPartsTest, ARodOfManyTrianglesIsThinAllOver) {
  Mesh mesh = make_box({1, 1, 1});
  const auto first = static_cast<std::uint32_t>(mesh.triangles.size());
  append(make_cylinder(0.02, 2, 0.003), {5, 0, 0}, false, mesh);
  ASSERT_GT(mesh.triangles.size(), 8000U);
  const Scene scene = scene_of(mesh);
  std::vector<int> found(mesh.triangles.size());
  for (const ThinTriangle& triangle : triangles_of(scene)) {
    ++found[triangle.triangle];
    EXPECT_NEAR(triangle.thickness, 0.04, 0.004);  // Across in one of eight directions, or the next one.
  }
  for (std::uint32_t t = first; t < mesh.triangles.size(); ++t) {
    ASSERT_EQ(found[t], is_side(mesh, t) ? 1 : 0) << t;
  }
}

// A can of 0.4 m with walls of 10 mm, closed: what is thin is the wall, as wide as a chord within it, not the can.
TEST(ThinPartsTest, TheWallOfACanIsMeasuredNotTheCan) {
  Mesh can = make_cylinder(0.2, 1, 0.1);
  const auto outside = static_cast<std::uint32_t>(can.triangles.size());
  append(make_cylinder(0.19, 0.98, 0.1), {0, 0, 0}, true, can);
  const double chord = 2 * std::sqrt(0.2 * 0.2 - 0.195 * 0.195);
  int walls = 0;
  for (const ThinTriangle& triangle : triangles_of(scene_of(can))) {
    if (triangle.triangle < outside && is_side(can, triangle.triangle)) {
      EXPECT_NEAR(triangle.thickness, chord, 0.1 * chord);
      ++walls;
    }
  }
  EXPECT_GT(walls, 100);
}

// What is not convex is not one piece: its parts may hide each other. Every second corner of a ball is pushed in.
TEST(ThinPartsTest, ASpikyBodyIsNotCompact) {
  Mesh ball = make_sphere(0.2, 0.13), spiky = ball;
  for (std::size_t i = 0; i < spiky.vertices.size(); i += 2) {
    spiky.vertices[i] *= 0.3F;
  }
  EXPECT_EQ(find_compact_bodies(scene_of(ball).instances[0]).size(), ball.triangles.size());
  EXPECT_TRUE(find_compact_bodies(scene_of(spiky).instances[0]).empty());
}

// A lens of 0.6 x 0.6 x 0.2 m: at its rim the normal turns by more than a radian over the body, on its sides by 0.2.
TEST(ThinPartsTest, OnlyTheRimOfALensIsRound) {
  const Scene scene = scene_of(make_ellipsoid({0.3, 0.3, 0.1}, 0.1));
  const ThinParts parts = parts_of(scene);
  ASSERT_NE(parts.triangles, nullptr);
  const Mesh& mesh = *scene.instances[0].mesh;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Vec3f& corner = mesh.vertices[mesh.triangles[i][0]];
    const float radius = corner.head<2>().norm();
    if (radius < 0.15F || radius > 0.29F) {
      EXPECT_EQ(std::isinf((*parts.triangles->thickness[0])[i]), radius < 0.15F) << corner.transpose();
    }
  }
}

// Where a surface is round it may be thicker than where it is flat: a pole of 0.5 m, without its ends. Also with
// something 9 km away, where rays from the flat ends meet those ends themselves, and two slivers of them are pieces.
TEST(ThinPartsTest, APoleIsCutAlongItsAxis) {
  for (const double far : {20.0, 9000.0}) {
    Scene scene = scene_of(make_cylinder(0.25, 5, 0.1), {.orientation = orientation_from_rpy(1, 0.3, 0)});
    scene.instances.push_back(scene_of(make_plane(Vec3::UnitX(), 1, 1), {.position = {0, far, 0}}).instances[0]);
    const ThinParts parts = parts_of(scene);
    EXPECT_NEAR(area_of(parts), 2 * std::numbers::pi * 0.25 * 5, 0.01 * 2 * std::numbers::pi * 0.25 * 5) << far;
    int of_pole = 0;
    for (const ThinParts::Piece& piece : parts.pieces) {
      if (piece.thickness > 0.4F) {
        ++of_pole;
        EXPECT_NEAR(piece.middle.head<2>().norm(), 0, 1e-3) << far;
      }
    }
    EXPECT_EQ(of_pole, 4) << far;
  }
}

// Poles of 0.2 m in one mesh, which may hide each other: 20 are pieces, 80 are left to the lattice.
TEST(ThinPartsTest, AnAssemblyOfManyRoundPartsIsLeftToTheLattice) {
  for (const int poles : {20, 80}) {
    Mesh all;
    for (int i = 0; i < poles; ++i) {
      const Mesh pole = make_cylinder(0.1, 0.55, 0.3);
      const auto first = static_cast<std::uint32_t>(all.vertices.size());
      for (std::size_t k = 0; k < pole.vertices.size(); ++k) {
        all.vertices.push_back(pole.vertices[k] + Vec3f(static_cast<float>(i), 0, 0));
        all.normals.push_back(pole.normals[k]);
      }
      for (const auto& corners : pole.triangles) {
        all.triangles.push_back({first + corners[0], first + corners[1], first + corners[2]});
      }
      all.material_names = pole.material_names;
    }
    EXPECT_EQ(parts_of(scene_of(all)).pieces.empty(), poles == 80) << poles;
  }
}

// The side of a rod, without its ends: 2 pi a l, less what a polygon of 21 sides lacks, 0.4 %.
TEST(ThinPartsTest, PiecesHaveTheSurfaceOfARod) {
  const Pose aslant{.position = {300, -20, 7}, .orientation = orientation_from_rpy(0.3, 0.5, 0.7)};
  const ThinParts parts = parts_of(scene_of(make_cylinder(0.006, 2, 0.3), aslant));
  EXPECT_NEAR(area_of(parts), 2 * std::numbers::pi * 0.006 * 2, 0.01 * 2 * std::numbers::pi * 0.006 * 2);
  double length = 0;
  for (const ThinParts::Piece& piece : parts.pieces) {
    EXPECT_NEAR(piece.middle.x(), 0, 1e-4);
    EXPECT_NEAR(piece.middle.y(), 0, 1e-4);
    EXPECT_GE(piece.thickness, 0.0118F);
    EXPECT_LE(piece.thickness, 0.012F * 1.19F * 1.02F);  // A fourth of an octave, and the directions tried.
    length += 2 * piece.half.norm();
  }
  EXPECT_NEAR(length, 2, 0.02);
  for (const float thickness : *parts.triangles->thickness[0]) {
    EXPECT_TRUE(thickness < 0.015F || std::isinf(thickness));  // Infinite: the ends.
  }
}

// A square rod has four flat sides.
TEST(ThinPartsTest, FlatSidesKeepTheirNormals) {
  const ThinParts parts = parts_of(scene_of(make_box({0.02, 0.02, 1})));
  EXPECT_NEAR(area_of(parts), 4 * 0.02, 1e-5);
  for (const ThinParts::Patch& patch : parts.patches) {
    EXPECT_NEAR(patch.normal.cwiseAbs().maxCoeff(), 1, 1e-5);
    EXPECT_EQ(patch.around.norm() + patch.along.norm(), 0);
  }
}

// A bottom that passes through a rod does not make it thinner.
TEST(ThinPartsTest, OtherSurfacesInsideDoNotCount) {
  Scene scene = scene_of(make_cylinder(0.01, 1, 0.3), {.orientation = orientation_from_rpy(0, 1.5707963, 0)});
  scene.instances.push_back(scene_of(make_plane(Vec3::UnitZ(), 4, 4), {.position = {0, 0, 0.002}}).instances[0]);
  const ThinParts parts = parts_of(scene);
  EXPECT_NEAR(area_of(parts), 2 * std::numbers::pi * 0.01, 0.01 * 2 * std::numbers::pi * 0.01);
  EXPECT_EQ(parts.triangles->thickness[1], nullptr);
}

// 200 m in pieces of 6 mm are too many, in pieces of 12 mm not.
TEST(ThinPartsTest, WhatHasManyPiecesIsCutIntoLongerOnes) {
  const ThinParts parts = parts_of(scene_of(make_cylinder(0.001, 200, 0.5)));
  EXPECT_NEAR(static_cast<double>(parts.pieces.size()), 200 / 0.012, 20);
  EXPECT_TRUE(parts.left_out.empty());
}

TEST(ThinPartsTest, WhatHasTooManyPiecesIsLeftOut) {
  const ThinParts parts = parts_of(scene_of(make_cylinder(0.001, 1000, 0.5)));  // 1 km in pieces of 48 mm.
  EXPECT_TRUE(parts.pieces.empty());
  EXPECT_EQ(parts.left_out, std::vector<std::string>{"thing"});
  EXPECT_EQ(parts.triangles, nullptr);
}

// Cables of one mesh have the pieces of the first, under their own names, until a scene has too many: those that are
// left are cut into longer ones. A cable of another material is measured by itself.
TEST(ThinPartsTest, AlikeInstancesShareWhatWasMeasured) {
  Scene scene = scene_of(make_cylinder(0.01, 1, 0.3));
  scene.materials.resize(2);
  for (int i = 1; i < 4; ++i) {
    scene.instances.push_back(scene.instances[0]);
    scene.instances[i].world_from_mesh = {.position = {3.0 * i, 0, 0},
                                          .orientation = orientation_from_rpy(0.3 * i, 0.2, 0)};
  }
  scene.instances[3].materials = {1};
  const ThinParts parts = parts_of(scene);
  const auto& thickness = parts.triangles->thickness;
  EXPECT_EQ(thickness[1], thickness[0]);
  EXPECT_NE(thickness[3], thickness[0]);
  const std::size_t each = parts.pieces.size() / 4;
  ASSERT_EQ(parts.pieces.size(), 4 * each);
  for (std::size_t k = 0; k < each; ++k) {
    EXPECT_EQ(parts.pieces[each + k].surface, surface_label(1, 0));
    EXPECT_EQ(parts.pieces[each + k].first_patch, parts.pieces[k].first_patch);
    EXPECT_EQ(parts.pieces[each + k].middle, parts.pieces[k].middle);
    EXPECT_EQ(parts.pieces[3 * each + k].surface, surface_label(3, 1));
  }
  scene = scene_of(make_cylinder(0.001, 90, 0.5));  // 15 000 pieces of 6 mm.
  scene.instances.push_back(scene.instances[0]);
  scene.instances[1].world_from_mesh.position.x() = 1;
  EXPECT_NEAR(static_cast<double>(parts_of(scene).pieces.size()), 15'000 + 90 / 0.024, 100);
}

}  // namespace
}  // namespace insonify::thin_parts_test
