// generated_meshes_test.cpp -- the shipped scenes' meshes have the measures that their descriptions promise.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include "insonify/engine.h"
#include "insonify/files.h"
#include "insonify/geometry.h"
#include "insonify/mesh.h"
#include "insonify/scene.h"
#include "scenes/coincident_faces.h"
#include "scenes/mesh_probe.h"
#include "scenes/obj_mesh.h"

namespace insonify {
namespace {

using testing_scenes::bytes_of;
using testing_scenes::coincident_faces;
using testing_scenes::generated_meshes;
using testing_scenes::Probe;
using testing_scenes::read_obj;

const std::vector<std::string> kNames = {
    "ferry",       "seabed",     "boulders",         "debris",     "cone",       "tank",
    "vehicle_box", "car",        "car_bed",          "car_debris", "car_stones", "christmas_tree",
    "tree_bed",    "tree_lines", "cooler",           "cooler_bed", "pipelines",  "pipeline_supports",
    "ssiv",        "ssiv_bed",   "ssiv_surroundings"};

// Those made of closed solids alone.
const std::vector<std::string> kSolids = {"ferry",      "debris",
                                          "tank",       "vehicle_box",
                                          "cone",       "cooler",
                                          "pipelines",  "pipeline_supports",
                                          "ssiv",       "ssiv_surroundings",
                                          "car",        "car_debris",
                                          "car_stones", "christmas_tree",
                                          "tree_lines"};

// The files keep whole millimetres.
constexpr double kRounding = 1e-3;

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
  EXPECT_TRUE(bytes_of(folder / "seabed_ripples.png") == bytes_of(generated_meshes() / "seabed_ripples.png"));
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

// Parts of a mesh that hang together by corners: for each triangle the number of its part.
std::vector<std::uint32_t> parts_of(const Mesh& mesh) {
  std::vector<std::uint32_t> parent(mesh.vertices.size());
  std::iota(parent.begin(), parent.end(), 0U);
  const auto root = [&](std::uint32_t vertex) {
    while (parent[vertex] != vertex) {
      parent[vertex] = parent[parent[vertex]];
      vertex = parent[vertex];
    }
    return vertex;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    parent[root(b)] = root(a);
    parent[root(c)] = root(a);
  }
  std::vector<std::uint32_t> parts;
  for (const auto& triangle : mesh.triangles) {
    parts.push_back(root(triangle[0]));
  }
  return parts;
}

TEST(GeneratedMeshesTest, SolidsAreClosed) {
  // Round a closed surface every edge is walked as often one way as the other.
  for (const std::string& name : kSolids) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
    for (const auto& [a, b, c] : read_obj(generated_meshes() / (name + ".obj")).triangles) {
      for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
        balance[std::minmax(from, to)] += from < to ? 1 : -1;
      }
    }
    EXPECT_TRUE(std::ranges::all_of(balance, [](const auto& edge) { return edge.second == 0; })) << name;
  }
}

TEST(GeneratedMeshesTest, SolidsWindOutwards) {
  // The tetrahedra between a fixed point and the triangles of a part add up to its volume, which is positive when its
  // faces wind anticlockwise as seen from outside.
  for (const std::string& name : kSolids) {
    const Mesh mesh = read_obj(generated_meshes() / (name + ".obj"));
    const std::vector<std::uint32_t> parts = parts_of(mesh);
    std::map<std::uint32_t, double> volumes;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      const Vec3 origin = mesh.vertices[parts[i]].cast<double>();
      const auto corner = [&](int k) -> Vec3 { return mesh.vertices[mesh.triangles[i][k]].cast<double>() - origin; };
      volumes[parts[i]] += corner(0).dot(corner(1).cross(corner(2))) / 6;
    }
    EXPECT_GE(volumes.size(), 1U) << name;
    for (const auto& [part, volume] : volumes) {
      EXPECT_GT(volume, 0) << name << " at " << mesh.vertices[part].transpose();
    }
  }
}

