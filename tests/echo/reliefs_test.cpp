// reliefs_test.cpp -- reliefs mapped onto surfaces, by texture coordinates and by position, one hit or sixteen at a
// time.

#include "echo/model/reliefs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "echo/laws/laws.h"
#include "insonify/mesh.h"
#include "insonify/scene.h"

namespace insonify::reliefs_test {
namespace {

using Vec2f = Eigen::Vector2f;
constexpr float kFloat = 1e-5F;

Instance with_relief(const Mesh& mesh, const Relief& relief) {
  Instance instance;
  instance.mesh = std::make_shared<const Mesh>(mesh);
  instance.reliefs = {std::make_shared<const Relief>(relief)};
  return instance;
}

ReliefPoint relief_at(const Relief& relief, const Mesh& mesh, std::uint32_t triangle, const Vec3f& position,
                      const Vec3f& normal) {
  Scene scene;
  scene.instances = {with_relief(mesh, relief)};
  Reliefs reliefs;
  reliefs.set(scene, Vec3::Zero());
  return reliefs.at(0, triangle, position, normal);
}

Relief constant(const Vec2f& slope, double tile_size = 1) {
  Relief relief;
  relief.slopes = {1, 1, {slope}};
  relief.tile_size = tile_size;
  return relief;
}

// A rectangle in x-y of 4 x 2 m, with texture coordinates at its corners (-,-), (+,-), (+,+), (-,+).
Mesh rectangle(const std::array<Vec2f, 4>& texture) {
  Mesh mesh = make_plane(Vec3::UnitZ(), 4, 2);
  for (const auto& triangle : mesh.triangles) {
    auto& corners = mesh.texture_coordinates.emplace_back();
    for (int k = 0; k < 3; ++k) {
      const Vec3f& vertex = mesh.vertices[triangle[k]];
      corners[k] = texture[vertex.y() < 0 ? (vertex.x() < 0 ? 0 : 1) : (vertex.x() < 0 ? 3 : 2)];
    }
  }
  return mesh;
}

Vec3f gradient_on(const Mesh& mesh, const Relief& relief, const Vec3f& at = {0.1F, 0.2F, 0}) {
  const auto triangle = static_cast<std::uint32_t>(at.y() * 2 > at.x() ? 1 : 0);
  return relief_at(relief, mesh, triangle, at, Vec3f::UnitZ()).gradient;
}

TEST(ReliefAtTest, TangentFrameFollowsTheTexture) {
  const Relief relief = constant({0.3F, 0.1F});
  const Mesh upright = rectangle({Vec2f(0, 0), {1, 0}, {1, 1}, {0, 1}});
  EXPECT_LT((gradient_on(upright, relief) - Vec3f(0.3F, 0.1F, 0)).norm(), kFloat);
  const Mesh turned = rectangle({Vec2f(1, 0), {1, 1}, {0, 1}, {0, 0}});  // Its right is +y... up the rectangle's x.
  // u falls with y, v rises with x.
  EXPECT_LT((gradient_on(turned, relief) - Vec3f(0.1F, -0.3F, 0)).norm(), kFloat);
  const Mesh mirrored = rectangle({Vec2f(1, 0), {0, 0}, {0, 1}, {1, 1}});
  EXPECT_LT((gradient_on(mirrored, relief) - Vec3f(-0.3F, 0.1F, 0)).norm(), kFloat);
}

// h = u on a skewed picture: the gradient must climb by 1 along `right` and not at all along `up`.
TEST(ReliefAtTest, HeightsOfAPictureKeepTheirMetres) {
  Relief relief = constant({1, 0});
  relief.rise_per_tile = true;
  const Mesh plain = rectangle({Vec2f(0, 0), {1, 0}, {1, 1}, {0, 1}});  // 4 m to the right, 2 m up.
  EXPECT_LT((gradient_on(plain, relief) - Vec3f(0.25F, 0, 0)).norm(), kFloat);
  const Mesh skewed = rectangle({Vec2f(0, 0), {1, 0}, {1.5F, 1}, {0.5F, 1}});
  EXPECT_LT((gradient_on(skewed, relief) - Vec3f(0.25F, 0.25F, 0)).norm(), kFloat);
}

TEST(ReliefAtTest, ReadsThePictureWhereTheTextureSays) {
  Relief relief;
  relief.reflectivity = {2, 1, {0, 1}};
  const Mesh mesh = rectangle({Vec2f(0, 0), {1, 0}, {1, 1}, {0, 1}});
  EXPECT_NEAR(relief_at(relief, mesh, 0, {1, -0.5F, 0}, Vec3f::UnitZ()).reflectivity, 1, kFloat);  // u = 3/4
  EXPECT_NEAR(relief_at(relief, mesh, 1, {-1, 0.5F, 0}, Vec3f::UnitZ()).reflectivity, 0, kFloat);  // u = 1/4
  EXPECT_NEAR(relief_at(relief, mesh, 1, {-0.5F, 0.5F, 0}, Vec3f::UnitZ()).reflectivity, 0.25F, kFloat);
}

// Between the middles of texels values are bilinear, also across the border of the tile: as Tile::at().
TEST(ReliefAtTest, ReadsBetweenTexels) {
  Relief relief;
  relief.reflectivity = {3, 4, {0.1F, 0.9F, 0.4F, 0.7F, 0.2F, 0.6F, 0.3F, 1.0F, 0.5F, 0.8F, 0.0F, 0.35F}};
  const Mesh mesh = rectangle({Vec2f(0, 0), {1, 0}, {1, 1}, {0, 1}});
  for (float x = -1.95F; x < 2; x += 0.37F) {
    for (float y = -0.95F; y < 1; y += 0.21F) {
      const auto triangle = static_cast<std::uint32_t>(y * 2 > x ? 1 : 0);
      EXPECT_NEAR(relief_at(relief, mesh, triangle, {x, y, 0}, Vec3f::UnitZ()).reflectivity,
                  relief.reflectivity.at((x + 2) / 4, (y + 1) / 2), kFloat)
          << x << " " << y;
    }
  }
}

TEST(ReliefAtTest, MapsByPositionWithoutTextureCoordinates) {
  Mesh mesh = make_plane(Vec3::UnitZ(), 4, 2);
  Relief relief;
  relief.reflectivity = {2, 1, {0, 1}};
  relief.tile_size = 2;
  EXPECT_NEAR(relief_at(relief, mesh, 0, {1.5F, -0.5F, 0}, Vec3f::UnitZ()).reflectivity, 1, kFloat);
  EXPECT_NEAR(relief_at(relief, mesh, 0, {0.5F, -0.5F, 0}, Vec3f::UnitZ()).reflectivity, 0, kFloat);
  // Degenerate texture coordinates are ignored, and so are all where by_position is set.
  mesh = rectangle({Vec2f(0, 0), {0, 0}, {0, 0}, {0, 0}});
  EXPECT_NEAR(relief_at(relief, mesh, 0, {1.5F, -0.5F, 0}, Vec3f::UnitZ()).reflectivity, 1, kFloat);
  mesh = rectangle({Vec2f(0, 0), {8, 0}, {8, 1}, {0, 1}});
  const float by_texture = relief_at(relief, mesh, 0, {1.5F, -0.5F, 0}, Vec3f::UnitZ()).reflectivity;
  relief.by_position = true;
  EXPECT_NEAR(relief_at(relief, mesh, 0, {1.5F, -0.5F, 0}, Vec3f::UnitZ()).reflectivity, 1, kFloat);
  EXPECT_NEAR(by_texture, 0.5F, kFloat);
  relief = constant({1, 1}, 0);  // Mapped by texture coordinates only.
  EXPECT_TRUE(relief_at(relief, make_plane(Vec3::UnitZ(), 4, 2), 0, {0, 0, 0}, Vec3f::UnitZ()).gradient.isZero(0));
}

// Coordinates whose differences overflow a float are ignored.
TEST(ReliefAtTest, NonFiniteTextureCoordinatesAreIgnored) {
  constexpr float kHuge = 3e38F;
  const Mesh mesh = rectangle({Vec2f(-kHuge, -kHuge), {kHuge, -kHuge}, {kHuge, kHuge}, {-kHuge, kHuge}});
  Relief relief;
  relief.reflectivity = {2, 1, {0, 1}};
  relief.tile_size = 2;
  EXPECT_NEAR(relief_at(relief, mesh, 0, {1.5F, -0.5F, 0}, Vec3f::UnitZ()).reflectivity, 1, kFloat);
  const Mesh far = rectangle({Vec2f(1e30F, 0), {1e30F, 1}, {1e30F, 2}, {-1e30F, 3}});
  EXPECT_TRUE(std::isfinite(relief_at(relief, far, 1, {-0.5F, 0.5F, 0}, Vec3f::UnitZ()).reflectivity));
}

// On the faces across the axes the picture lies as it is seen along them; in between gradients stay in the surface and
// change little by little.
TEST(ReliefAtTest, PositionsBlendAllRoundASphere) {
  const Relief relief = constant({0.3F, 0.1F});
  const Mesh mesh = make_sphere(1);
  const auto at = [&](const Vec3f& normal) { return relief_at(relief, mesh, 0, normal, normal).gradient; };
  EXPECT_LT((at({0, 0, 1}) - Vec3f(0.3F, 0.1F, 0)).norm(), kFloat);
  EXPECT_LT((at({0, 0, -1}) - Vec3f(0.3F, 0.1F, 0)).norm(), kFloat);
  EXPECT_LT((at({1, 0, 0}) - Vec3f(0, 0.3F, 0.1F)).norm(), kFloat);
  EXPECT_LT((at({0, 1, 0}) - Vec3f(0.3F, 0, 0.1F)).norm(), kFloat);
  Vec3f before = at({0, 0, 1});
  for (int step = 1; step <= 400; ++step) {
    const double polar = 0.01 * step, azimuth = 0.7;
    const Vec3f normal =
        Vec3(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar)).cast<float>();
    const Vec3f gradient = at(normal);
    EXPECT_NEAR(gradient.dot(normal), 0, kFloat);
    EXPECT_LT((gradient - before).norm(), 0.02F) << polar;
    before = gradient;
  }
}

// Sixteen hits on five objects, two of which share a relief and one of which has none, among rays that hit nothing: the
// same numbers as each hit by itself.
TEST(ReliefLanesTest, HitsOnSeveralObjectsAreThoseOfEachAlone) {
  const Relief slopes = constant({0.3F, 0.1F});
  Relief patches;
  patches.reflectivity = {2, 1, {0, 1}};
  patches.slopes = {2, 2, {Vec2f(0.1F, 0.2F), {-0.3F, 0.4F}, {0, 0.5F}, {0.6F, 0}}};
  Relief rise = patches;
  rise.rise_per_tile = true;
  const Mesh textured = rectangle({Vec2f(0, 0), {1, 0}, {1.5F, 1}, {0.5F, 1}});
  Mesh torn = textured;  // The second triangle has no usable texture.
  torn.texture_coordinates[1] = {Vec2f(0, 0), {0, 0}, {0, 0}};
  Scene scene;
  scene.instances = {with_relief(textured, slopes),
                     with_relief(torn, patches),
                     with_relief(textured, rise),
                     with_relief(make_plane(Vec3::UnitZ(), 4, 2), patches),
                     {}};
  scene.instances[1].reliefs = scene.instances[3].reliefs;
  scene.instances[4].mesh = std::make_shared<const Mesh>(textured);
  for (int i = 0; i < 5; ++i) {
    scene.instances[i].world_from_mesh.orientation = Eigen::AngleAxisd(0.3 * i, Vec3(1, 2, 3).normalized());
    scene.instances[i].world_from_mesh.position = Vec3(0.1 * i, 1, -2);
  }
  Reliefs reliefs;
  reliefs.set(scene, Vec3(0.5, 0, 0));
  ReliefHits hits;
  for (int lane = 0; lane < ReliefHits::kLanes; ++lane) {
    const auto t = static_cast<float>(lane);
    const bool nothing = lane % 6 == 5;
    hits.set(lane, nothing ? ReliefHits::kNone : lane % 5, nothing ? 99999 : lane / 5 % 2,
             {0.3F * t, std::sin(t), std::cos(t)}, Vec3f(0.1F * t, -0.3F, 2));
  }
  ReliefLanes lanes;
  reliefs.find(hits, lanes);
  for (int lane = 0; lane < ReliefHits::kLanes; ++lane) {
    SCOPED_TRACE(lane);
    const bool nothing = hits.instance[lane] == ReliefHits::kNone;
    const ReliefPoint alone =
        nothing ? ReliefPoint()
                : reliefs.at(hits.instance[lane], hits.triangle[lane], {hits.x[lane], hits.y[lane], hits.z[lane]},
                             {hits.normal_x[lane], hits.normal_y[lane], hits.normal_z[lane]});
    EXPECT_EQ(lanes.gradient_x[lane], alone.gradient.x());
    EXPECT_EQ(lanes.gradient_y[lane], alone.gradient.y());
    EXPECT_EQ(lanes.gradient_z[lane], alone.gradient.z());
    EXPECT_EQ(lanes.reflectivity[lane], alone.reflectivity);
    EXPECT_EQ(alone.gradient.isZero(0), nothing || hits.instance[lane] == 4);
  }
}

// A slope of 3/4 tilts the normal by 36.9 degrees, to (-0.6, 0, 0.8); where nothing was hit, 0 stays 0.
TEST(ReliefLanesTest, NormalsAreBentToUnitLength) {
  ReliefLanes lanes;
  lanes.flatten();
  lanes.gradient_x[3] = 0.75F;
  alignas(64) float x[ReliefHits::kLanes] = {}, y[ReliefHits::kLanes] = {}, z[ReliefHits::kLanes] = {0, 0, 5, 7};
  lanes.bend(x, y, z);
  EXPECT_EQ(z[0], 0);
  EXPECT_EQ(z[2], 1);
  EXPECT_NEAR(x[3], -0.6F, kFloat);
  EXPECT_NEAR(z[3], 0.8F, kFloat);
}

// Sound that grazes at 10 degrees, cot 5.671, on a facet of slope g towards it: 1 + g cot of the solid angle of the
// flat surface, from none to twice as much.
TEST(FacetShareTest, FacetsCoverTheViewAsTheyAreTurned) {
  const double grazing = radians_from_degrees(10);
  const Vec3 direction(std::cos(grazing), 0, -std::sin(grazing));
  const auto share = [&](double slope) {
    const Vec3 gradient(slope, 0.04, 0), bent = (Vec3::UnitZ() - gradient).normalized();
    return facet_share(triple_of(Vec3f(gradient.cast<float>())), triple_of(Vec3f(direction.cast<float>())),
                       static_cast<float>(bent.dot(direction)));
  };
  EXPECT_NEAR(share(0), 1, 1e-5);
  EXPECT_NEAR(share(0.1), 1.5671, 1e-4);
  EXPECT_NEAR(share(-0.1), 0.4329, 1e-4);
  EXPECT_NEAR(share(-0.17), 0.0359, 1e-4);
  EXPECT_EQ(share(-0.3), 0);
  EXPECT_EQ(share(0.3), 2);
}

}  // namespace
}  // namespace insonify::reliefs_test
