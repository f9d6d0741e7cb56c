// generated_meshes_test.cpp -- all generated meshes are clean, closed where they are solid, and free of coincident
// faces.

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

#include "echo/engine.h"
#include "insonify/files.h"
#include "insonify/geometry.h"
#include "insonify/mesh.h"
#include "insonify/scene.h"
#include "scenes/coincident_faces.h"
#include "scenes/mesh_probe.h"
#include "scenes/obj_mesh.h"

namespace insonify::generated_meshes_test {
namespace {

using testing_scenes::bytes_of;
using testing_scenes::coincident_faces;
using testing_scenes::generated_meshes;
using testing_scenes::read_obj;

const std::vector<std::string> kNames = {
    "ferry",       "seabed",     "boulders",         "debris",     "cone",       "tank",
    "vehicle_box", "car",        "car_bed",          "car_debris", "car_stones", "christmas_tree",
    "tree_bed",    "tree_lines", "cooler",           "cooler_bed", "pipelines",  "pipeline_supports",
    "ssiv",        "ssiv_bed",   "ssiv_surroundings"};

// Meshes made of closed solids only.
const std::vector<std::string> kSolids = {"ferry",      "debris",
                                          "tank",       "vehicle_box",
                                          "cone",       "cooler",
                                          "pipelines",  "pipeline_supports",
                                          "ssiv",       "ssiv_surroundings",
                                          "car",        "car_debris",
                                          "car_stones", "christmas_tree",
                                          "tree_lines"};

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

// Connected components of a mesh, by shared corners: the component of each triangle.
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
  // On a closed surface every edge is traversed equally often in both directions.
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
  // Where faces coincide, a ray would hit either by chance. Areas below kPalm are accepted: rounded to whole
  // millimetres, faces that meet at an angle coincide along their line of intersection.
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

}  // namespace
}  // namespace insonify::generated_meshes_test
