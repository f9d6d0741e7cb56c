// straight_edges_test.cpp -- edges that are found in meshes, and the integral along them against its sum.

#include "echo/targets/straight_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <complex>
#include <numbers>

#include "echo/edge_scene.h"
#include "echo/targets/edge_echoes.h"
#include "echo/targets/plane_mirrors.h"

namespace insonify::straight_edges_test {
namespace {

using namespace edge_scene;

constexpr double kPi = std::numbers::pi;

// An L with sides of 0.2 m, 0.05 m thick and 1 m long, closed. The two outer sides are of two pieces each.
Mesh l_profile() {
  Mesh mesh;
  const Vec3f z = Vec3f::UnitZ();
  constexpr float kThick = 0.05F, kWide = 0.2F;
  const std::vector<Vec3f> outline = {{0, 0, 0},           {kThick, 0, 0},     {kWide, 0, 0}, {kWide, kThick, 0},
                                      {kThick, kThick, 0}, {kThick, kWide, 0}, {0, kWide, 0}, {0, kThick, 0}};
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec3f &a = outline[i], &b = outline[(i + 1) % outline.size()];
    add_rectangle(mesh, a, b, b + z, a + z);
  }
  const auto cap = [&](int a, int b, int c, int d) {
    add_rectangle(mesh, outline[a] + z, outline[b] + z, outline[c] + z, outline[d] + z);
    add_rectangle(mesh, outline[d], outline[c], outline[b], outline[a]);
  };
  cap(0, 1, 4, 7);
  cap(1, 2, 3, 4);
  cap(7, 4, 5, 6);
  return mesh;
}

TEST(StraightEdgesTest, BoxHasTwelve) {
  for (Mesh& mesh : std::vector<Mesh>{make_box({0.7, 0.4, 0.2}), tessellated_box({0.7F, 0.4F, 0.2F}, 1),
                                      tessellated_box({0.7F, 0.4F, 0.2F}, 7)}) {
    const auto edges = all_edges(scene_of({{std::move(mesh)}}));
    ASSERT_EQ(edges.size(), 12U);
    EXPECT_NEAR(total_length(edges), 4 * (0.7 + 0.4 + 0.2), 1e-5);
    for (const StraightEdges::Edge& edge : edges) {
      EXPECT_NEAR(edge.exterior, 1.5, 1e-6);
      for (const StraightEdges::Side& side : edge.sides) {
        EXPECT_GT(side.normal.dot(edge.middle), 0);   // Outwards.
        EXPECT_LT(side.inwards.dot(edge.middle), 0);  // From the edge, into the face.
        EXPECT_NEAR(side.normal.dot(side.inwards), 0, 1e-6);
      }
      EXPECT_NE(edge.sides[0].face, edge.sides[1].face);
    }
  }
}

TEST(StraightEdgesTest, PlateHasFour) {
  const auto edges = all_edges(scene_of({{make_plane(Vec3::UnitZ(), 0.5, 0.3)}}));
  ASSERT_EQ(edges.size(), 4U);
  EXPECT_NEAR(total_length(edges), 1.6, 1e-5);
  for (const StraightEdges::Edge& edge : edges) {
    EXPECT_EQ(edge.exterior, 2);
    EXPECT_NEAR(std::abs(edge.sides[0].normal.z()), 1, 1e-6);
    EXPECT_LT(edge.sides[0].inwards.dot(edge.middle), 0);
    EXPECT_EQ(edge.sides[0].face, edge.sides[1].face);
  }
}

TEST(StraightEdgesTest, ProfileHasThoseThatStandOut) {
  // Five along it, and six at each end.
  const auto edges = all_edges(scene_of({{l_profile()}}));
  EXPECT_EQ(edges.size(), 17U);
  EXPECT_NEAR(total_length(edges), 5 + 2 * 0.8, 1e-5);
  for (const StraightEdges::Edge& edge : edges) {
    EXPECT_GT((edge.middle.head<2>() - Eigen::Vector2d(0.05, 0.05)).norm(), 0.01);
  }
}

// A bent sheet has its bend, on the side with more water, whichever way it is wound, and its six borders.
TEST(StraightEdgesTest, BentSheetHasItsBend) {
  for (const bool flip : {false, true}) {
    Mesh mesh;
    add_rectangle(mesh, {0, 0, 0}, {0.4F, 0, 0}, {0.4F, 0.3F, 0}, {0, 0.3F, 0});
    const Vec3f up(0.15F, 0, 0.26F), side(0, 0.3F, 0);
    flip ? add_rectangle(mesh, {0, 0, 0}, up, up + side, side) : add_rectangle(mesh, {0, 0, 0}, side, side + up, up);
    const auto edges = all_edges(scene_of({{mesh}}));
    ASSERT_EQ(edges.size(), 7U);
    EXPECT_EQ(std::ranges::count_if(edges, [](const auto& edge) { return edge.exterior < 1.9; }), 1);
    for (const StraightEdges::Edge& edge : edges) {
      if (edge.exterior < 1.9) {
        EXPECT_NEAR(edge.exterior, 2 - std::atan2(0.26, 0.15) / kPi, 1e-5);
        EXPECT_LT(edge.sides[0].normal.z() + edge.sides[1].normal.z(), 0);
      }
    }
  }
}

TEST(StraightEdgesTest, SmoothBodiesAndThoseWithoutAHeightHaveNone) {
  EXPECT_FALSE(edges_of(scene_of({{make_sphere(1, 0.1)}})).any());
  EXPECT_FALSE(edges_of(scene_of({{make_cylinder(0.3, 1, 0.1)}})).any());  // Its rims are no straight ones.
  EXPECT_FALSE(edges_of(scene_of({{.mesh = make_box({1, 1, 1}), .rms_height = 0}})).any());
  Mesh rounded = make_box({1, 1, 1});
  for (std::size_t i = 0; i < rounded.vertices.size(); ++i) {
    rounded.normals[i] = rounded.vertices[i].normalized();
  }
  EXPECT_FALSE(edges_of(scene_of({{rounded}})).any());
  EXPECT_FALSE(edges_of(scene_of({{make_box({0.02, 0.02, 0.02})}})).any());  // Too short.
}

TEST(StraightEdgesTest, WhereSomethingTouchesThereIsNone) {
  const Body floor = {make_plane(Vec3::UnitZ(), 4, 4)};
  Body box = {make_box({0.4, 0.4, 0.4}), {.position = {0.2, 0.1, 0.2}}};
  EXPECT_EQ(all_edges(scene_of({floor, box})).size(), 4U + 8U);
  box.pose.position.z() = 0.23;
  EXPECT_EQ(all_edges(scene_of({floor, box})).size(), 4U + 12U);
  // What moves may be elsewhere at the next ping.
  box.pose.position.z() = 0.2;
  box.moving = true;
  EXPECT_EQ(all_edges(scene_of({floor, box})).size(), 4U + 12U);
  // Two boxes end to end without common corners, turned and far from the origin: their eight edges at the joint are
  // none.
  const Pose frame = {.position = {70, -40, 12}, .orientation = orientation_from_rpy(0.3, 0.2, 1)};
  const Body one = {make_box({0.3, 0.3, 1}), frame};
  const Body two = {make_box({0.3, 0.3, 0.5}), frame * Pose{.position = {0, 0, 0.75}}};
  EXPECT_EQ(all_edges(scene_of({one, two})).size(), 2U * 12U - 8U);
}

// Of thin parts square profiles have edges without glints; a rod of six sides has none, which would have if it were
// thick.
TEST(StraightEdgesTest, OfThinPartsThoseOfSquareOnesCount) {
  const Scene tube = scene_of({{make_box({0.05, 0.05, 1})}});
  const StraightEdges edges =
      edges_of(tube, {.thickness = {std::make_shared<const std::vector<float>>(12, 0.05F)}, .glinting = {}});
  ASSERT_EQ(edges.groups.size(), 1U);
  ASSERT_EQ(edges.groups[0].edges.size(), 12U);
  EXPECT_EQ(edges.groups[0].edges[0].sides[0].face, StraightEdges::kNoGlint);
  Mesh rod;
  const auto corner = [](int k) -> Vec3f {
    return {0.04F * static_cast<float>(std::cos(k % 6 * kPi / 3)),
            0.04F * static_cast<float>(std::sin(k % 6 * kPi / 3)), 0};
  };
  for (int k = 0; k < 6; ++k) {
    add_rectangle(rod, corner(k), corner(k + 1), corner(k + 1) + Vec3f::UnitZ(), corner(k) + Vec3f::UnitZ());
  }
  const Scene rods = scene_of({{rod}});
  EXPECT_EQ(edges_of(rods).groups[0].edges.size(), 6U + 12U);  // With its borders at both ends.
  EXPECT_FALSE(
      edges_of(rods, {.thickness = {std::make_shared<const std::vector<float>>(12, 0.05F)}, .glinting = {}}).any());
}

// What does not move is one group, in a frame near it that is turned as the world; each instance that moves has its
// own.
TEST(StraightEdgesTest, GroupsAreInFramesOfTheirOwn) {
  const Pose pose = {.position = {4000, -3000, 40}, .orientation = orientation_from_rpy(0.3, 0.2, 1)};
  const StraightEdges edges = edges_of(scene_of({{make_box({0.4, 0.4, 0.4}), pose},
                                                 {.mesh = make_box({0.5, 0.5, 0.5}), .pose = pose, .moving = true},
                                                 {make_box({0.6, 0.6, 0.6}), Pose{.position = {0, 0, 2}} * pose}}));
  ASSERT_EQ(edges.groups.size(), 2U);
  ASSERT_EQ(edges.groups[0].edges.size(), 24U);
  EXPECT_EQ(edges.groups[1].instance, 1);
  for (const StraightEdges::Edge& edge : edges.groups[1].edges) {
    EXPECT_NEAR(edge.middle.norm(), 0.25 * std::numbers::sqrt2, 1e-6);
  }
  const Pose frame = StraightEdges::frame(edges.groups[0], {});
  EXPECT_NEAR(edges.groups[0].middle_x[0], 0, 1e-9);
  for (std::size_t i = 0; i < 12; ++i) {
    const StraightEdges::Edge& edge = edges.groups[0].edges[i];
    const Vec3 inside = pose.inverse() * (frame * edge.middle);
    EXPECT_NEAR(inside.norm(), 0.2 * std::numbers::sqrt2, 1e-6);
    const Vec3 outwards = pose.orientation.inverse() * (edge.sides[0].normal + edge.sides[1].normal);
    EXPECT_NEAR(outwards.normalized().dot(inside.normalized()), 1, 1e-6);
    EXPECT_EQ(edges.groups[0].first_y[i], static_cast<float>(edge.sides[0].normal.y()));
  }
}

// The sum of e^(2ikr)/r^2 over steps of an eighth of a wavelength.
std::complex<double> summed(double foot, double half, double distance, double wavelength) {
  const int steps = static_cast<int>(16 * half / wavelength) + 1;
  std::complex<double> sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double range = std::hypot(distance, -half + (i + 0.5) * 2 * half / steps - foot);
    sum += std::polar(1 / (range * range), 4 * kPi / wavelength * range);
  }
  return sum * (2 * half / steps);
}

