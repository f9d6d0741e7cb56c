// ping_view.h -- one ping of a batch, as engines and echo sources see it: the sonar, and where everything is.

#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "echo/model/flat_plan.h"
#include "insonify/geometry.h"
#include "insonify/ground_truth.h"

namespace insonify {

class Refraction;

/// Poses of a scene's instances: those of the scene, except for the few that have moved.
struct Placement {
  struct Moved {
    int instance = 0;
    Pose world_from_mesh = {};

    [[nodiscard]] bool operator==(const Moved& other) const {
      return instance == other.instance && world_from_mesh.position == other.world_from_mesh.position &&
             world_from_mesh.orientation.coeffs() == other.world_from_mesh.orientation.coeffs();
    }
  };

  std::span<const Pose> at_home;  ///< [instance] World from mesh, in the scene.
  std::vector<Moved> moved;       ///< Instances that are elsewhere, by rising index.

  /// World from mesh.
  [[nodiscard]] const Pose& operator[](int instance) const {
    const auto found = std::ranges::lower_bound(moved, instance, {}, &Moved::instance);
    return found != moved.end() && found->instance == instance ? found->world_from_mesh
                                                               : at_home[static_cast<std::size_t>(instance)];
  }

  /// Whether two placements of one scene are the same; null is where the engine has everything.
  [[nodiscard]] static bool same(const Placement* a, const Placement* b) {
    return a == b || (a != nullptr && b != nullptr && std::ranges::equal(a->moved, b->moved));
  }
};

struct Reception;

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
  const Reception* reception = nullptr;    ///< What an engine may receive itself; null: nothing.
  const Refraction* refraction = nullptr;  ///< How the water bends rays; null: they are straight.

  // For echo sources; engines do not read these.
  std::uint64_t number = 0;      ///< Number of the ping.
  double time = 0;               ///< Time of transmission [s].
  Pose world_from_vehicle = {};  ///< At transmission.
  Pose vehicle_from_sonar = {};  ///< At transmission.
};

}  // namespace insonify
