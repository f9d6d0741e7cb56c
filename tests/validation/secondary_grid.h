// secondary_grid.h -- a grid with all the secondary echoes of one ping, as an engine fills it.

#pragma once

#include "support/test_engine.h"
#include "validation/calibrated_scene.h"

namespace insonify::validation {

/// What a test varies.
struct SecondaryOptions {
  int max_surfaces = 3;
  bool rough_mirrors = false;
  std::optional<ArraySettings> elevation_array = {};
};

inline EchoGrid secondary_grid(const Method& method, const Scene& scene, const SonarConfig& sonar,
                               const Pose& world_from_sonar, const SecondaryOptions& options = {}) {
  const auto engine = test_engine(method.engine, 2);
  engine->set_scene(scene);
  EchoGrid grid(sonar.beam_count, sonar.bin_count, kPathOrders);
  engine->insonify(*make_flat_plan({.sonar = sonar,
                                    .water = {.absorption = false},
                                    .model = EchoModel::kCalibrated,
                                    .materials = scene.materials,
                                    .elevation_array = options.elevation_array,
                                    .primary = method.primary,
                                    .secondary = SecondaryEchoes::kAll,
                                    .max_surfaces = options.max_surfaces,
                                    .rough_mirrors = options.rough_mirrors}),
                   world_from_sonar, grid);
  return grid;
}

}  // namespace insonify::validation
