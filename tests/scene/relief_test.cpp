// relief_test.cpp -- tiles, and random ripples and roughness.

#include "insonify/relief.h"

#include <gtest/gtest.h>

#include <numbers>

#include "insonify/geometry.h"
#include "support/message_of.h"

namespace insonify::relief_test {
namespace {

using Vec2f = Eigen::Vector2f;
constexpr float kFloat = 1e-5F;

TEST(TileTest, IsLinearBetweenTexelsAndRepeats) {
  // 1 2 | above, 3 4 | below; texel centres at 1/4 and 3/4.
  const Tile<float> tile{2, 2, {1, 2, 3, 4}};
  EXPECT_FLOAT_EQ(tile.at(0.25F, 0.75F), 1);
  EXPECT_FLOAT_EQ(tile.at(0.75F, 0.25F), 4);
  EXPECT_FLOAT_EQ(tile.at(0.5F, 0.5F), 2.5F);
  EXPECT_FLOAT_EQ(tile.at(0.375F, 0.75F), 1.25F);
  EXPECT_FLOAT_EQ(tile.at(0, 0.75F), 1.5F);  // Across the seam.
  EXPECT_FLOAT_EQ(tile.at(0.25F, 1), 2);
  EXPECT_FLOAT_EQ(tile.at(-7.75F, 12.75F), 1);
}

TEST(SlopesTest, AreTheTangentsOfNormals) {
  const Eigen::Vector3f normal = Eigen::Vector3f(-0.3F, 0.2F, 1).normalized();  // Rises to the right, falls upwards.
  const Tile<Vec2f> slopes = slopes_of_normals({1, 1, {normal}});
  EXPECT_LT((slopes.texels[0] - Vec2f(0.3F, -0.2F)).norm(), kFloat);
}

TEST(SlopesTest, AreTheDerivativesOfHeights) {
  constexpr int kSize = 64;
  Tile<float> heights{kSize, kSize, {}};
  const auto turn = [](int texel) {
    return 2 * std::numbers::pi_v<float> * (static_cast<float>(texel) + 0.5F) / kSize;
  };
  for (int row = 0; row < kSize; ++row) {
    for (int column = 0; column < kSize; ++column) {
      heights.texels.push_back(0.1F * std::sin(turn(column)) + 0.2F * std::cos(turn(kSize - 1 - row)));
    }
  }
  const Tile<Vec2f> slopes = slopes_of_heights(heights);
  for (int row = 0; row < kSize; row += 7) {
    for (int column = 0; column < kSize; column += 5) {
      const Vec2f expected(0.2F * std::numbers::pi_v<float> * std::cos(turn(column)),
                           -0.4F * std::numbers::pi_v<float> * std::sin(turn(kSize - 1 - row)));
      EXPECT_LT((slopes.texels[row * kSize + column] - expected).norm(), 0.003F);
    }
  }
}

TEST(ReliefConfigTest, RefusesSettingsThatExcludeEachOther) {
  const auto message = [](const ReliefConfig& config) {
    return message_of([&] { config.validate("materials.sand"); });
  };
  EXPECT_EQ(message({.normal_map = "a.png", .height_map = "b.png", .height = 1}),
            "materials.sand.height_map cannot go with normal_map: one shape a surface");
  EXPECT_EQ(message({.normal_map = "a.png", .roughness_height = 0.1}),
            "materials.sand.normal_map cannot go with ripples or roughness: one shape a surface");
  EXPECT_EQ(message({.height_map = "a.png", .height = 1, .roughness_height = 0.1}),
            "materials.sand.height_map cannot go with ripples or roughness: one shape a surface");
  EXPECT_EQ(message({.height_map = "a.png"}),
            "materials.sand.height_map needs height, how far white lies above black [m]");
  EXPECT_EQ(message({.height = 1}), "materials.sand.height needs height_map, the picture that it is for");
  EXPECT_EQ(message({.normal_strength = 2}),
            "materials.sand.normal_strength needs normal_map, the picture that it is for");
  EXPECT_EQ(message({.ripple_wavelength = 1}), "materials.sand.ripple_wavelength needs ripple_height");
  EXPECT_EQ(message({.ripple_height = 1}), "materials.sand.ripple_height needs ripple_wavelength");
  EXPECT_EQ(message({.roughness_height = -1}), "materials.sand.roughness_height = -1 m must be from 0 to 100 m");
  EXPECT_EQ(message({.normal_map = "a.png", .tile_size = 1e-40}),
            "materials.sand.tile_size = 1e-40 m must be 0 or at least 0.001 m");
  EXPECT_EQ(message({.ripple_wavelength = 1e-300, .ripple_height = 0.1}),
            "materials.sand.ripple_wavelength = 1e-300 m must be 0 or at least 0.001 m");
  EXPECT_EQ(message({.ripple_wavelength = 1, .ripple_height = 0.1, .tile_size = 1.5}),
            "materials.sand.tile_size = 1.5 m must hold at least 2 ripples of 1 m, or be 0");
  EXPECT_EQ(message({.ripple_wavelength = 1, .ripple_height = 0.1, .tile_size = 200}),
            "materials.sand.tile_size = 200 m must be at most 128 ripples of 1 m");
  ReliefConfig({.ripple_wavelength = 1, .ripple_height = 0.1, .roughness_height = 0.1}).validate("good");
}

// ---------------------------------------------------------------------------------------------------------------------

struct SlopeStatistics {
  Vec2f mean = Vec2f::Zero(), rms = Vec2f::Zero();
};

SlopeStatistics statistics_of(const Tile<Vec2f>& slopes) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero(), squares = Eigen::Vector2d::Zero();
  for (const Vec2f& slope : slopes.texels) {
    sum += slope.cast<double>();
    squares += slope.cwiseAbs2().cast<double>();
  }
  const auto count = static_cast<double>(slopes.texels.size());
  return {(sum / count).cast<float>(), (squares / count).cwiseSqrt().cast<float>()};
}

// Waves of one length and height have slopes of 2 pi / length times that height, along their direction.
TEST(MakeReliefTest, RipplesHaveTheSlopesOfTheirHeightAndLength) {
  ReliefConfig config{.ripple_wavelength = 0.5, .ripple_height = 0.06};
  const float expected = static_cast<float>(2 * std::numbers::pi / 0.5 * 0.06 / (2 * std::numbers::sqrt2));
  const Relief along_x = make_relief(config);
  EXPECT_DOUBLE_EQ(along_x.tile_size, 12);
  EXPECT_TRUE(along_x.by_position);
  const SlopeStatistics x = statistics_of(along_x.slopes);
  EXPECT_LT(x.mean.norm(), 1e-5F);
  EXPECT_NEAR(x.rms.x(), expected, 0.03F * expected);
  EXPECT_LT(x.rms.y(), 0.15F * x.rms.x());

  // Each ripple crosses zero twice: 24 ripples in a row of the tile.
  int crossings = 0;
  for (std::size_t i = 1; i < along_x.slopes.texels.size(); ++i) {
    crossings += std::signbit(along_x.slopes.texels[i - 1].x()) != std::signbit(along_x.slopes.texels[i].x()) ? 1 : 0;
  }
  EXPECT_NEAR(static_cast<double>(crossings) / along_x.slopes.rows, 48, 2);

  config.ripple_direction = std::numbers::pi / 2;
  const SlopeStatistics y = statistics_of(make_relief(config).slopes);
  EXPECT_NEAR(y.rms.y(), expected, 0.03F * expected);
  EXPECT_LT(y.rms.x(), 0.15F * y.rms.y());
}

// Rows of a tile run down, y runs up: a wave towards (1, 1) rises to the right and up together.
TEST(MakeReliefTest, DirectionsTurnFromXTowardsY) {
  const Relief relief =
      make_relief({.ripple_wavelength = 0.5, .ripple_height = 0.06, .ripple_direction = std::numbers::pi / 4});
  double product = 0, squares = 0;
  for (const Vec2f& slope : relief.slopes.texels) {
    product += slope.x() * slope.y();
    squares += 0.5 * slope.squaredNorm();
  }
  EXPECT_GT(product, 0.9 * squares);
  // The slopes are a gradient: the rise around any small loop is zero.
  const auto& slopes = relief.slopes;
  const auto at = [&](int column, int row) { return slopes.texels[row * slopes.columns + column]; };
  double loop = 0, change = 0;
  for (int row = 1; row < slopes.rows; ++row) {
    for (int column = 1; column < slopes.columns; ++column) {
      const double y_along_x = at(column, row).y() - at(column - 1, row).y();
      const double x_along_y = at(column, row - 1).x() - at(column, row).x();
      loop += std::pow(y_along_x - x_along_y, 2);
      change += std::pow(y_along_x, 2);
    }
  }
  EXPECT_LT(loop, 0.1 * change);
}

// The spectrum k^-3.25 over the waves that fit on a tile of 2 m, summed term by term.
TEST(MakeReliefTest, RoughnessHasTheSlopesOfItsSpectrum) {
  const Relief relief = make_relief({.roughness_height = 0.01, .tile_size = 2});
  double power = 0, slope_power = 0;
  for (int x = -255; x <= 255; ++x) {
    for (int y = -255; y <= 255; ++y) {
      if (x != 0 || y != 0) {
        const double k = std::hypot(x, y);
        power += std::pow(k, -3.25);
        slope_power += std::pow(k, -3.25) * std::pow(std::numbers::pi * k, 2);  // 2 pi k / 2 m
      }
    }
  }
  const double expected = 0.01 * std::sqrt(slope_power / power / 2);
  const SlopeStatistics slopes = statistics_of(relief.slopes);
  EXPECT_NEAR(slopes.rms.x(), expected, 0.03 * expected);
  EXPECT_NEAR(slopes.rms.y(), expected, 0.03 * expected);
}

TEST(MakeReliefTest, TilesHaveNoSeamAndComeFromTheirSeed) {
  const ReliefConfig config{.roughness_height = 0.01, .roughness_exponent = 5};
  const Relief relief = make_relief(config);
  const auto& slopes = relief.slopes;
  double inside = 0, seam = 0;
  for (int row = 0; row < slopes.rows; ++row) {
    const auto at = [&](int column) { return slopes.texels[row * slopes.columns + column]; };
    inside += (at(200) - at(201)).squaredNorm();
    seam += (at(0) - at(slopes.columns - 1)).squaredNorm();
  }
  EXPECT_LT(seam, 1.5 * inside);
  EXPECT_EQ(make_relief(config).slopes.texels, slopes.texels);
  ReliefConfig other = config;
  other.relief_seed = 2;
  EXPECT_NE(make_relief(other).slopes.texels, slopes.texels);
}

}  // namespace
}  // namespace insonify::relief_test
