// instances.h -- which instances gave a bin its energy, the strongest first.

#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "echo/grid/echo.h"
#include "echo/grid/echo_grid.h"
#include "insonify/ping.h"

namespace insonify {

/// All that one instance gave to a bin.
struct InstanceEcho {
  std::uint16_t instance, material;  // The latter of its strongest surface in one cell.
  float energy, strongest_surface;
  double elevation_moment, elevation_square;
};

/// Instances that gave a bin its energy. Allocates only for more of them than ever before.
class Instances {
 public:
  void clear() { echoes_.clear(); }

  void add(const SurfaceEcho& echo) {
    const std::uint16_t instance = instance_of(echo.surface);
    auto place = std::ranges::find(echoes_, instance, &InstanceEcho::instance);
    if (place == echoes_.end()) {
      place = echoes_.insert(place, {instance, kNoLabel, 0, 0, 0, 0});
    }
    InstanceEcho& entry = *place;
    entry.energy += echo.energy;
    entry.elevation_moment += double{echo.elevation_moment};
    entry.elevation_square += double{echo.elevation_square};
    if (echo.energy > entry.strongest_surface) {
      entry.strongest_surface = echo.energy;
      entry.material = material_of(echo.surface);
    }
  }

  /// The strongest first; of equals that which comes first in the scene.
  [[nodiscard]] std::span<const InstanceEcho> strongest() {
    const std::size_t wanted = std::min(echoes_.size(), std::size_t{kStrongestCount});
    std::ranges::partial_sort(echoes_, echoes_.begin() + static_cast<std::ptrdiff_t>(wanted), goes_before);
    return std::span(echoes_).first(wanted);
  }

 private:
  static bool goes_before(const InstanceEcho& a, const InstanceEcho& b) {
    return a.energy != b.energy ? a.energy > b.energy : a.instance < b.instance;
  }

  std::vector<InstanceEcho> echoes_;
};

}  // namespace insonify
