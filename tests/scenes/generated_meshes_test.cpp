// generated_meshes_test.cpp -- the shipped scenes' meshes have the measures that their descriptions promise.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "insonify/engine.h"
#include "insonify/geometry.h"
#include "insonify/mesh.h"
#include "insonify/scene.h"
#include "scenes/obj_mesh.h"

namespace insonify {
namespace {

using testing_scenes::bytes_of;
using testing_scenes::generated_meshes;
using testing_scenes::read_obj;

const std::vector<std::string> kNames = {"ferry", "seabed", "boulders", "debris", "cone", "tank", "vehicle_box"};

// The files keep whole millimetres.
constexpr double kRounding = 1e-3;

// One generated mesh that rays can be sent at, in its own frame.
class Probe {
 public:
  explicit Probe(const std::string& name) {
    Mesh mesh = read_obj(generated_meshes() / (name + ".obj"));
    EXPECT_EQ(clean_mesh(mesh).dropped(), 0U);
    Instance instance{.name = name};
    instance.materials.assign(mesh.material_names.size(), 0);
    instance.mesh = std::make_shared<const Mesh>(std::move(mesh));
    scene_.materials.push_back({.name = "anything"});
    scene_.instances.push_back(std::move(instance));
    engine_->set_scene(scene_);
  }

  // Distance to the first surface; infinite where there is none.
  double distance(const Vec3& from, const Vec3& direction) {
    const std::vector<Ray> rays = {{.origin = from, .direction = direction.normalized()}};
    std::vector<Hit> hits(1);
    engine_->trace(rays, hits);
    return hits.front().distance;
  }

  // Height of the uppermost surface under a point.
  double height(double x, double y) { return 50 - distance({x, y, 50}, -Vec3::UnitZ()); }

