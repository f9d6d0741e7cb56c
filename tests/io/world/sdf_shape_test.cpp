// sdf_shape_test.cpp -- every SDF geometry has its size, and identical ones share a mesh.

#include <png.h>

#include "io/sdf_files.h"

namespace insonify::sdf_shape_test {
namespace {

// Round shapes have facets of at most 0.05 rad: their extent is too small by at most 1 - cos(0.025) = 0.0003.
constexpr double kFacetError = 4e-4;

// A corner of three unequal edges, so that each axis shows: 1 along x, 2 along y, 3 along z. Wound outwards.
constexpr const char* kCorner = "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

class SdfShapeTest : public SdfTest {
 protected:
  // Bounds of the only visual, which is at the origin.
  Box3 bounds_of(const std::string& geometry, bool collision = false) {
    std::string text = sdf_of(geometry);
    if (collision) {
      for (std::size_t at = text.find("visual"); at != std::string::npos; at = text.find("visual")) {
        text.replace(at, 6, "collision");
      }
    }
    const Scene scene = load(text, collision);
    EXPECT_EQ(scene.instances.size(), 1);
    return world_bounds(scene.instances.at(0));
  }
  void expect_extent(const std::string& geometry, const Vec3& low, const Vec3& high, double tolerance) {
    const Box3 box = bounds_of(geometry);
    EXPECT_THAT(box.low, Near3(low, tolerance)) << geometry;
    EXPECT_THAT(box.high, Near3(high, tolerance)) << geometry;
  }
  std::string error_with(const std::string& geometry) { return error_of(sdf_of(geometry)); }

  const std::string where = "scene.sdf:4:1: visual 'ship::hull::plate'";
};

// Volume enclosed, by the divergence theorem; negative when the triangles wind inwards.
double volume_of(const Mesh& mesh) {
  double volume = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    volume += static_cast<double>(mesh.vertices[a].dot(mesh.vertices[b].cross(mesh.vertices[c]))) / 6;
  }
  return volume;
}

// Least cosine between a triangle's normal by winding and the shading normals of its corners.
double least_agreement(const Mesh& mesh) {
  double least = 1;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3f face = (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]).normalized();
    for (const std::uint32_t vertex : {a, b, c}) {
      least = std::min(least, static_cast<double>(face.dot(mesh.normals[vertex])));
    }
  }
  return least;
}

// 8-bit grey picture.
void write_grey_png(const std::string& path, unsigned width, unsigned height, const std::vector<std::uint8_t>& shades) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = width;
  image.height = height;
  image.format = PNG_FORMAT_GRAY;
  ASSERT_NE(png_image_write_to_file(&image, path.c_str(), 0, shades.data(), 0, nullptr), 0);
}

TEST_F(SdfShapeTest, PrimitivesHaveTheirSizes) {
  expect_extent("<box><size>1 2 3</size></box>", {-0.5, -1, -1.5}, {0.5, 1, 1.5}, kVertexError);
  expect_extent("<sphere><radius>0.7</radius></sphere>", Vec3::Constant(-0.7), Vec3::Constant(0.7), 0.7 * kFacetError);
  expect_extent("<ellipsoid><radii>1 2 3</radii></ellipsoid>", {-1, -2, -3}, {1, 2, 3}, 3 * kFacetError);
  expect_extent("<cylinder><radius>0.5</radius><length>4</length></cylinder>", {-0.5, -0.5, -2}, {0.5, 0.5, 2},
                0.5 * kFacetError);
  expect_extent("<capsule><radius>0.5</radius><length>4</length></capsule>", {-0.5, -0.5, -2.5}, {0.5, 0.5, 2.5},
                0.5 * kFacetError);
}

TEST_F(SdfShapeTest, ReadsTheConeOfNewerVersions) {
  expect_extent("<cone><radius>0.5</radius><length>4</length></cone>", {-0.5, -0.5, -2}, {0.5, 0.5, 2},
                0.5 * kFacetError);
}

