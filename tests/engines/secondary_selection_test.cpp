// secondary_selection_test.cpp -- selection of the hits from which the cpu engine traces reflected rays: number of
// rays, and unbiased echoes.

#include <cmath>

#include "engines/random_scene.h"

namespace insonify::secondary_selection_test {
namespace {

using namespace testing_scenes;

// Rays reflected from a flat floor into open water miss the boxes around all objects, and are not traced.
TEST(SecondarySelectionTest, TracesNoRaysIntoOpenWater) {
  SonarConfig sonar;
  sonar.beam_count = 16;
  sonar.elevation_center = -20 * kDegree;
  FlatPlanSettings settings{.sonar = sonar, .secondary = SecondaryEchoes::kAll};
  const auto engine = test_engine("cpu", 2);
  const Scene scene = SceneMaker().add_floor(-3).add_sphere({6, 0, -2}, 0.5).scene();
  engine->set_scene(scene);
  const EchoGrid all = echoes_of(*engine, settings);
  const RayCounts rays_all = engine->ray_counts();
  settings.secondary = SecondaryEchoes::kSelective;
  const EchoGrid selective = echoes_of(*engine, settings);
  const RayCounts rays = engine->ray_counts();
  EXPECT_GT(rays.return_legs, 0U);
  EXPECT_LT(rays.secondary, rays_all.secondary / 10);
  EXPECT_NEAR(total(selective, 2) / total(all, 2), 1, 0.05);
}

// Half of the hits are on a wall above the sonar, and their reflected rays go into open water. Of the others a sample
// is traced.
TEST(SecondarySelectionTest, TracesASampleOfTheRaysThatMayHitASurface) {
  SonarConfig sonar;
  sonar.beam_count = 64;
  sonar.elevation_center = 0;
  sonar.elevation_aperture = 40 * kDegree;
  sonar.azimuth_aperture = 60 * kDegree;
  FlatPlanSettings settings{.sonar = sonar, .secondary = SecondaryEchoes::kAll};
  const auto engine = test_engine("cpu", 2);
  const Scene scene = SceneMaker().add_floor(-3).add_wall(8).scene();
  engine->set_scene(scene);
  const EchoGrid all = echoes_of(*engine, settings);
  const auto rays_all = static_cast<double>(engine->ray_counts().secondary);
  settings.secondary = SecondaryEchoes::kSelective;
  const EchoGrid selective = echoes_of(*engine, settings);
  const auto rays = static_cast<double>(engine->ray_counts().secondary);
  EXPECT_NEAR(rays / rays_all, 0.25, 0.05);
  EXPECT_NEAR(total(selective, 2) / total(all, 2), 1, 0.02);
}

TEST(SecondarySelectionTest, SeedsSelectDifferentHits) {
  SonarConfig sonar;
  sonar.beam_count = 16;
  sonar.elevation_center = -15 * kDegree;
  sonar.azimuth_aperture = 60 * kDegree;
  FlatPlanSettings settings{.sonar = sonar, .secondary = SecondaryEchoes::kSelective};
  const auto engine = test_engine("cpu", 2);
  const Scene scene = SceneMaker().add_floor(-3).add_wall(8).scene();
  engine->set_scene(scene);
  const EchoGrid first = echoes_of(*engine, settings);
  ++settings.seed;
  const EchoGrid second = echoes_of(*engine, settings);
  EXPECT_EQ(difference(first, second, 1), 0);
  EXPECT_GT(difference(first, second, 2), 0.001);
}

// Differences of a quantity between `selective` and `all`, over many pings with independent random selections.
class Surplus {
 public:
  void add(double selective, double all) {
    const double surplus = selective - all;
    sum_ += surplus;
    squares_ += surplus * surplus;
    all_ += all;
  }
  // The sum of differences in units of its standard deviation, under the hypothesis that their mean is zero.
  [[nodiscard]] double deviations() const { return sum_ / std::sqrt(squares_); }
  // That standard deviation relative to the total: the bias that the test can detect.
  [[nodiscard]] double resolution() const { return std::sqrt(squares_) / all_; }

