// aperture.h -- one aperture of a simulated sonar: its plan, and the sources and receivers that pings reuse.

#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "echo/batch/source_set.h"
#include "echo/model/flat_plan.h"
#include "echo/walks/random_walks.h"
#include "insonify/scenario.h"
#include "receiver/calibrated_receiver.h"

namespace insonify {

/// What insonifies the scene at a ping and receives its echoes: the transducer of a fan or a head, one side of a
/// side-scan sonar. Plan and receivers are made from the same SonarConfig and Water, so that they agree.
struct Aperture {
  /// @param scenario   Valid; `sonar` need not be one of its sonars.
  /// @param sonar      With defaults filled in.
  /// @param index      Which of its apertures.
  /// @param materials  The scene's materials at this sonar's frequency; not kept.
  Aperture(const Scenario& scenario, const SonarConfig& sonar, int index, std::span<const Material> materials);

  /// Makes receivers for so many threads, where there are fewer. None in the paper model.
  void add_receivers(const Scenario& scenario, std::span<const Material> materials, std::size_t threads);

  SonarConfig config;  ///< The aperture as a sonar by itself: SonarConfig::aperture().
  Pose housing_from_aperture;
  std::uint64_t seed;
  SonarConfig steered;  ///< With the beams' true bearings.
  BearingCells cells;
  std::shared_ptr<const FlatPlan> plan;
  GridLayers layers;
  std::optional<RandomWalks::Settings> walks;                  ///< Where the scenario has random_walks.
  std::vector<std::unique_ptr<SourceSet>> sources;             ///< For each view of a batch.
  std::vector<std::unique_ptr<CalibratedReceiver>> receivers;  ///< For each thread.
};

}  // namespace insonify
