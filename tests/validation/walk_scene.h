// walk_scene.h -- grids of random walks alone, for the tests of reverberation.

#pragma once

#include <numeric>

#include "echo/walks/random_walks.h"
#include "support/test_engine.h"
#include "validation/calibrated_scene.h"

namespace insonify::validation {

/// Walks of one sonar in one scene.
struct WalkScene {
  WalkScene(const char* engine_name, Scene the_scene, const FlatPlanSettings& settings, const Vec3& position, int walks,
            std::uint64_t seed = 5)
      : sonar(settings.sonar),
        scene(std::move(the_scene)),
        engine(test_engine(engine_name)),
        plan(planned(settings)),
        grid(settings.sonar.beam_count, settings.sonar.bin_count, kPathOrders),
        world_from_sonar{.position = position},
        first_seed(seed),
        walk_settings{.count = walks, .beams = all_beams(settings.sonar.beam_count)} {
    engine->set_scene(scene);
  }

  /// The grid of the walks of one ping; nothing else is in it.
  /// @param number  Of the seed: each has other walks.
  const EchoGrid& ping(std::uint64_t number, const RandomWalks::Elsewhere& elsewhere = {}) {
    grid.clear();
    walk_settings.elsewhere = elsewhere;
    walk_settings.seed = first_seed + number;
    RandomWalks walks(walk_settings);
    engine->add(walks, *plan, world_from_sonar, 0, grid);
    return grid;
  }

  [[nodiscard]] double energy(int order, double near = 0, double far = 1e9) const {
    double sum = 0;
    for (int beam = 0; beam < grid.beam_count(); ++beam) {
      for (int bin = 0; bin < grid.bin_count(); ++bin) {
        const double range = sonar.bin_range(bin);
        sum += range >= near && range < far ? grid.energy(order, beam)[bin] : 0;
      }
    }
    return sum;
  }

  /// Number of bins whose middle is in an interval of range.
  [[nodiscard]] double bins(double near, double far) const {
    int count = 0;
    for (int bin = 0; bin < grid.bin_count(); ++bin) {
      const double range = sonar.bin_range(bin);
      count += range >= near && range < far ? 1 : 0;
    }
    return count;
  }

  [[nodiscard]] static std::vector<int> all_beams(int count) {
    std::vector<int> beams(static_cast<std::size_t>(count));
    std::iota(beams.begin(), beams.end(), 0);
    return beams;
  }

  [[nodiscard]] std::shared_ptr<const FlatPlan> planned(FlatPlanSettings settings) const {
    settings.model = EchoModel::kCalibrated;
    settings.materials = scene.materials;
    return make_flat_plan(settings);
  }

  SonarConfig sonar;
  Scene scene;
  std::unique_ptr<TestEngine> engine;
  std::shared_ptr<const FlatPlan> plan;
  EchoGrid grid;
  Pose world_from_sonar;
  std::uint64_t first_seed;
  RandomWalks::Settings walk_settings;
};

/// Mean and standard error of values.
struct Mean {
  double sum = 0, square = 0;
  int count = 0;

  void add(double value) {
    sum += value;
    square += value * value;
    ++count;
  }
  [[nodiscard]] double value() const { return sum / count; }
  [[nodiscard]] double error() const { return std::sqrt((square / count - value() * value()) / (count - 1)); }
};

}  // namespace insonify::validation