TEST(GeneratedMeshesTest, NoTwoTrianglesShareAllCorners) {
  for (const std::string& name : kSolids) {
    std::set<std::array<std::uint32_t, 3>> seen;
    for (auto triangle : read_obj(generated_meshes() / (name + ".obj")).triangles) {
      std::ranges::sort(triangle);
      EXPECT_TRUE(seen.insert(triangle).second) << name;
    }
  }
}

TEST(GeneratedMeshesTest, NoTwoFacesLieInOnePlace) {
  // Where two did, a ray would meet either by chance. Smaller than a hand's palm they are let pass: rounded to whole
  // millimetres, faces that meet at a slant coincide along their meeting line.
  constexpr double kPalm = 0.006;  // [m^2]
  for (const std::string& name : kSolids) {
    for (const auto& [area, place] : coincident_faces(read_obj(generated_meshes() / (name + ".obj")), kPalm)) {
      ADD_FAILURE() << name << ": " << area << " m^2 at " << place.transpose();
    }
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
  EXPECT_EQ(read_obj(generated_meshes() / "cooler.obj").material_names,
            (std::vector<std::string>{"steel", "yellow_steel", "aluminium", "stainless_steel"}));
  EXPECT_EQ(read_obj(generated_meshes() / "pipelines.obj").material_names,
            (std::vector<std::string>{"pvc", "aluminium", "steel", "concrete", "rubber"}));
  EXPECT_EQ(read_obj(generated_meshes() / "pipeline_supports.obj").material_names,
            (std::vector<std::string>{"concrete", "steel", "nylon"}));
  EXPECT_EQ(read_obj(generated_meshes() / "ssiv.obj").material_names,
            (std::vector<std::string>{"steel", "yellow_steel", "aluminium", "stainless_steel"}));
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
  // The normal map that covers the bed, summed up along the current (azimuth 0.21 rad), over sand that no wreck
  // disturbs.
  const Mesh seabed = load_mesh(generated_meshes() / "seabed.obj");
  ASSERT_EQ(seabed.reliefs.size(), 1U);
  ASSERT_NE(seabed.reliefs[0], nullptr);
  const Eigen::Vector2d current(std::cos(0.21), std::sin(0.21));
  constexpr double kStep = 0.025;
  Ripples ripples;
  for (const double y : {-34.0, -28.0, 24.0, 30.0}) {
    std::vector<double> heights = {0};
    for (int i = 0; i < 800; ++i) {
      const Eigen::Vector2d at = Eigen::Vector2d(7, y) + (i + 0.5) * kStep * current;
      const Eigen::Vector2f texture = ((at - Eigen::Vector2d(-30, -60)) / 120).cast<float>();  // As the bed lies.
      const Eigen::Vector2f slope = seabed.reliefs[0]->slopes.at(texture.x(), texture.y());
      heights.push_back(heights.back() + kStep * slope.cast<double>().dot(current));
    }
    ripples.measure(heights, kStep);
  }
  ASSERT_GT(ripples.count, 50);
  EXPECT_GT(ripples.length / ripples.count, 0.8);
  EXPECT_LT(ripples.length / ripples.count, 1.1);
  EXPECT_GT(ripples.rise / ripples.count, 0.075);
  EXPECT_LT(ripples.rise / ripples.count, 0.12);
}

// Every vertex of the bed has the texture coordinates of its place.
TEST(SeabedMeshTest, ItsNormalMapLiesWhereItIs) {
  const Mesh seabed = load_mesh(generated_meshes() / "seabed.obj");
  ASSERT_EQ(seabed.texture_coordinates.size(), seabed.triangles.size());
  for (std::size_t t = 0; t < seabed.triangles.size(); t += 1000) {
    for (int k = 0; k < 3; ++k) {
      const Vec3f& vertex = seabed.vertices[seabed.triangles[t][k]];
      EXPECT_NEAR(seabed.texture_coordinates[t][k].x(), (vertex.x() + 30) / 120, 1e-5);
      EXPECT_NEAR(seabed.texture_coordinates[t][k].y(), (vertex.y() + 60) / 120, 1e-5);
    }
  }
}

}  // namespace
}  // namespace insonify