TEST_F(SdfShapeTest, AVisualPlaneHasItsSizeAndOthersAreEndless) {
  const double far = 5000;  // half of 10 km
  EXPECT_THAT(bounds_of("<plane><normal>0 0 1</normal><size>20 30</size></plane>").high,
              Near3(Vec3(10, 15, 0), kVertexError));
  EXPECT_THAT(bounds_of("<plane><normal>0 0 1</normal></plane>").high, Near3(Vec3(far, far, 0), kVertexError));
  EXPECT_THAT(bounds_of("<plane><normal>0 0 1</normal><size>20 30</size></plane>", true).high,
              Near3(Vec3(far, far, 0), kVertexError));
}

TEST_F(SdfShapeTest, APlaneLiesAcrossItsNormal) {
  const Box3 box = bounds_of("<plane><normal>3 0 0</normal><size>20 20</size></plane>");
  EXPECT_THAT(box.low, Near3(Vec3(0, -10, -10), kVertexError));
  EXPECT_THAT(box.high, Near3(Vec3(0, 10, 10), kVertexError));
}

TEST_F(SdfShapeTest, MeshesAreScaledAndMirroredWithTheirNormals) {
  write("corner.obj", kCorner);
  expect_extent("<mesh><uri>corner.obj</uri></mesh>", {0, 0, 0}, {1, 2, 3}, kVertexError);
  for (const char* scale : {"2 3 0.5", "-2 3 0.5", "-2 -3 0.5", "-2 -3 -0.5"}) {
    const Scene scene = load(sdf_of(fmt::format("<mesh><uri>corner.obj</uri><scale>{}</scale></mesh>", scale)));
    const Mesh& mesh = *scene.instances.at(0).mesh;
    // The corner holds 1 x 2 x 3 / 6 = 1; scaled by 2 x 3 x 0.5 = 3. Still wound outwards.
    EXPECT_NEAR(volume_of(mesh), 3, kVertexError) << scale;
    EXPECT_GT(least_agreement(mesh), 1 - kVertexError) << scale;  // flat faces with sharp edges: normals are the faces'
  }
  expect_extent("<mesh><uri>corner.obj</uri><scale>-2 3 -0.5</scale></mesh>", {-2, 0, -1.5}, {0, 6, 0}, kVertexError);
}

TEST_F(SdfShapeTest, SubmeshesAreTakenAloneAndCentred) {
  write("two.obj", "o near\nv 0 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\no far\nv 10 0 0\nv 14 0 0\nv 10 6 0\nf 4 5 6\n");
  const std::string mesh = "<mesh><uri>two.obj</uri>{}</mesh>";
  expect_extent(fmt::format(fmt::runtime(mesh), ""), {0, 0, 0}, {14, 6, 0}, kVertexError);
  expect_extent(fmt::format(fmt::runtime(mesh), "<submesh><name>far</name></submesh>"), {10, 0, 0}, {14, 6, 0},
                kVertexError);
  expect_extent(fmt::format(fmt::runtime(mesh), "<submesh><name>far</name><center>true</center></submesh>"),
                {-2, -3, 0}, {2, 3, 0}, kVertexError);
  expect_extent(
      fmt::format(fmt::runtime(mesh), "<submesh><name>far</name><center>true</center></submesh><scale>2 2 2</scale>"),
      {-4, -6, 0}, {4, 6, 0}, kVertexError);
}

TEST_F(SdfShapeTest, SurveysKeepTheirSizeUnlessGivenOne) {
  // 3 x 2 nodes, 10 m apart, from -4 to 4 m; the first row is the northern one.
  write("bed.asc", "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 10\nNODATA_value -9999\n-4 0 4\n1 1 1\n");
  expect_extent("<heightmap><uri>bed.asc</uri></heightmap>", {-10, -5, -4}, {10, 5, 4}, kVertexError);
  expect_extent("<heightmap><uri>bed.asc</uri><size>40 30 16</size><pos>100 200 -5</pos></heightmap>", {80, 185, -13},
                {120, 215, 3}, kVertexError);
  // <pos> is in the visual's frame: after a quarter turn its x points along the world's y.
  std::string turned = sdf_of("<heightmap><uri>bed.asc</uri><pos>100 0 0</pos></heightmap>");
  turned.insert(turned.find("<geometry>"), "<pose>0 0 7 0 0 1.5707963267948966</pose>");
  EXPECT_THAT(world_bounds(load(turned).instances.at(0)).low, Near3(Vec3(-5, 90, 3), 1e-4));  // 100 m in floats
}

