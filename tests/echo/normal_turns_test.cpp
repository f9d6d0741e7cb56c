// normal_turns_test.cpp -- turns of normals on shapes whose curvature is known, and the lobes that they widen.

#include "echo/model/normal_turns.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "echo/model/precise_echoes.h"
#include "insonify/acoustics/backscatter.h"

namespace insonify::normal_turns_test {
namespace {

// The hits of four columns on a surface given by its range and normal in each direction of the sonar frame.
struct Met {
  double range;
  Vec3 normal;
  SurfaceLabel surface = 0;
};
class FourColumns {
 public:
  FourColumns(const FlatPlan& plan, int first, const std::function<Met(const Vec3&)>& meet)
      : plan_(plan), first_(first), strip_(4, plan.lattice.rows) {
    for (int i = 0; i < 4; ++i) {
      hits_[i] = strip_.column(i);
      hits_[i].rows = plan.lattice.rows;
      aim_column(plan.lattice, first + i, column_axes(plan.lattice, first + i, Eigen::Matrix3f::Identity()), hits_[i]);
      for (int row = 0; row < plan.lattice.rows; ++row) {
        const Met met = meet(direction(i, row));
        hits_[i].surface[row] = met.surface;
        hits_[i].range[row] = static_cast<float>(met.range);
        hits_[i].normal_x[row] = static_cast<float>(met.normal.x());
        hits_[i].normal_y[row] = static_cast<float>(met.normal.y());
        hits_[i].normal_z[row] = static_cast<float>(met.normal.z());
      }
    }
    NormalTurns turns;
    turns.prepare(plan.lattice.rows);
    turns.find(plan, first, hits_);
  }
  [[nodiscard]] Vec3 direction(int i, int row) const {
    return {hits_[i].direction_x[row], hits_[i].direction_y[row], hits_[i].direction_z[row]};
  }
  [[nodiscard]] const HitColumn& hits(int i) const { return hits_[i]; }
  [[nodiscard]] Vec3 up(int i, int row) const {
    return {hits_[i].turn_up_x[row], hits_[i].turn_up_y[row], hits_[i].turn_up_z[row]};
  }
  [[nodiscard]] Vec3 side(int i, int row) const {
    return {hits_[i].turn_side_x[row], hits_[i].turn_side_y[row], hits_[i].turn_side_z[row]};
  }

