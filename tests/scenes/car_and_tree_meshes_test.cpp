// car_and_tree_meshes_test.cpp -- dimensions of the meshes of the wrecked car and the Christmas tree.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scenes/mesh_probe.h"
#include "scenes/obj_mesh.h"

namespace insonify::car_and_tree_meshes_test {
namespace {

using testing_scenes::kRounding;
using testing_scenes::Probe;

// Frame of the car: x forward from midway between the axles, y to its left, z up from the road. Frame of the tree: x to
// its ROV panel, y to its production wing, z up from the mud line.

TEST(CarMeshTest, RearWheelsStandOnTheRoadAtTheirPlaces) {
  // Axle 1.325 m behind the middle, wheels of 0.31 m radius; a ray along the axle from the left meets the cap, whose
  // dome stands 0.066 m out from the wheel's middle at 0.70 m.
  Probe car("car");
  EXPECT_NEAR(5 - car.distance({-1.325, 5, 0.31}, -Vec3::UnitY()), 0.70 + 0.066, kRounding);
  EXPECT_NEAR(car.distance({-1.325, 0.70, -2}, Vec3::UnitZ()), 2.0, 0.01);  // Its tread has grooves 9 mm deep.
}

TEST(CarMeshTest, LeftFrontWheelIsMissing) {
  // Below the brake disc, of 0.13 m radius about the axle at 0.31 m, nothing is in the way to the right wheel.
  Probe car("car");
  const double left_face = 5 - car.distance({1.325, 5, 0.12}, -Vec3::UnitY());
  EXPECT_LT(left_face, -0.5);
  EXPECT_GT(left_face, -0.7);
  EXPECT_GT(5 - car.distance({-1.325, 5, 0.12}, -Vec3::UnitY()), 0.7);
}

TEST(CarMeshTest, OneLooksInWhereTheLeftDoorWas) {
  // Over the sill to the seats; behind the rear wheel the side has no opening, 0.81 m from the middle of the car.
  Probe car("car");
  EXPECT_LT(5 - car.distance({0.15, 5, 0.5}, -Vec3::UnitY()), 0.72);
  EXPECT_NEAR(5 - car.distance({-2.0, 5, 0.55}, -Vec3::UnitY()), 0.81, 0.04);
}

TEST(CarMeshTest, RoofIsCrushedOnTheRightAlone) {
  // Over the seats, 0.5 m to both sides: the undamaged height is within a few centimetres of 1.4 m.
  Probe car("car");
  EXPECT_NEAR(car.height(-0.35, 0.45), 1.38, 0.05);
  EXPECT_LT(car.height(-0.35, -0.45), 1.15);
}

TEST(ChristmasTreeMeshTest, GuidePostsStandOnSixFeet) {
  // API 17D: four posts on a radius of 1.829 m, here 1.293 m along both axes. Under the roof, above their sleeves, a
  // ray from outside meets a tube of 8 5/8 in, 0.1095 m in radius. It passes a millimetre beside the middle: a ray
  // straight at an edge may pass between its triangles.
  Probe tree("christmas_tree");
  for (const double side : {-1.0, 1.0}) {
    EXPECT_NEAR(tree.distance({1.293 + 0.2, side * 1.293 + 0.001, 2.7}, -Vec3::UnitX()), 0.2 - 0.1095, 0.002);
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
}  // namespace insonify::car_and_tree_meshes_test
