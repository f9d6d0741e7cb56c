// box_cut_test.cpp -- which rays may meet a scene: all that hit something, and few others.

#include "echo/rays/box_cut.h"

#include <gtest/gtest.h>

#include <array>

namespace insonify::box_cut_test {
namespace {

constexpr int kBoxes = 12;
constexpr double kSpacing = 3;  // Between the centres of neighbouring boxes, which are 1 m wide.

// Boxes in a row along x, each an instance of its own.
Scene row_of_boxes(bool moving) {
  Scene scene;
  for (int i = 0; i < kBoxes; ++i) {
    Instance& instance = scene.instances.emplace_back();
    instance.name = "box" + std::to_string(i);
    instance.mesh = std::make_shared<const Mesh>(make_box({1, 1, 1}));
    instance.world_from_mesh.position = {kSpacing * i, 0, 0};
    instance.moving = moving;
  }
  assign_materials(scene, {});
  return scene;
}

// Sixteen rays along y that cross the row at the given x, from 5 m before it to `far` metres on.
unsigned may_meet(const BoxCut& cut, const std::array<float, kRayLanes>& x, float far) {
  std::array<float, kRayLanes> zero = {}, one, before, reach;
  one.fill(1);
  before.fill(-5);
  reach.fill(far);
  return cut.may_meet(
      {x.data(), before.data(), zero.data(), zero.data(), one.data(), zero.data(), zero.data(), reach.data()});
}

TEST(BoxCutTest, RaysThroughBoxesMayMeetThemAndRaysBetweenThemMayNot) {
  for (const bool moving : {false, true}) {
    BoxCut cut;
    cut.set(row_of_boxes(moving), Vec3::Zero());
    std::array<float, kRayLanes> x = {};
    unsigned expected = 0;
    for (int lane = 0; lane < kRayLanes; ++lane) {  // Odd lanes between two boxes; the last ones beyond the row.
      x[lane] = static_cast<float>(kSpacing * 0.5 * (lane + 12));
      expected |= lane % 2 == 0 && lane + 12 <= 2 * (kBoxes - 1) ? 1U << lane : 0U;
    }
    EXPECT_EQ(may_meet(cut, x, 10), expected) << moving;
    EXPECT_EQ(may_meet(cut, x, 4), 0U) << "Boxes begin 4.5 m from the rays' origins.";
  }
}

TEST(BoxCutTest, BoxesOfMovedInstancesMoveWithThem) {
  BoxCut cut;
  cut.set(row_of_boxes(true), Vec3::Zero());
  cut.move(3, {.position = {-20, 0, 0}});
  std::array<float, kRayLanes> x = {};
  x.fill(-20);
  EXPECT_EQ(may_meet(cut, x, 10), 0xffffU);
  x.fill(static_cast<float>(3 * kSpacing));
  EXPECT_EQ(may_meet(cut, x, 10), 0U);
}

TEST(BoxCutTest, NothingMayBeMetInAnEmptyScene) {
  BoxCut cut;
  cut.set(Scene(), Vec3::Zero());
  EXPECT_EQ(may_meet(cut, {}, 10), 0U);
}

}  // namespace
}  // namespace insonify::box_cut_test