 private:
  double sum_ = 0, squares_ = 0, all_ = 0;
};

double total_weight(const EchoGrid& grid) {
  double sum = 0;
  for (int beam = 0; beam < grid.beam_count(); ++beam) {
    for (const float value : grid.weight(2, beam)) {
      sum += value;
    }
  }
  return sum;
}

// The random selection is unbiased: the expected sums of energy and weight are those of `all`.
TEST(SecondarySelectionTest, PreservesTheSumsOfEnergyAndWeight) {
  Surplus energy, weight;
  RayCounts rays_all, rays_selective;
  for (int number = 0; number < 60; ++number) {
    const RandomScene random(number);
    const auto engine = test_engine("cpu", 2);
    engine->set_scene(random.scene);
    FlatPlanSettings settings{.sonar = random.sonar, .secondary = SecondaryEchoes::kAll};
    settings.sonar.sampling = {4, 100};
    const EchoGrid all = echoes_of(*engine, settings, random.pose);
    rays_all.secondary += engine->ray_counts().secondary;
    settings.secondary = SecondaryEchoes::kSelective;
    for (int seed = 0; seed < 8; ++seed) {
      settings.seed = 100ULL * number + seed;
      const EchoGrid selective = echoes_of(*engine, settings, random.pose);
      energy.add(total(selective, 2), total(all, 2));
      weight.add(total_weight(selective), total_weight(all));
    }
    rays_selective.secondary += engine->ray_counts().secondary;
  }
  EXPECT_LT(rays_selective.secondary, rays_all.secondary);
  EXPECT_LT(energy.resolution(), 0.003);
  EXPECT_LT(weight.resolution(), 0.01);
  EXPECT_LT(std::abs(energy.deviations()), 3.3);  // Exceeded by chance once in a thousand.
  EXPECT_LT(std::abs(weight.deviations()), 3.3);
}

// The same in the calibrated model, with patterns, cones and rough mirrors: reciprocal echoes and those reflected
// twice.
TEST(SecondarySelectionTest, PreservesTheSumsOfCalibratedEnergy) {
  Surplus once, twice;
  double sent = 0, sent_by_all = 0;
  for (int number = 0; number < 60; ++number) {
    const RandomScene random(number);
    const auto engine = test_engine("cpu", 2);
    engine->set_scene(random.scene);
    FlatPlanSettings settings{.sonar = random.sonar,
                              .model = EchoModel::kCalibrated,
                              .materials = random.scene.materials,
                              .beam_shape = number % 4 < 2 ? BeamShape::kWedge : BeamShape::kCone,
                              .elevation_array = number % 2 == 0 ? std::optional<ArraySettings>()
                                                                 : ArraySettings{.window = ArrayWindow::kHann},
                              .secondary = SecondaryEchoes::kSelective,
                              .rough_mirrors = number % 3 == 0};
    settings.sonar.sampling = {4, 100};
    for (int seed = 0; seed < 8; ++seed) {
      settings.seed = 100ULL * number + seed;
      const EchoGrid selective = echoes_of(*engine, settings, random.pose);
      sent += static_cast<double>(engine->ray_counts().secondary);
      settings.secondary = SecondaryEchoes::kAll;  // With the same facets, which the seed draws.
      const EchoGrid every = echoes_of(*engine, settings, random.pose);
      sent_by_all += static_cast<double>(engine->ray_counts().secondary);
      settings.secondary = SecondaryEchoes::kSelective;
      once.add(total(selective, 2), total(every, 2));
      twice.add(total(selective, 3), total(every, 3));
    }
  }
  EXPECT_LT(sent, 0.5 * sent_by_all);
  EXPECT_LT(std::abs(once.deviations()), 3.3);  // Exceeded by chance once in a thousand.
  EXPECT_LT(std::abs(twice.deviations()), 3.3);
  EXPECT_LT(once.resolution(), 0.01);
}

// In the calibrated model the probability p of a hit is |R| / sqrt(2) where all samples have the same solid angle:
// 0.212 and 0.424 for |R| of 0.3 and 0.6. Some half of the hits are on a wall above the sonar; their reflected rays go
// into open water, and most, not all, are left out. By |facing| x reflectivity the share was 0.24 for both.
TEST(SecondarySelectionTest, FollowsHitsByTheEnergyThatTheyReflect) {
  SonarConfig sonar;
  sonar.beam_count = 64;
  sonar.elevation_aperture = 40 * kDegree;
  sonar.azimuth_aperture = 60 * kDegree;
  Scene scene = SceneMaker().add_floor(-3).add_wall(8).scene();
  const auto engine = test_engine("cpu", 2);
  std::vector<double> shares;
  for (const double reflection : {0.3, 0.6}) {
    for (Material& material : scene.materials) {
      material.reflection = reflection;
    }
    engine->set_scene(scene);
    FlatPlanSettings settings{.sonar = sonar,
                              .model = EchoModel::kCalibrated,
                              .materials = scene.materials,
                              .secondary = SecondaryEchoes::kAll};
    const EchoGrid all = echoes_of(*engine, settings);
    const auto rays_all = static_cast<double>(engine->ray_counts().secondary);
    settings.secondary = SecondaryEchoes::kSelective;
    const EchoGrid selective = echoes_of(*engine, settings);
    const auto rays = static_cast<double>(engine->ray_counts().secondary);
    shares.push_back(rays / rays_all);
    EXPECT_GT(shares.back(), 0.4 * reflection / std::sqrt(2));
    EXPECT_LT(shares.back(), reflection / std::sqrt(2));
    EXPECT_NEAR(total(selective, 2) / total(all, 2), 1, 0.05) << reflection;
  }
  EXPECT_GT(shares[1], 1.25 * shares[0]);
}

}  // namespace
}  // namespace insonify::secondary_selection_test