 private:
  Scene scene_;
  std::unique_ptr<Engine> engine_ = make_engine("cpu", 1);
};

TEST(MakeMeshesTest, WritesTheSameBytesEveryTime) {
  const auto folder = std::filesystem::temp_directory_path() / ("make_meshes_test_" + std::to_string(::getpid()));
  const auto program = std::filesystem::path(INSONIFY_CLI).parent_path() / "make_meshes";
  ASSERT_EQ(std::system(fmt::format("'{}' '{}' > /dev/null", program.string(), folder.string()).c_str()), 0);
  for (const std::string& name : kNames) {
    for (const char* ending : {".obj", ".mtl"}) {
      const std::string bytes = bytes_of(folder / (name + ending));
      EXPECT_FALSE(bytes.empty()) << name << ending;
      EXPECT_TRUE(bytes == bytes_of(generated_meshes() / (name + ending))) << name << ending;
    }
  }
  std::filesystem::remove_all(folder);
}

TEST(GeneratedMeshesTest, NeedNoCleaning) {
  for (const std::string& name : kNames) {
    SCOPED_TRACE(name);
    Mesh mesh = read_obj(generated_meshes() / (name + ".obj"));
    EXPECT_EQ(clean_mesh(mesh).dropped(), 0U);
  }
}

TEST(GeneratedMeshesTest, FerrySceneHasFourHundredThousandTrianglesAtMost) {
  std::size_t sum = 0;
  for (const char* name : {"ferry", "seabed", "boulders", "debris"}) {
    sum += read_obj(generated_meshes() / (std::string(name) + ".obj")).triangles.size();
  }
  EXPECT_GT(sum, 200'000U);
  EXPECT_LT(sum, 400'000U);
}

TEST(GeneratedMeshesTest, MaterialsAreNamed) {
  EXPECT_EQ(read_obj(generated_meshes() / "ferry.obj").material_names,
            (std::vector<std::string>{"hull", "deck", "superstructure", "steel", "rubber", "wood"}));
  EXPECT_EQ(read_obj(generated_meshes() / "tank.obj").material_names, (std::vector<std::string>{"concrete", "steel"}));
}

TEST(TankMeshTest, InsideIsTwentyThreeByEighteenPointEightOneByEight) {
  // From a point off the middle, at heights that clear windows, pipes and ladders.
  Probe tank("tank");
  const Vec3 inside(1.5, -2.25, -6.0);
  EXPECT_NEAR(tank.distance(inside, Vec3::UnitX()), 23.0 / 2 - 1.5, kRounding);
  EXPECT_NEAR(tank.distance(inside, -Vec3::UnitX()), 23.0 / 2 + 1.5, kRounding);
  EXPECT_NEAR(tank.distance(inside, Vec3::UnitY()), 18.81 / 2 + 2.25, kRounding);
  EXPECT_NEAR(tank.distance(inside, -Vec3::UnitY()), 18.81 / 2 - 2.25, kRounding);
  EXPECT_NEAR(tank.distance(inside, -Vec3::UnitZ()), 8.0 - 6.0, kRounding);
  EXPECT_TRUE(std::isinf(tank.distance(inside, Vec3::UnitZ())));  // Open at the top.
}

TEST(TankMeshTest, WallsRiseAboveTheWater) {
  Probe tank("tank");
  EXPECT_TRUE(std::isfinite(tank.distance({0, 0, 0.4}, Vec3::UnitX())));
  EXPECT_TRUE(std::isinf(tank.distance({0, 0, 0.8}, Vec3::UnitX())));
}

TEST(TankMeshTest, WindowIsSetBackInItsWall) {
  // The niche in the +x wall: its pane lies 0.3 m behind the wall's face, the frame's bars not in the way of its
  // middle.
  Probe tank("tank");
  EXPECT_NEAR(tank.distance({0, 0, -3.9}, Vec3::UnitX()), 11.5 + 0.3, kRounding);
}

TEST(VehicleBoxTest, HidesAllBehindItFromASonarNearby) {
  // Seen from 2.85 m, a box 1.8 m high covers the Micron's 35 degrees of elevation: atan(0.9 / 2.85) = 17.5 degrees.
  Probe box("vehicle_box");
  for (const double elevation_deg : {-16.0, -9.0, 0.0, 9.0, 16.0}) {
    const double elevation = radians_from_degrees(elevation_deg);
    EXPECT_LT(box.distance({-3.4, 0, 0}, {std::cos(elevation), 0, std::sin(elevation)}), 3.0) << elevation_deg;
  }
}

TEST(FerryMeshTest, IsFiftyTwoMetresLongBetweenItsRamps) {
  // Rays along the ship that pass beside the ramps, which are 4.6 m wide, and meet transom and stem. The stem leans
  // forward by up to 1.7 m at the deck. Dents move plating across and up, never along.
  Probe ferry("ferry");
  EXPECT_NEAR(ferry.distance({-20, 3.5, 2.6}, Vec3::UnitX()), 20, kRounding);
  const double stem = 80 - ferry.distance({80, 2.6, 3.5}, -Vec3::UnitX());
  EXPECT_GT(stem, 52);
  EXPECT_LT(stem, 52 + 1.7);
}

TEST(FerryMeshTest, IsTwelveMetresBroadAmidships) {
  // Between her fenders. Dents move plating by up to 5 cm.
  Probe ferry("ferry");
  EXPECT_NEAR(20 - ferry.distance({26, 20, 2.5}, -Vec3::UnitY()), 6.0, 0.05);
  EXPECT_NEAR(20 - ferry.distance({26, -20, 2.5}, Vec3::UnitY()), 6.0, 0.05);
}

TEST(FerryMeshTest, TornHoleOpensTheStarboardBowAlone) {
  Probe ferry("ferry");
  const double port = 20 - ferry.distance({39.75, 20, 2.1}, -Vec3::UnitY());
  const double starboard = 20 - ferry.distance({39.75, -20, 2.1}, Vec3::UnitY());
  EXPECT_GT(port, 4.5);       // Sound plating.
  EXPECT_LT(starboard, 3.0);  // Through the hole, to whatever is inside.
}

TEST(FerryMeshTest, BulwarkHasFreeingPorts) {
  // Ports of 1.3 m every 3.6 m from x = 3.2 m: a ray through one passes over the deck, a ray beside it does not.
  Probe ferry("ferry");
  const auto reach = [&](double x) { return 20 - ferry.distance({x, 20, 4.0}, -Vec3::UnitY()); };
  EXPECT_LT(reach(42.9 + 0.65), 5.0);
  EXPECT_GT(reach(45.2), 5.0);
}

TEST(SeabedMeshTest, CoversItsGround) {
  Probe seabed("seabed");
  for (const double x : {-29.9, 30.0, 89.9}) {
    for (const double y : {-59.9, 3.0, 59.9}) {
      EXPECT_LT(std::abs(seabed.height(x, y)), 1.5) << x << ", " << y;
    }
  }
}

// Crest to crest and trough to crest, averaged along a line of heights. Swells of the bed are far longer than ripples,
// so that a crest is whatever is higher than all within 0.3 m.
struct Ripples {
  double count = 0, length = 0, rise = 0;

  void measure(const std::vector<double>& heights, double step) {
    const auto reach = static_cast<std::ptrdiff_t>(0.3 / step);
    auto last = heights.end();
    for (auto it = heights.begin() + reach; it < heights.end() - reach; ++it) {
      if (std::max_element(it - reach, it + reach + 1) != it) {
        continue;
      }
      if (last != heights.end()) {
        count += 1;
        length += step * static_cast<double>(it - last);
        rise += (*it + *last) / 2 - *std::min_element(last, it);
      }
      last = it;
    }
  }
};

TEST(SeabedMeshTest, RipplesAreAboutAMetreLongAndTenCentimetresHigh) {
  // Along the current (azimuth 0.21 rad), over sand that no wreck disturbs.
  Probe seabed("seabed");
  constexpr double kStep = 0.025;
  Ripples ripples;
  for (const double y : {-34.0, -28.0, 24.0, 30.0}) {
    std::vector<double> heights;
    for (int i = 0; i < 800; ++i) {
      heights.push_back(seabed.height(7 + kStep * i * std::cos(0.21), y + kStep * i * std::sin(0.21)));
    }
    ripples.measure(heights, kStep);
  }
  ASSERT_GT(ripples.count, 50);
  EXPECT_GT(ripples.length / ripples.count, 0.8);
  EXPECT_LT(ripples.length / ripples.count, 1.1);
  EXPECT_GT(ripples.rise / ripples.count, 0.08);
  EXPECT_LT(ripples.rise / ripples.count, 0.12);
}

}  // namespace
}  // namespace insonify
