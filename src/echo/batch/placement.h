// placement.h -- where the instances of a scene are at one ping.

#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "insonify/geometry.h"

namespace insonify {

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

}  // namespace insonify
