// left_out_test.cpp -- coherent share of glinting faces, and thin parts, taken off primary echoes.

#include "echo/model/left_out.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace insonify::left_out_test {
namespace {

// One column of hits on one instance, triangle 0 and 1 in turn.
constexpr int kRows = 150;  // More than are computed together.

struct Column {
  explicit Column(const FlatPlan& plan) : strip(1, plan.lattice.rows), hits(strip.column(0)) {
    hits.rows = kRows;
    for (int row = 0; row < kRows; ++row) {
      hits.surface[row] = surface_label(0, 0);
      hits.triangle[row] = static_cast<std::uint32_t>(row % 2);
      hits.range[row] = 5 + 0.01F * static_cast<float>(row);
      hits.facing[row] = (row % 3 == 0 ? -1.0F : 1.0F) * (1 - 2e-4F * static_cast<float>(row));
      hits.power[row] = 1000;
    }
    hits.surface[kRows - 1] = kNoSurface;
    hits.power[kRows - 1] = 0;
  }
  HitStrip strip;
  HitColumn hits;
};

std::shared_ptr<const FlatPlan> plan_of(const Material& material) {
  SonarConfig sonar;
  sonar.beam_count = 1;
  sonar.max_range = 40;
  sonar.frequency = 300e3;
  sonar.sampling = {1, 160};
  return make_flat_plan({.sonar = sonar, .model = EchoModel::kCalibrated, .materials = {&material, 1}});
}

Material smooth_metal() {
  Material metal;
  metal.lambert_db = -200;
  metal.reflection = 0.9;
  metal.rms_slope = 0.05;
  metal.rms_height = 1e-4;
  return metal;
}

// |R|^2 / (8 pi s^2 cos^4) e^(-tan^2 / 2 s^2) / cos e^(-4 k^2 h^2 cos^2) e^(-4 gamma r) / r^2, gamma = 0.
TEST(LeftOutTest, GlintingTrianglesLoseTheCoherentShareOfTheirLobe) {
  const Material metal = smooth_metal();
  const auto plan = plan_of(metal);
  const double wavenumber = 2 * std::numbers::pi / plan->wavelength();
  LeftOut left_out;
  left_out.glinting = {std::make_shared<const std::vector<std::uint8_t>>(std::vector<std::uint8_t>{1, 0})};
  Column column(*plan);
  leave_out(left_out, *plan, column.hits);
  double greatest = 0;
  for (int row = 0; row + 1 < kRows; ++row) {
    const double cosine = std::abs(double{column.hits.facing[row]}), range = double{column.hits.range[row]};
    const double tan_square = 1 / (cosine * cosine) - 1, slope_square = 0.05 * 0.05;
    const double lobe =
        0.81 / (8 * std::numbers::pi * slope_square * std::pow(cosine, 4)) * std::exp(-tan_square / (2 * slope_square));
    const double coherent = std::exp(-4 * wavenumber * wavenumber * 1e-8 * cosine * cosine);
    const double absorbed = std::exp(-4 * double{plan->neper_per_metre} * range);
    const double lost = row % 2 == 0 ? coherent * lobe / cosine * absorbed / (range * range) : 0;
    greatest = std::max(greatest, lost);
    EXPECT_NEAR(column.hits.power[row], 1000 - lost, 2e-4 * lost + 1e-3) << row;
  }
  EXPECT_GT(greatest, 0.1);
  EXPECT_EQ(column.hits.power[kRows - 1], 0);
}

TEST(LeftOutTest, NoEchoGetsLessThanNothing) {
  const Material metal = smooth_metal();
  const auto plan = plan_of(metal);
  Column column(*plan);
  std::fill_n(column.hits.power, kRows, 1e-9F);
  LeftOut left_out;
  left_out.glinting = {std::make_shared<const std::vector<std::uint8_t>>(2, 1)};
  leave_out(left_out, *plan, column.hits);
  EXPECT_EQ(column.hits.power[0], 0);
}

// Thinner than four samples at its range: 4 x the row's spacing (20 degrees in 160 rows) or the column's width.
TEST(LeftOutTest, ThinTrianglesHaveNoEchoOfTheLattice) {
  const Material metal = smooth_metal();
  const auto plan = plan_of(metal);
  Column column(*plan);
  LeftOut left_out;
  const float limit = thin_per_metre(*plan) * 5.5F;  // Reached at 5.5 m.
  left_out.thickness = {
      std::make_shared<const std::vector<float>>(std::vector<float>{limit, std::numeric_limits<float>::infinity()})};
  leave_out(left_out, *plan, column.hits);
  for (int row = 0; row + 1 < kRows; ++row) {
    EXPECT_EQ(column.hits.power[row], row % 2 == 0 && row > 50 ? 0 : 1000) << row;
  }
}

}  // namespace
}  // namespace insonify::left_out_test
