// cooler_and_ssiv_meshes_test.cpp -- dimensions of the meshes of the cooler, its pipelines and the SSIV.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scenes/mesh_probe.h"
#include "scenes/obj_mesh.h"

namespace insonify::cooler_and_ssiv_meshes_test {
namespace {

using testing_scenes::generated_meshes;
using testing_scenes::kRounding;
using testing_scenes::Probe;
using testing_scenes::read_obj;

// A round member's facets lie inside its circle by up to this share of its radius: 1 - cos(pi / 12).
constexpr double kFacet = 0.035;

TEST(CoolerMeshTest, ColumnsStandNineByFourPointFourMetresApart) {
  Probe cooler("cooler");
  constexpr double kRadius = 0.1365;
  const double slack = kFacet * kRadius;
  for (const double side : {-1.0, 1.0}) {
    EXPECT_NEAR(20 - cooler.distance({-20 * side, 2.2, 1.25}, {side, 0, 0}), 4.5 + kRadius, slack);
    EXPECT_NEAR(20 - cooler.distance({4.5 * side, 20, 1.25}, {0, -1, 0}), 2.2 + kRadius, slack);
    EXPECT_NEAR(20 - cooler.distance({4.5 * side, -20, 1.25}, {0, 1, 0}), 2.2 + kRadius, slack);
  }
}

TEST(CoolerMeshTest, NinePassesLieTwelveInchesApart) {
  // Down through the fourth bank, beside racks and cover: 305 mm between tops, the lowest axis at 0.55 m, 114.3 mm
  // thick.
  Probe cooler("cooler");
  constexpr double kX = 0.7;
  constexpr double kY = 3 * 0.48 - 1.68;
  constexpr double kRadius = 0.05715;
  for (int pass = 0; pass < 9; ++pass) {
    const double axis = 0.55 + 0.305 * pass;
    EXPECT_NEAR(0.15 - cooler.distance({kX, kY, axis + 0.15}, -Vec3::UnitZ()), kRadius, 0.06 * kRadius + kRounding)
        << pass;
    EXPECT_NEAR(0.15 - cooler.distance({kX, kY, axis - 0.15}, Vec3::UnitZ()), kRadius, 0.06 * kRadius + kRounding)
        << pass;
  }
  EXPECT_LT(0.4 - cooler.distance({kX, kY, 0.4}, -Vec3::UnitZ()),
            0.15);  // Below it there is nothing down to the mudmat.
}

TEST(CoolerMeshTest, MudmatIsTwelvePointEightByFivePointNineMetres) {
  Probe cooler("cooler");
  EXPECT_NEAR(20 - cooler.distance({-20, 1.7, -0.015}, Vec3::UnitX()), 6.4, kRounding);
  EXPECT_NEAR(20 - cooler.distance({20, 1.7, -0.015}, -Vec3::UnitX()), 6.4, kRounding);
  EXPECT_NEAR(20 - cooler.distance({3, 20, -0.015}, -Vec3::UnitY()), 2.95, kRounding);
}

TEST(PipelinesMeshTest, GasLineIsThreeHundredAndTwentyMillimetresThick) {
  // Over x = 13..16 m on y = 0 only the gas line passes.
  Probe lines("pipelines");
  double top = -10;
  double bottom = 10;
  for (double x = 13; x < 16; x += 0.005) {
    if (std::isfinite(lines.height(x, 0))) {
      top = std::max(top, lines.height(x, 0));
      bottom = std::min(bottom, lines.distance({x, 0, -10}, Vec3::UnitZ()) - 10);
    }
  }
  EXPECT_NEAR(top - bottom, 0.32, kFacet * 0.32);
}

TEST(PipelinesMeshTest, LinesStayNearTheBed) {
  // Sunk in by no more than the thickness of their coatings, and nowhere higher than a spool's shoulder.
  const Mesh lines = read_obj(generated_meshes() / "pipelines.obj");
  Probe bed("cooler_bed");
  double highest = -10;
  double lowest = 10;
  for (const Vec3f& vertex : lines.vertices) {
    // Offset from the bed's grid lines: a ray exactly along an edge may pass between its triangles.
    const double above = vertex.z() - bed.height(vertex.x() + 0.0003, vertex.y() + 0.0004);
    highest = std::max(highest, above);
    lowest = std::min(lowest, above);
  }
  EXPECT_LT(highest, 2.6);  // Top of a spool over the cooler's inlet.
  EXPECT_GT(lowest, -0.35);
}

TEST(SsivMeshTest, LegsStandTwoPointSixByTwoPointTwoMetresApart) {
  Probe ssiv("ssiv");
  constexpr double kRadius = 0.08415;
  const double slack = kFacet * kRadius;
  for (const double side : {-1.0, 1.0}) {
    for (const double y : {-1.1, 1.1}) {
      EXPECT_NEAR(20 - ssiv.distance({-20 * side, y, 0.6}, {side, 0, 0}), 1.3 + kRadius, slack);
    }
    EXPECT_NEAR(20 - ssiv.distance({1.3 * side, -20, 0.6}, {0, 1, 0}), 1.1 + kRadius, slack);
  }
}

TEST(SsivMeshTest, PipeIsEightInchAndEndsInBlindFlanges) {
  Probe ssiv("ssiv");
  EXPECT_NEAR(ssiv.height(2.25, 0), 0.52 + 0.1095, kFacet * 0.1095);
  // 2.75 m to the joint's face, seal 12 mm, flange 64 mm (8 inches in ASME B16.5 class 900: 63.5 mm), crown 12 mm.
  EXPECT_NEAR(20 - ssiv.distance({20, 0, 0.52}, -Vec3::UnitX()), 2.75 + 0.012 + 0.064 + 0.012, kRounding);
  EXPECT_NEAR(20 - ssiv.distance({-20, 0, 0.52}, Vec3::UnitX()), 2.75 + 0.012 + 0.064 + 0.012, kRounding);
}

TEST(SsivMeshTest, HatchIsAGridOfBarsTwentyCentimetresApart) {
  // The leaf about x = -0.67 is 1.14 x 1.98 m, divided into 6 by 10. Rays above its bars are stopped; rays between them
  // pass, except at the sling, the handle and the beam's edge.
  Probe ssiv("ssiv");
  const auto x_at = [](double column) { return -0.67 + 1.14 * (column / 6 - 0.5); };
  const auto y_at = [](double row) { return 1.98 * (row / 10 - 0.5); };
  int open = 0;
  for (int column = 0; column < 6; ++column) {
    for (int row = 0; row < 10; ++row) {
      open += ssiv.height(x_at(column + 0.5), y_at(row + 0.5)) < 1.7 ? 1 : 0;
      if (column > 0 && row > 0) {
        EXPECT_GT(ssiv.height(x_at(column), y_at(row)), 1.75) << column << ", " << row;
      }
    }
  }
  EXPECT_GE(open, 50);
}

TEST(SsivBedTest, SwellRipplesAreAThirdOfAMetreLong) {
  // Along azimuth 0.32 rad, clear of the mock-up.
  Probe bed("ssiv_bed");
  constexpr double kStep = 0.02;
  double crests = 0;
  double length = 0;
  for (const double y : {-6.5, -5.0, 4.9, 6.2}) {
    std::vector<double> heights;
    for (int i = 0; i < 350; ++i) {
      heights.push_back(bed.height(5 + kStep * i * std::cos(0.32), y + kStep * i * std::sin(0.32)));
    }
    for (std::size_t i = 6; i + 6 < heights.size(); ++i) {
      crests += std::max_element(heights.begin() + i - 6, heights.begin() + i + 7) - heights.begin() ==
                static_cast<std::ptrdiff_t>(i);
    }
    length += kStep * static_cast<double>(heights.size());
  }
  EXPECT_NEAR(length / crests, 0.36, 0.08);
}

}  // namespace
}  // namespace insonify::cooler_and_ssiv_meshes_test
