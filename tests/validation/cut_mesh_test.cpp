// cut_mesh_test.cpp -- the same steel box, plate and sheet have the same echo however their meshes are cut.

#include <random>

#include "validation/calibrated_scene.h"

namespace insonify::validation::cut_mesh_test {
namespace {

constexpr double kRange = 10;

Scenario scenario() {
  SonarConfig sonar;
  sonar.frequency = 720e3;
  sonar.beam_count = 32;
  sonar.azimuth_aperture = 32 * kDegree;
  sonar.elevation_aperture = 20 * kDegree;
  sonar.min_range = kRange - 1;
  sonar.max_range = kRange + 1;
  sonar.bin_count = 100;
  sonar.sampling = {4, 400};
  return calibrated(sonar, kRays);
}

double level(Mesh mesh, double turn) {
  (void)clean_mesh(mesh);
  return total_db(
      ping_of(scenario(), scene_of(std::move(mesh), glinting(0.8, 0.05),
                                   {.position = {kRange, 0, 0}, .orientation = orientation_from_rpy(0, 0, turn)})));
}

using Quad = std::array<Vec3, 4>;

std::vector<Quad> box_of(const Vec3& size) {
  std::vector<Quad> faces;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-0.5, 0.5}) {
      Quad& face = faces.emplace_back();
      for (int corner = 0; corner < 4; ++corner) {
        const bool along = corner == 1 || corner == 2, across = corner >= 2;
        face[corner][axis] = side;
        face[corner][(axis + 1) % 3] = (side > 0 ? along : across) ? 0.5 : -0.5;
        face[corner][(axis + 2) % 3] = (side > 0 ? across : along) ? 0.5 : -0.5;
        face[corner] = face[corner].cwiseProduct(size);
      }
    }
  }
  return faces;
}

// Triangles of their own corners: face i in cuts(i) x cuts(i) squares, each given `times`, with both windings in turn,
// and corners moved by up to `moved`.
struct Cut {
  const char* name;
  int (*cuts)(int face) = [](int) { return 1; };
  int times = 1;
  double moved = 0;
};

Mesh cut(const std::vector<Quad>& faces, const Cut& how) {
  Mesh mesh;
  std::mt19937 random(1);
  const auto add = [&](const Vec3& place) {
    Vec3 at = place;
    for (double& coordinate : at) {
      coordinate += how.moved * (2.0 * random() / std::mt19937::max() - 1);
    }
    mesh.vertices.push_back(at.cast<float>());
    return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  };
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const int cuts = how.cuts(static_cast<int>(f));
    const auto at = [&](int i, int j) {
      const double u = static_cast<double>(i) / cuts, v = static_cast<double>(j) / cuts;
      const Quad& face = faces[f];
      return Vec3((1 - u) * (1 - v) * face[0] + u * (1 - v) * face[1] + u * v * face[2] + (1 - u) * v * face[3]);
    };
    for (int square = 0; square < cuts * cuts * how.times; ++square) {
      const int i = square / how.times % cuts, j = square / how.times / cuts;
      const std::array corners = {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
      const int turned = square % how.times % 2 == 1 ? 2 : 0;  // Exchanges two of the corners.
      mesh.triangles.push_back({add(corners[turned]), add(corners[1]), add(corners[2 - turned])});
      mesh.triangles.push_back({add(corners[turned]), add(corners[2 - turned]), add(corners[3])});
    }
  }
  return mesh;
}

constexpr Cut kWhole{.name = "whole"};
const Cut kCuts[] = {{.name = "in 16", .cuts = [](int) { return 4; }},
                     {.name = "with T-junctions", .cuts = [](int face) { return 1 + face % 3; }},
                     {.name = "three times", .times = 3},
                     {.name = "moved corners", .moved = 1e-6}};

TEST(CutMeshTest, ABoxHasOneEcho) {
  for (const double turn : {0.0, 0.2, 0.5}) {
    const double whole = level(cut(box_of({1, 1, 1}), kWhole), turn);
    for (const Cut& how : kCuts) {
      EXPECT_NEAR(level(cut(box_of({1, 1, 1}), how), turn), whole, 0.1) << how.name << ", " << turn;
    }
  }
}

TEST(CutMeshTest, APlateOfBothSidesIsOne) {
  const std::vector<Quad> box = box_of({0, 1, 1});
  const std::vector<Quad> front = {box[0]}, both = {box[0], box[1]};
  for (const double degrees : {0.0, 3.0, 10.0}) {
    EXPECT_NEAR(level(cut(both, kWhole), degrees * kDegree), level(cut(front, kWhole), degrees * kDegree), 0.1)
        << degrees;
  }
}

// Below 2 mm the far side is silent by its distance, above by what is before it, and between both at once.
TEST(CutMeshTest, ASheetGlintsOnceWhateverItsThickness) {
  const double plate = level(cut({box_of({0, 1, 1})[0]}, kWhole), 0);
  for (const double millimetres : {0.5, 1.0, 1.4, 1.5, 1.6, 1.9, 1.999, 2.0, 2.001, 2.1, 3.0, 5.0}) {
    EXPECT_NEAR(level(cut(box_of({millimetres / 1000, 1, 1}), kWhole), 0), plate, 0.1) << millimetres;
  }
}

}  // namespace
}  // namespace insonify::validation::cut_mesh_test
