// small_faces_test.cpp -- which plane faces are small, and that their strips have their surface.

#include "echo/targets/small_faces.h"

#include <gtest/gtest.h>

#include "echo/targets/face_glints.h"
#include "support/test_engine.h"

namespace insonify::small_faces_test {
namespace {

Scene scene_of(std::vector<Mesh> meshes, double rms_height = 0) {
  Scene scene;
  scene.materials.resize(1);
  scene.materials[0].rms_height = rms_height;
  for (Mesh& mesh : meshes) {
    Instance instance;
    instance.name = "thing";
    instance.mesh = std::make_shared<const Mesh>(std::move(mesh));
    instance.world_from_mesh = {{3, 4, 5}, orientation_from_rpy(0.1, 0.2, 0.3)};
    instance.materials = {0};
    scene.instances.push_back(std::move(instance));
  }
  return scene;
}

struct Found {
  ThinParts parts;
  LeftOut left_out;

  // Area by the coordinate to which normals point: 0, 1, 2 for x, y, z, 3 to 5 for -x, -y, -z [m^2].
  [[nodiscard]] std::array<double, 6> areas() const {
    std::array<double, 6> sums{};
    for (const ThinParts::Patch& patch : parts.patches) {
      int coordinate = 0;
      patch.normal.cwiseAbs().maxCoeff(&coordinate);
      sums.at(patch.normal[coordinate] > 0 ? coordinate : coordinate + 3) += patch.area;
    }
    return sums;
  }
};

Found find(const Scene& scene) {
  const std::unique_ptr<TestEngine> engine = test_engine("cpu", 2);
  engine->set_scene(scene);
  Workers workers(2);
  Found found{find_thin_parts(scene, engine->engine(), workers), {}};
  found.left_out = found.parts.triangles ? *found.parts.triangles : LeftOut{};
  (void)find_glinting_faces(scene, found.left_out, workers);
  add_small_faces(scene, engine->engine(), workers, found.left_out, found.parts);
  return found;
}

void expect_areas(const Found& found, const std::array<double, 6>& expected) {
  for (int i = 0; i < 6; ++i) {
    EXPECT_NEAR(found.areas().at(i), expected.at(i), 1e-5) << i;
  }
}

// Four strips by two slabs of 1.5 m.
TEST(SmallFacesTest, ASheetEchoesOnBothSides) {
  const Found found = find(scene_of({make_plane(Vec3::UnitZ(), 0.12, 3)}));
  EXPECT_EQ(found.parts.pieces.size(), 8U);
  expect_areas(found, {0, 0, 0.36, 0, 0, 0.36});
  for (const ThinParts::Piece& piece : found.parts.pieces) {
    EXPECT_NEAR(piece.half.norm(), 0.75, 1e-5);
    EXPECT_NEAR(piece.thickness, 0.12, 1e-5);
    EXPECT_NEAR(std::abs(piece.half.normalized().y()), 1, 1e-5);
    EXPECT_NEAR(piece.side.norm(), 0.015, 1e-5);
  }
  EXPECT_NEAR(found.left_out.thickness[0]->at(0), 0.12, 1e-5);
}

// Behind the large faces the plate is nearer than 0.3 widths, behind its rims it is not: there rays tell what is
// hidden.
TEST(SmallFacesTest, APlateEchoesOutwards) {
  expect_areas(find(scene_of({make_box({0.01, 0.2, 0.3})})), {0.06, 0.006, 0.004, 0.06, 0.006, 0.004});
}

TEST(SmallFacesTest, FacesGivenTwiceEchoOnce) {
  Mesh mesh = make_plane(Vec3::UnitZ(), 0.2, 0.2);
  for (const auto& [a, b, c] : std::vector(mesh.triangles)) {
    mesh.triangles.push_back({a, c, b});
  }
  expect_areas(find(scene_of({mesh})), {0, 0, 0.04, 0, 0, 0.04});
}

TEST(SmallFacesTest, WideThinAndRoundThingsHaveNone) {
  EXPECT_TRUE(find(scene_of({make_box({1.1, 1.2, 1.3})})).parts.pieces.empty());
  EXPECT_TRUE(find(scene_of({make_sphere(0.7, 0.2)})).parts.pieces.empty());
  const Found rod = find(scene_of({make_box({0.02, 0.02, 0.5})}));  // Its sides are thin parts already, its ends not.
  for (const ThinParts::Piece& piece : rod.parts.pieces) {
    EXPECT_TRUE(!piece.is_strip() || std::abs(rod.parts.patches[piece.first_patch].normal.z()) > 0.99F);
  }
}

// A frame fills too little of its rectangle: its strips would lie in the hole.
TEST(SmallFacesTest, FramesHaveNone) {
  const auto frame = [](float inner) {
    Mesh mesh;
    for (const float half : {0.2F, inner}) {
      mesh.vertices.insert(mesh.vertices.end(),
                           {{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}});
    }
    mesh.normals.assign(8, Vec3f::UnitZ());
    for (std::uint32_t i = 0; i < 4; ++i) {
      const std::uint32_t next = (i + 1) % 4;
      mesh.triangles.insert(mesh.triangles.end(), {{i, next, i + 4}, {next, next + 4, i + 4}});
    }
    return mesh;
  };
  EXPECT_TRUE(find(scene_of({frame(0.18F)})).parts.pieces.empty());
  EXPECT_EQ(find(scene_of({frame(0.1F)})).parts.pieces.size(), 4U);
}

TEST(SmallFacesTest, AnObjectOfManyIsLeftToTheSamples) {
  for (const int count : {16, 17}) {
    Mesh many;
    for (int i = 0; i < count; ++i) {
      const Mesh one = make_plane(Vec3::UnitZ(), 0.2, 0.2);
      const auto first = static_cast<std::uint32_t>(many.vertices.size());
      for (const Vec3f& vertex : one.vertices) {
        many.vertices.emplace_back(vertex + Vec3f(0, static_cast<float>(i), 0));
      }
      many.normals.insert(many.normals.end(), one.normals.begin(), one.normals.end());
      for (const auto& [a, b, c] : one.triangles) {
        many.triangles.push_back({first + a, first + b, first + c});
      }
    }
    const Found found = find(scene_of({many}));
    EXPECT_EQ(found.parts.pieces.size(), count == 16 ? 64U : 0U);
    EXPECT_EQ(found.left_out.thickness[0] != nullptr, count == 16);
  }
}

TEST(SmallFacesTest, FacesThatGlintKeepTheirGlint) {
  for (const double rms_height : {0.0, 1e-4}) {
    const Found found = find(scene_of({make_plane(Vec3::UnitZ(), 0.2, 0.2)}, rms_height));
    ASSERT_EQ(found.parts.pieces.size(), 4U);
    EXPECT_EQ(found.parts.pieces[0].glints, rms_height > 0);
  }
}

}  // namespace
}  // namespace insonify::small_faces_test