 private:
  const FlatPlan& plan_;
  int first_;
  HitStrip strip_;
  HitColumn hits_[4] = {};
};

std::shared_ptr<const FlatPlan> plan_of(BeamShape shape = BeamShape::kWedge) {
  FlatPlanSettings settings{.model = EchoModel::kCalibrated, .beam_shape = shape};
  settings.sonar.beam_count = 8;
  settings.sonar.azimuth_aperture = 4 * std::numbers::pi / 180;    // 0.125 degrees a column.
  settings.sonar.elevation_aperture = 5 * std::numbers::pi / 180;  // 0.1 degrees a row.
  settings.sonar.sampling = {.columns_per_beam = 4, .rows = 50};
  return make_flat_plan(settings);
}

// A ball of radius a = 3 m at 20 m. Near its front, 17 m away, the normal turns by 17 / 3 of the change of direction.
// 0.125 degrees, 2.1817e-3, are 0.012363 from column to column, and 0.1 degrees 0.009890 from row to row.
TEST(NormalTurnsTest, AreTheCurvatureOfABall) {
  for (const BeamShape shape : {BeamShape::kWedge, BeamShape::kCone}) {
    const auto plan = plan_of(shape);
    const Vec3 centre(20, 0, 0);
    const FourColumns columns(*plan, 12, [&](const Vec3& d) {
      const double along = d.dot(centre), range = along - std::sqrt(along * along - 400 + 9);
      return Met{range, (range * d - centre) / 3};
    });
    for (int i = 0; i < 4; ++i) {
      EXPECT_TRUE(columns.hits(i).curved);
      for (const int row : {20, 25, 30}) {
        EXPECT_NEAR(columns.up(i, row).z(), 0.009890, 2e-4);
        EXPECT_NEAR(columns.up(i, row).y(), 0, 1e-4);
        // Columns run from port to starboard, and rows of neighbouring columns are staggered.
        EXPECT_NEAR(columns.side(i, row).y(), -0.012363, 3e-4) << i << ", " << row;
        EXPECT_NEAR(columns.side(i, row).z(), 0, 3e-4) << i << ", " << row;
      }
    }
  }
}

// Only column 13, at 0.3125 degrees, meets the ball: across it turns as along, 0.009890 x 0.125 / 0.1. Lobes are
// widened by squares of the turns, so that the sign does not count.
TEST(NormalTurnsTest, OfAColumnAloneAreThoseOfABall) {
  for (const BeamShape shape : {BeamShape::kWedge, BeamShape::kCone}) {
    const auto plan = plan_of(shape);
    const Vec3 centre(20, 0, 0);
    const FourColumns columns(*plan, 12, [&](const Vec3& d) {
      const double along = d.dot(centre), range = along - std::sqrt(along * along - 400 + 9);
      return Met{range, (range * d - centre) / 3, d.y() > 0.00436 && d.y() < 0.00654 ? 0 : kNoSurface};
    });
    for (const int row : {20, 25, 30}) {
      EXPECT_NEAR(std::abs(columns.side(1, row).y()), 0.012363, 3e-4) << row;
      EXPECT_NEAR(columns.side(1, row).z(), 0, 3e-4) << row;
      EXPECT_NEAR(columns.side(1, row).x(), 0, 1e-3) << row;
    }
  }
}

// A plane, a crease of 40 degrees between two faces along the row 25, and a box edge along a column.
TEST(NormalTurnsTest, AreNothingOnFlatFaces) {
  const auto plan = plan_of();
  const auto plane = [](const Vec3& normal, const Vec3& d) {
    return Met{normal.dot(Vec3(20, 0, 0)) / normal.dot(d), normal};
  };
  const FourColumns flat(*plan, 12, [&](const Vec3& d) { return plane(Vec3(-0.6, 0.64, 0.48), d); });
  EXPECT_FALSE(flat.hits(0).curved);

  const double half = 20 * std::numbers::pi / 180;
  const FourColumns crease(*plan, 12, [&](const Vec3& d) {
    return plane(Vec3(-std::cos(half), 0, d.z() > 0 ? std::sin(half) : -std::sin(half)), d);
  });
  const FourColumns edge(*plan, 12, [&](const Vec3& d) {
    return plane(Vec3(-std::sqrt(0.5), d.y() > 0.0055 ? std::sqrt(0.5) : -std::sqrt(0.5), 0), d);
  });
  for (int i = 0; i < 4; ++i) {
    for (int row = 0; row < 50; ++row) {
      for (const FourColumns* columns : {&crease, &edge}) {
        if (columns->hits(i).curved) {
          EXPECT_LT(columns->up(i, row).norm(), 1e-6) << i << ", " << row;
          EXPECT_LT(columns->side(i, row).norm(), 1e-6) << i << ", " << row;
        }
      }
    }
  }
}

// Two balls of different labels, and one behind the other, its front at 21 m: 21 / 3 x 1.7453e-3 = 0.012217. Up to 2.5
// degrees off the axis, 20 degrees from the front, it is up to 1 / cos 20 degrees = 1.07 times as much.
TEST(NormalTurnsTest, StayOnOneSurface) {
  const auto plan = plan_of();
  const FourColumns columns(*plan, 12, [&](const Vec3& d) {
    const bool above = d.z() > 0;
    const Vec3 centre(above ? 24 : 20, 0, 0);
    const double along = d.dot(centre), range = along - std::sqrt(along * along - centre.dot(centre) + 9);
    return Met{range, (range * d - centre) / 3, d.y() > 0.0055 ? 1U : 0U};
  });
  for (int i = 0; i < 4; ++i) {
    for (int row = 0; row < 50; ++row) {
      EXPECT_NEAR(columns.up(i, row).norm(), row < 25 ? 0.009890 : 0.012217, 1e-3) << i << ", " << row;
      EXPECT_LT(columns.side(i, row).norm(), 0.02) << i << ", " << row;
    }
  }
}

// Without turns the lobe is that of a flat surface, bit by bit.
TEST(LobeWideningTest, LeavesFlatSurfacesAsTheyAre) {
  for (float cosine = 0.01F; cosine <= 1; cosine += 0.0037F) {
    const LobeWidening none = widen_lobe({}, cosine, 200);
    EXPECT_EQ(none.share, 1);
    EXPECT_EQ(none.spared, 0);
    EXPECT_EQ(widened_lobe(2, 200, cosine, none), facet_lobe(2, 200, cosine) / cosine);
  }
}

// s = 0.1, normal 10 degrees off the ray towards +y; u = 0.3 along y, v = 0.2 along z, k = 1/6: S = diag(0.025,
// 0.0166667), sqrt(det) = 0.0204124, s^4 / det = 0.24. w = sin 10 degrees = 0.173648 along y: s^2 w^2 / S = 0.0120615
// of the 0.0301537. The lobe: |R|^2 = 0.81, 0.81 / (8 pi 0.01) x sqrt(0.24) x e^(-0.0120615 / 0.9879385 / 0.02)
// / 0.9879385^2 = 0.8785811; / sqrt(0.9698463 + 0.76 x 0.0301537) -> / 0.9963749.
TEST(LobeWideningTest, HasTheCovarianceOfSlopesInAFootprint) {
  const double sine = 0.17364817766693033, cosine = 0.984807753012208;
  const precise::LobeWidening widening = precise::widen_lobe({.up_up = 0.09,
                                                              .side_side = 0.04,
                                                              .up_side = 0,
                                                              .up_ray = 0,
                                                              .side_ray = 0,
                                                              .up_normal = 0.3 * sine,
                                                              .side_normal = 0},
                                                             cosine, 50);
  EXPECT_NEAR(widening.share, 0.24, 1e-7);
  EXPECT_NEAR(widening.spared, 0.0301537 - 0.0120615, 1e-7);
  const Scattering surface{.lambert = 0, .reflection = 0.9, .rms_slope = 0.1};
  const double expected = 0.81 / (8 * std::numbers::pi * 0.01) * std::sqrt(0.24) *
                          std::exp(-0.0120615 / 0.9879385 / 0.02) / (0.9879385 * 0.9879385) / 0.9963749;
  EXPECT_NEAR(precise::primary_intensity_of(surface, cosine, 1, 0, 1, widening), expected, 1e-5);
  EXPECT_NEAR(widened_lobe(static_cast<float>(0.81 / (8 * std::numbers::pi * 0.01)), 50, static_cast<float>(cosine),
                           {static_cast<float>(widening.share), static_cast<float>(widening.spared)}),
              expected, 1e-5);
}

}  // namespace
}  // namespace insonify::normal_turns_test
