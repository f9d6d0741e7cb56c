// ping_view.h -- one ping of a batch, as engines and echo sources see it.

#pragma once

#include <cstdint>

#include "echo/batch/placement.h"
#include "echo/model/flat_plan.h"
#include "insonify/geometry.h"
#include "insonify/ground_truth.h"

namespace insonify {

/// The layers of an EchoGrid.
struct GridLayers {
  int orders = kPathOrders;  ///< Path orders, 1..kPathOrders.
  GroundTruth ground_truth = GroundTruth::kLabels;
  bool labelled = false;  ///< Whether surfaces are labelled even with GroundTruth::kNone.
};

/// One ping of a batch: a sonar, where it is, and where everything else is.
struct PingView {
  const FlatPlan* plan = nullptr;
  Pose world_from_sonar = {};            ///< Pose of the transducer: the head, turned, for a scanning sonar.
  const Placement* placement = nullptr;  ///< Null: all instances are as the engine has them.
  GridLayers layers = {};

  // For echo sources; engines do not read these.
  std::uint64_t number = 0;      ///< Number of the ping.
  double time = 0;               ///< Time of transmission [s].
  Pose world_from_vehicle = {};  ///< At transmission.
  Pose vehicle_from_sonar = {};  ///< At transmission.
};

}  // namespace insonify
