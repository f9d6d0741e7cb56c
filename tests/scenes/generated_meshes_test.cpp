// generated_meshes_test.cpp -- the shipped scenes' meshes have the measures that their descriptions promise.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
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

const std::vector<std::string> kNames = {"ferry",      "seabed",         "boulders", "debris",    "cone",
                                         "tank",       "vehicle_box",    "car",      "car_bed",   "car_debris",
                                         "car_stones", "christmas_tree", "tree_bed", "tree_lines"};

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

TEST(GeneratedMeshesTest, CarAndTreeAreMadeOfTenToSixtyThousandTriangles) {
  for (const char* name : {"car", "christmas_tree"}) {
    const std::size_t count = read_obj(generated_meshes() / (std::string(name) + ".obj")).triangles.size();
    EXPECT_GT(count, 10'000U) << name;
    EXPECT_LT(count, 60'000U) << name;
  }
}

// The number of a shape's edges that are not run through as often one way as the other: none where every part is
// closed and its triangles agree which side is outside.
std::size_t open_edges(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
  for (const auto& triangle : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t from = triangle[i], to = triangle[(i + 1) % 3];
      balance[std::minmax(from, to)] += from < to ? 1 : -1;
    }
  }
  return static_cast<std::size_t>(std::ranges::count_if(balance, [](const auto& edge) { return edge.second != 0; }));
}

// Volumes of a shape's parts, where those that share a vertex are one: positive where triangles wind outwards.
std::vector<double> volumes(const Mesh& mesh) {
  std::vector<std::uint32_t> part(mesh.vertices.size());
  std::iota(part.begin(), part.end(), 0U);
  const auto root = [&](std::uint32_t v) {
    while (part[v] != v) {
      v = part[v] = part[part[v]];
    }
    return v;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    part[root(a)] = root(b);
    part[root(b)] = root(c);
  }
  std::map<std::uint32_t, double> sums;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 p = mesh.vertices[a].cast<double>(), q = mesh.vertices[b].cast<double>();
    sums[root(a)] += p.cross(q).dot(mesh.vertices[c].cast<double>()) / 6;
  }
  std::vector<double> volumes;
  std::ranges::transform(sums, std::back_inserter(volumes), [](const auto& sum) { return sum.second; });
  return volumes;
}

TEST(GeneratedMeshesTest, PartsOfCarAndTreeAreClosedAndFaceOutwards) {
  for (const char* name : {"car", "car_debris", "car_stones", "christmas_tree", "tree_lines"}) {
    SCOPED_TRACE(name);
    const Mesh mesh = read_obj(generated_meshes() / (std::string(name) + ".obj"));
    EXPECT_EQ(open_edges(mesh), 0U);
    EXPECT_GT(std::ranges::min(volumes(mesh)), 0);
  }
}