TEST_F(SdfShapeTest, TheBrightestPixelIsAsHighAsSize) {
  write_grey_png((folder / "bed.png").string(), 3, 2, {0, 25, 50, 0, 0, 0});
  expect_extent("<heightmap><uri>bed.png</uri><size>8 4 6</size></heightmap>", {-4, -2, 0}, {4, 2, 6}, kVertexError);
  expect_extent("<heightmap><uri>bed.png</uri></heightmap>", {-0.5, -0.5, 0}, {0.5, 0.5, 1}, kVertexError);
}

TEST_F(SdfShapeTest, SamplingPutsHeightsBetweenThoseGiven) {
  write("bed.asc", "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 10\nNODATA_value -9999\n0 0 -9999\n0 8 0\n");
  const Scene scene = load(sdf_of("<heightmap><uri>bed.asc</uri><sampling>4</sampling></heightmap>"));
  const Mesh& mesh = *scene.instances.at(0).mesh;
  // A quarter of the way along both edges towards the 8: bilinear, 8 / 4 / 4. Nodes are 2.5 m apart.
  const auto height_at = [&](float x, float y) {
    for (const Vec3f& vertex : mesh.vertices) {
      if ((vertex.head<2>() - Eigen::Vector2f(x, y)).norm() < 1e-3F) {
        return static_cast<double>(vertex.z());
      }
    }
    return std::nan("");
  };
  EXPECT_NEAR(height_at(-7.5F, 2.5F), 0.5, kVertexError);
  EXPECT_NEAR(height_at(0, -5), 8, kVertexError);
  // One corner has no data: the other three span a triangle, and there is nothing beyond it.
  EXPECT_NEAR(height_at(2.5F, -2.5F), 4, kVertexError);
  EXPECT_NEAR(height_at(5, -5), 4, kVertexError);
  EXPECT_TRUE(std::isnan(height_at(7.5F, 2.5F)));
}

TEST_F(SdfShapeTest, KeepsWhatIsAlikeOnce) {
  write("corner.obj", kCorner);
  const std::string visual = "<visual name='{}'><geometry>{}</geometry></visual>";
  const auto scene_of = [&](const std::string& a, const std::string& b) {
    return load("<sdf version='1.9'><model name='m'><link name='l'>" + fmt::format(fmt::runtime(visual), "a", a) +
                fmt::format(fmt::runtime(visual), "b", b) + "</link></model></sdf>");
  };
  const auto share = [](const Scene& scene) { return scene.instances.at(0).mesh == scene.instances.at(1).mesh; };
  EXPECT_TRUE(share(scene_of("<mesh><uri>corner.obj</uri></mesh>", "<mesh><uri>./corner.obj</uri></mesh>")));
  EXPECT_TRUE(share(scene_of("<sphere><radius>2</radius></sphere>", "<sphere><radius>2.0</radius></sphere>")));
  EXPECT_FALSE(share(scene_of("<sphere><radius>2</radius></sphere>", "<sphere><radius>3</radius></sphere>")));
  EXPECT_FALSE(
      share(scene_of("<mesh><uri>corner.obj</uri></mesh>", "<mesh><uri>corner.obj</uri><scale>1 1 2</scale></mesh>")));
}