// Plates of 0.2 m in a row, and ten of 0.1 m whose edges are the shortest.
TEST(StraightEdgesTest, OfTooManyTheLongestCount) {
  constexpr auto kPlates = static_cast<int>(StraightEdges::kMost / 4);
  Mesh mesh;
  for (int i = 0; i < kPlates + 10; ++i) {
    const float x = static_cast<float>(i), side = i % 200 == 7 && i < 2000 ? 0.1F : 0.2F;
    add_rectangle(mesh, {x, 0, 0}, {x + side, 0, 0}, {x + side, side, 0}, {x, side, 0});
  }
  mesh.material_names = {""};
  const StraightEdges found = edges_of(scene_of({{std::move(mesh)}}));
  EXPECT_EQ(found.left_out, 40);
  ASSERT_EQ(found.groups.size(), 1);
  EXPECT_EQ(found.groups[0].edges.size(), StraightEdges::kMost);
  EXPECT_GT(std::ranges::min(found.groups[0].half), 0.099F);
}

// Boxes that share a mesh and a material have the faces, edges and mirrors of boxes with meshes of their own.
TEST(StraightEdgesTest, AlikeInstancesHaveThoseOfTheFirst) {
  const Pose other = {.position = {5, 1, 0}, .orientation = orientation_from_rpy(0.1, 0.2, 0.3)};
  Scene apart =
      scene_of({{make_box({1, 2, 3})}, {make_sphere(1, 0.3), {.position = {9, 9, 9}}}, {make_box({1, 2, 3}), other}});
  apart.instances[2].materials = apart.instances[0].materials;
  Scene shared = apart;
  shared.instances[2].mesh = shared.instances[0].mesh;
  const StraightEdges expected = edges_of(apart), found = edges_of(shared);
  ASSERT_EQ(found.groups.size(), 1U);
  ASSERT_EQ(found.groups[0].edges.size(), 24U);
  for (std::size_t i = 0; i < 24; ++i) {
    const StraightEdges::Edge &a = found.groups[0].edges[i], &b = expected.groups[0].edges[i];
    EXPECT_EQ(a.middle, b.middle);
    EXPECT_EQ(a.sides[0].surface, b.sides[0].surface);
    EXPECT_EQ(a.sides[1].face, b.sides[1].face);
  }
  LeftOut left_out;
  const GlintingFaces faces = find_glinting_faces(shared, left_out, workers);
  EXPECT_EQ(faces.count(), 12U);
  EXPECT_EQ(faces.group_of(2)->first_number, 6U);
  EXPECT_EQ(faces.group_of(1), nullptr);
  EXPECT_EQ(left_out.glinting[2], left_out.glinting[0]);
  const std::vector<PlaneMirror> mirrors = find_plane_mirrors(shared, -1, workers);
  const std::vector<PlaneMirror> of_apart = find_plane_mirrors(apart, -1, workers);
  ASSERT_EQ(mirrors.size(), 12U);
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(mirrors[i].normal, of_apart[i].normal);
    EXPECT_EQ(mirrors[i].triangles[0].surface, of_apart[i].triangles[0].surface);
  }
}

