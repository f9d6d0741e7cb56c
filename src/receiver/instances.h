// instances.h -- sums a bin's echo energy by instance and ranks the instances, strongest first.

#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "echo/grid/echo.h"
#include "echo/grid/echo_grid.h"
#include "insonify/ping.h"

namespace insonify {

/// Echo of one instance in one bin of a beam.
struct InstanceEcho {
  std::uint16_t instance;
  std::uint16_t material;   // Material of the instance's surface with most energy in a single cell.
  float energy;             // Sum over the beam's cells and the instance's surfaces.
  float strongest_surface;  // Energy of the surface that gave `material`.
  double elevation_moment;  // Sum of energy x elevation [rad], and ...
  double elevation_square;  // ... of energy x elevation^2 [rad^2]; elevation from the middle of the aperture.
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

  /// The kStrongestCount instances with most energy, in descending order; equals in the order of the scene.
  [[nodiscard]] std::span<const InstanceEcho> strongest() {
    const std::size_t wanted = std::min(echoes_.size(), std::size_t{kStrongestCount});
    std::ranges::partial_sort(echoes_, echoes_.begin() + static_cast<std::ptrdiff_t>(wanted), ranks_before);
    return std::span(echoes_).first(wanted);
  }

 private:
  static bool ranks_before(const InstanceEcho& a, const InstanceEcho& b) {
    return a.energy != b.energy ? a.energy > b.energy : a.instance < b.instance;
  }

  std::vector<InstanceEcho> echoes_;
};

}  // namespace insonify