TEST(GeneratedMeshesTest, MaterialsAreNamed) {
  EXPECT_EQ(read_obj(generated_meshes() / "ferry.obj").material_names,
            (std::vector<std::string>{"hull", "deck", "superstructure", "steel", "rubber", "wood"}));
  EXPECT_EQ(read_obj(generated_meshes() / "tank.obj").material_names, (std::vector<std::string>{"concrete", "steel"}));
  EXPECT_EQ(read_obj(generated_meshes() / "car.obj").material_names,
            (std::vector<std::string>{"bodywork", "glass", "aluminium", "acrylic", "steel", "upholstery", "abs",
                                      "rubber", "cast_iron", "copper", "brass", "lead", "hdpe"}));
  EXPECT_EQ(read_obj(generated_meshes() / "christmas_tree.obj").material_names,
            (std::vector<std::string>{"steel", "stainless_steel", "hdpe", "grp", "aluminium"}));
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

// The car's own frame: x forward from midway between the axles, y to its left, z up from the road.

TEST(CarMeshTest, RearWheelsStandOnTheRoadAtTheirPlaces) {
  // Axle 1.325 m behind the middle, wheels of 0.31 m radius; a ray along the axle from the left meets the cap, whose
  // dome stands 0.066 m out from the wheel's middle at 0.70 m.
  Probe car("car");
  EXPECT_NEAR(5 - car.distance({-1.325, 5, 0.31}, -Vec3::UnitY()), 0.70 + 0.066, kRounding);
  EXPECT_NEAR(car.distance({-1.325, 0.70, -2}, Vec3::UnitZ()), 2.0, 0.01);  // Its tread has grooves 9 mm deep.
}

TEST(CarMeshTest, LeftFrontWheelIsMissing) {
  // Below the brake's disc, of 0.13 m radius about the axle at 0.31 m, the way is free to the right wheel.
  Probe car("car");
  const double left_face = 5 - car.distance({1.325, 5, 0.12}, -Vec3::UnitY());
  EXPECT_LT(left_face, -0.5);
  EXPECT_GT(left_face, -0.7);
  EXPECT_GT(5 - car.distance({-1.325, 5, 0.12}, -Vec3::UnitY()), 0.7);
}

TEST(CarMeshTest, OneLooksInWhereTheLeftDoorWas) {
  // Over the sill to the seats; behind the rear wheel the side is whole, 0.81 m from the middle of the car.
  Probe car("car");
  EXPECT_LT(5 - car.distance({0.15, 5, 0.5}, -Vec3::UnitY()), 0.72);
  EXPECT_NEAR(5 - car.distance({-2.0, 5, 0.55}, -Vec3::UnitY()), 0.81, 0.04);
}

TEST(CarMeshTest, RoofIsCrushedOnTheRightAlone) {
  // Over the seats, 0.5 m to both sides: sound it stands within a few centimetres of 1.4 m.
  Probe car("car");
  EXPECT_NEAR(car.height(-0.35, 0.45), 1.38, 0.05);
  EXPECT_LT(car.height(-0.35, -0.45), 1.15);
}

// The tree's own frame: x to its ROV panel, y to its production wing, z up from the mud line.

TEST(ChristmasTreeMeshTest, GuidePostsStandOnSixFeet) {
  // API 17D: four posts on a radius of 1.829 m, here 1.293 m along both axes. Under the roof, above their sleeves, a
  // ray from outside meets a tube of 8 5/8 in, 0.1095 m in radius.
  Probe tree("christmas_tree");
  for (const double side : {-1.0, 1.0}) {
    EXPECT_NEAR(tree.distance({1.293 + 0.2, side * 1.293, 2.7}, -Vec3::UnitX()), 0.2 - 0.1095, 0.002);
  }
}

TEST(ChristmasTreeMeshTest, RoofAndCapHaveTheirHeights) {
  // Roof: rails' middle at 4.25 m, cover from 4.31 to 4.345 m. Cap: 4.80 m.
  Probe tree("christmas_tree");
  EXPECT_NEAR(tree.height(1.2, 0.25), 4.345, kRounding);
  EXPECT_NEAR(tree.height(0, 0), 4.80, kRounding);
}

TEST(ChristmasTreeMeshTest, PanelStandsBeforeTheValves) {
  // Its face at 1.5 m between the buckets, whose rims stand 0.06 m further out, their T bars 0.09 m inside these.
  Probe tree("christmas_tree");
  EXPECT_NEAR(5 - tree.distance({5, 0.45, 3.3}, -Vec3::UnitX()), 1.50, kRounding);
  EXPECT_NEAR(5 - tree.distance({5, 0.21, 3.3 + 0.142}, -Vec3::UnitX()), 1.56, 0.01);
  EXPECT_NEAR(5 - tree.distance({5, 0.21, 3.3}, -Vec3::UnitX()), 1.56 - 0.09 + 0.017, 0.005);
}

TEST(TreeBedMeshTest, IsNearlyLevelWithAHeapRoundTheWell) {
  Probe bed("tree_bed");
  EXPECT_NEAR(bed.height(0, 0), 0, 0.2);
  EXPECT_NEAR(bed.height(17, 0), 0, 0.2);
  EXPECT_GT(bed.height(6.2, 0.4), 0.08);
}

}  // namespace
}  // namespace insonify