// Of two boxes of one mesh the second has relief on three sides, which do not glint.
TEST(StraightEdgesTest, InstancesThatDifferInReliefAreNotAlike) {
  Mesh box = make_box({1, 2, 3});
  box.material_names = {"smooth", "rippled"};
  box.material_slots = {0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1};
  Scene scene = scene_of({{box}, {box, {.position = {5, 0, 0}}}});
  scene.instances[1].mesh = scene.instances[0].mesh;
  scene.instances[1].materials = scene.instances[0].materials;
  scene.instances[1].reliefs = {nullptr, std::make_shared<const Relief>()};
  LeftOut left_out;
  EXPECT_EQ(find_glinting_faces(scene, left_out, workers).count(), 6U + 3U);
}

TEST(EdgeIntegralTest, IsTheSumAlongTheEdge) {
  struct Case {
    double foot, half, distance;
  };
  constexpr double kWavelength = 1480.0 / 410e3;
  for (const Case& c : {Case{0, 0.4, 6}, Case{0.21, 0.4, 6}, Case{0.4, 0.4, 6}, Case{0.47, 0.4, 6}, Case{0, 0.03, 8},
                        Case{-0.1, 0.03, 8}, Case{-0.35, 1.1, 2.3}}) {
    const EdgeEcho echo = edge_integral(c.foot, c.half, c.distance, kWavelength);
    const double nearest = std::hypot(c.distance, std::max(std::abs(c.foot) - c.half, 0.0));
    const std::complex<double> expected = summed(c.foot, c.half, c.distance, kWavelength);
    const std::complex<double> actual =
        std::polar(echo.amplitude, 2 * kPi * echo.turns + 4 * kPi / kWavelength * nearest);
    EXPECT_LT(std::abs(actual - expected), 0.03 * std::abs(expected)) << c.foot << ", " << c.half;
  }
  // Of an endless one sqrt(lambda r/2)/r^2, an eighth of a turn late; of a short one its length over r^2.
  const EdgeEcho endless = edge_integral(3, 400, 5, kWavelength);
  EXPECT_NEAR(endless.amplitude, std::sqrt(kWavelength / (2 * 125)), 1e-4 * endless.amplitude + 1e-5);
  EXPECT_NEAR(endless.turns, 0.125, 2e-3);
  EXPECT_NEAR(edge_integral(0, 0.01, 60, kWavelength).amplitude, 0.02 / 3600, 1e-8);
}

}  // namespace
}  // namespace insonify::straight_edges_test
