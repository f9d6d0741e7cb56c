// instances.h -- which instances gave a bin its energy, the strongest first.

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

/// All that one instance gave to a bin.
struct InstanceEcho {
  std::uint16_t instance, material;  // The latter of its strongest surface in one cell.
  float energy, strongest_surface;
  double elevation_moment, elevation_square;
};

/// Instances that the cells of a slice may name: a scanning head's eight cells of kSurfacesKept each.
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

  /// The strongest first; of equals that which comes first in the scene.
  [[nodiscard]] std::span<const InstanceEcho> strongest() {
    const int wanted = std::min(count_, kStrongestCount);
    for (int rank = 0; rank < wanted; ++rank) {  // There are few.
      int best = rank;
      for (int other = rank + 1; other < count_; ++other) {
        best = goes_before(echoes_[other], echoes_[best]) ? other : best;
      }
      if (best != rank) {
        std::swap(echoes_[best], echoes_[rank]);
      }
    }
    return {echoes_.data(), static_cast<std::size_t>(wanted)};
  }

 private:
  static bool goes_before(const InstanceEcho& a, const InstanceEcho& b) {
    return a.energy != b.energy ? a.energy > b.energy : a.instance < b.instance;
  }

  std::array<InstanceEcho, std::size_t{BearingCells::kMostPerBeam} * kSurfacesKept> echoes_;  // The first count_.
  int count_ = 0;
};

}  // namespace insonify
