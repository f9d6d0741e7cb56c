// instances.h -- which instances gave a bin its energy, the strongest first.

#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "echo/echo.h"
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
    auto* const end = echoes_.data() + count_;
    auto* entry = std::find_if(echoes_.data(), end, [&](const auto& known) { return known.instance == instance; });
    if (entry == end) {
      *entry = {instance, kNoLabel, 0, 0, 0, 0};
      ++count_;
    }
    entry->energy += echo.energy;
    entry->elevation_moment += double{echo.elevation_moment};
    entry->elevation_square += double{echo.elevation_square};
    if (echo.energy > entry->strongest_surface) {
      entry->strongest_surface = echo.energy;
      entry->material = material_of(echo.surface);
    }
  }

  /// The strongest first; of equals that which comes first in the scene.
  [[nodiscard]] std::span<const InstanceEcho> strongest() {
    const std::ptrdiff_t wanted = std::min(count_, kStrongestCount);
    std::partial_sort(echoes_.begin(), echoes_.begin() + wanted, echoes_.begin() + count_,
                      [](const InstanceEcho& a, const InstanceEcho& b) {
                        return a.energy != b.energy ? a.energy > b.energy : a.instance < b.instance;
                      });
    return {echoes_.data(), static_cast<std::size_t>(wanted)};
  }

 private:
  std::array<InstanceEcho, std::size_t{BearingCells::kMostPerBeam} * kSurfacesKept> echoes_;  // The first count_.
  int count_ = 0;
};

}  // namespace insonify
