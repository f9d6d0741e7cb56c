// instances.h -- sums a bin's echo energy by instance and ranks the instances, strongest first.

#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "echo/grid/echo.h"
#include "insonify/echo_grid.h"
#include "insonify/ping.h"
#include "receiver/bearing_cells.h"

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

/// The instances that echo in one bin of a beam. At most kMaxPerBeam cells (those of a scanning head's beam) name
/// kSurfacesKept surfaces each.
class Instances {
 public:
  void clear() { count_ = 0; }

  void add(const SurfaceEcho& echo) {
    const std::uint16_t instance = instance_of(echo.surface);
    int place = 0;
    while (place < count_ && echoes_[place].instance != instance) {
      ++place;
    }
    InstanceEcho& entry = echoes_[place];
    if (place == count_) {
      entry = {instance, kNoLabel, 0, 0, 0, 0};
      ++count_;
    }
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
    const int wanted = std::min(count_, kStrongestCount);
    for (int rank = 0; rank < wanted; ++rank) {  // Selection sort: the list is short.
      int best = rank;
      for (int other = rank + 1; other < count_; ++other) {
        best = ranks_before(echoes_[other], echoes_[best]) ? other : best;
      }
      if (best != rank) {
        std::swap(echoes_[best], echoes_[rank]);
      }
    }
    return {echoes_.data(), static_cast<std::size_t>(wanted)};
  }

 private:
  static bool ranks_before(const InstanceEcho& a, const InstanceEcho& b) {
    return a.energy != b.energy ? a.energy > b.energy : a.instance < b.instance;
  }

  std::array<InstanceEcho, std::size_t{BearingCells::kMaxPerBeam} * kSurfacesKept>
      echoes_;  // Entries [0, count_) are valid.
  int count_ = 0;
};

}  // namespace insonify
