// surface_tally.h -- which surfaces gave a cell its energy, in as little memory as a cache line.

#pragma once

#include <algorithm>
#include <array>

#include "echo/grid/echo.h"
#include "insonify/echo_grid.h"

namespace insonify {

/// Adds a surface's echo to a tally of `kept` surfaces: Misra and Gries, Science of Computer Programming 2, 143 (1982),
/// with weights. While no more than `kept` different surfaces come, all is exact. When another one comes, it and those
/// in the tally all lose what the weakest of them has: of a cell's energy E no surface is ever missing more than
/// E / (kept + 1), and none is told too strong. Tallies may be added to each other; the bounds hold for the sum
/// (Agarwal et al., "Mergeable summaries", PODS 2012).
template <std::size_t kept>
void add_surface(std::array<SurfaceEcho, kept>& tally, const SurfaceEcho& echo) {
  SurfaceEcho* free = nullptr;
  for (SurfaceEcho& held : tally) {
    if (held.surface == echo.surface) {
      held.energy += echo.energy;
      held.elevation_moment += echo.elevation_moment;
      held.elevation_square += echo.elevation_square;
      return;
    }
    if (held.surface == kNoSurface && free == nullptr) {
      free = &held;
    }
  }
  if (free != nullptr) {
    *free = echo;
    return;
  }
  // Everybody's elevations stay what they are: sums shrink together.
  const auto lose = [](SurfaceEcho& loser, float loss) {
    const float rest = loser.energy > loss ? (loser.energy - loss) / loser.energy : 0.0F;
    loser.energy *= rest;
    loser.elevation_moment *= rest;
    loser.elevation_square *= rest;
    if (rest == 0) {
      loser = {};
    }
  };
  float loss = echo.energy;
  for (const SurfaceEcho& held : tally) {
    loss = std::min(loss, held.energy);
  }
  SurfaceEcho left = echo;
  lose(left, loss);
  for (SurfaceEcho& held : tally) {
    lose(held, loss);
  }
  if (left.surface != kNoSurface) {
    *std::ranges::find(tally, kNoSurface, &SurfaceEcho::surface) = left;
  }
}

/// Adds a surface's echo, of solid angle `weight`, to the tally of a cell that has the label `leader` so far: as long
/// as it has none its tally means nothing.
inline void tally(const SurfaceEcho& echo, float weight, SurfaceLabel leader, SurfaceTally& tally) {
  if (leader == kNoSurface && weight > 0) {
    tally = {};
    tally[0] = echo.energy > 0 ? echo : SurfaceEcho{};
  } else if (echo.energy > 0) {
    add_surface(tally, echo);
  }
}

}  // namespace insonify