TEST_F(SdfShapeTest, LeavesOutShapesItDoesNotKnowAndSaysSo) {
  const Scene scene = load(R"(<sdf version="1.9"><model name="m"><link name="l">
<visual name="a"><geometry><polyline><point>0 0</point><point>1 0</point><point>1 1</point><height>1</height></polyline>
</geometry></visual>
<visual name="b"><geometry><image><uri>a.png</uri></image></geometry></visual>
<visual name="c"><geometry><empty/></geometry></visual>
<visual name="d"/>
<visual name="e"><geometry><box><size>1 2 3</size></box></geometry></visual></link></model></sdf>)");
  EXPECT_EQ(scene.instances.size(), 1);
  EXPECT_THAT(said, testing::ElementsAre("scene.sdf:2:1: visual 'm::l::a' is skipped: insonify has no shape <polyline>",
                                         "scene.sdf:4:1: visual 'm::l::b' is skipped: insonify has no shape <image>",
                                         "scene.sdf:5:1: visual 'm::l::c' is skipped: it has no shape",
                                         "scene.sdf:6:1: visual 'm::l::d' is skipped: it has no shape"));
}

TEST_F(SdfShapeTest, RefusesSizesOutOfLimits) {
  EXPECT_EQ(error_with("<box><size>1 -2 3</size></box>"),
            where + ": <size> = 1 -2 3 m must be greater than 0 m in each direction");
  EXPECT_EQ(error_with("<sphere><radius>0</radius></sphere>"), where + ": <radius> = 0 m must be greater than 0 m");
  EXPECT_EQ(error_with("<sphere><radius>nan</radius></sphere>"),
            "scene.sdf:4:40: <radius> = 'nan' must be a finite number");
  EXPECT_EQ(error_with("<cylinder><radius>1</radius><length>-1</length></cylinder>"),
            where + ": <length> = -1 m must be greater than 0 m");
  EXPECT_EQ(error_with("<capsule><radius>1</radius><length>inf</length></capsule>"),
            "scene.sdf:4:59: <length> = 'inf' must be a finite number");
  EXPECT_EQ(error_with("<ellipsoid><radii>0 1 1</radii></ellipsoid>"),
            where + ": <radii> = 0 1 1 m must be greater than 0 m in each direction");
  EXPECT_EQ(error_with("<cone><radius>-1</radius><length>1</length></cone>"),
            where + ": <radius> = -1 m must be greater than 0 m");
  EXPECT_EQ(error_with("<cone><radius>1</radius><length>1 m</length></cone>"),
            "scene.sdf:4:56: <length> = '1 m' must be a finite number");
  EXPECT_EQ(error_with("<cone><radius/></cone>"), "scene.sdf:4:38: <radius> = '' must be a finite number");
  EXPECT_EQ(error_with("<plane><normal>0 0 1</normal><size>0 3</size></plane>"),
            where + ": <size> = 0 m must be greater than 0 m");
  EXPECT_EQ(error_with("<plane><normal>0 0 0</normal><size>3 3</size></plane>"),
            where + ": <normal> = 0 0 0 is not a direction");
}

TEST_F(SdfShapeTest, RefusesMeshesAndHeightmapsThatCannotBe) {
  write("corner.obj", kCorner);
  write("bed.asc", "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 10\n-4 0\n1 1\n");
  EXPECT_EQ(error_with("<mesh><uri>/nowhere/ship.dae</uri></mesh>"), where + ": '/nowhere/ship.dae' does not exist");
  EXPECT_EQ(error_with("<mesh><uri>corner.obj</uri><scale>1 0 1</scale></mesh>"),
            where + ": <scale> = 1 0 1 must not be 0 in any direction");
  EXPECT_EQ(error_with("<heightmap><uri>bed.asc</uri><size>10 10 -1</size></heightmap>"),
            where + ": <size> = 10 10 -1 m must be greater than 0 m in each direction");
  EXPECT_EQ(error_with("<heightmap><uri>bed.asc</uri><sampling>0</sampling></heightmap>"),
            where + ": <sampling> = 0 must be from 1 to 16");
  EXPECT_EQ(error_with("<heightmap><uri>bed.asc</uri><sampling>17</sampling></heightmap>"),
            where + ": <sampling> = 17 must be from 1 to 16");
}

}  // namespace
}  // namespace insonify::sdf_shape_test
