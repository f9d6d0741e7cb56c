// ray_count_test.cpp -- T5 of docs/concepts/physics-tests.md: levels do not depend on the number of samples, with rays
// and with the rasteriser.

#include "engines/test_scenes.h"

namespace insonify::ray_count_test {
namespace {

using namespace testing_scenes;

constexpr int kBeamsABlock = 4, kBinsABlock = 8;

// Sums of a layer over blocks of neighbouring beams and bins.
template <typename Layer>
std::vector<double> block_sums(const EchoGrid& grid, const Layer& layer) {
  const int across = grid.beam_count() / kBeamsABlock, along = grid.bin_count() / kBinsABlock;
  std::vector<double> sums(static_cast<std::size_t>(across) * along, 0);
  for (int beam = 0; beam < across * kBeamsABlock; ++beam) {
    const auto values = layer(beam);
    for (int bin = 0; bin < along * kBinsABlock; ++bin) {
      sums[static_cast<std::size_t>(beam / kBeamsABlock) * along + bin / kBinsABlock] += values[bin];
    }
  }
  return sums;
}

struct Found {
  const char* name;
  PrimaryEchoes primary;
  EchoModel model;
};

class RayCountTest : public testing::TestWithParam<Found> {};

// The floor of T4, 3 m below a level sonar, with a sphere above it.
TEST_P(RayCountTest, LevelsDoNotDependOnTheNumberOfSamples) {
  SonarConfig sonar;
  sonar.beam_count = 256;
  sonar.azimuth_aperture = 120 * kDegree;
  sonar.elevation_aperture = 20 * kDegree;
  sonar.elevation_center = -15 * kDegree;
  sonar.min_range = 0;
  sonar.max_range = 36;
  sonar.bin_count = 360;
  const Scene scene = without_glints(SceneMaker().add_floor(-3).add_sphere({14, 1, -2}, 0.8, 0.6, 0.05).scene());
  const auto engine = test_engine("cpu", 2);
  engine->set_scene(scene);
  const auto ping = [&](int columns_per_beam, int rows) {
    FlatPlanSettings settings{.sonar = sonar,
                              .model = GetParam().model,
                              .materials = scene.materials,
                              .primary = GetParam().primary,
                              .secondary = SecondaryEchoes::kNone};
    settings.sonar.sampling = {columns_per_beam, rows};
    return echoes_of(*engine, settings);
  };
  const EchoGrid base = ping(4, 400);
  const auto energy_of = [](const EchoGrid& grid) {
    return block_sums(grid, [&](int beam) { return grid.energy(1, beam); });
  };
  const std::vector<double> energy = energy_of(base);
  const std::vector<double> weight = block_sums(base, [&](int beam) { return base.weight(1, beam); });
  const double solid_angle =
      sonar.azimuth_aperture * (std::sin(-5 * kDegree) - std::sin(-25 * kDegree)) / (256.0 * 4 * 400);
  for (const auto& [columns_per_beam, rows] : {std::pair{8, 400}, std::pair{4, 800}, std::pair{8, 800}}) {
    const EchoGrid finer_grid = ping(columns_per_beam, rows);
    const std::vector<double> finer = energy_of(finer_grid);
    int blocks = 0;
    double worst = 0;
    for (std::size_t i = 0; i < energy.size(); ++i) {
      if (weight[i] > 100 * solid_angle) {
        ++blocks;
        worst = std::max(worst, std::abs(finer[i] / energy[i] - 1));
      }
    }
    EXPECT_GE(blocks, 1000) << columns_per_beam << " x " << rows;
    EXPECT_LE(worst, 0.03) << columns_per_beam << " x " << rows;
    EXPECT_NEAR(total(finer_grid, 1) / total(base, 1), 1, 0.005) << columns_per_beam << " x " << rows;
  }
}

constexpr Found kFound[] = {{"rays", PrimaryEchoes::kRays, EchoModel::kPaper},
                            {"raster", PrimaryEchoes::kRaster, EchoModel::kPaper},
                            {"raysCalibrated", PrimaryEchoes::kRays, EchoModel::kCalibrated},
                            {"rasterCalibrated", PrimaryEchoes::kRaster, EchoModel::kCalibrated}};
INSTANTIATE_TEST_SUITE_P(Primaries, RayCountTest, testing::ValuesIn(kFound),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace insonify::ray_count_test
