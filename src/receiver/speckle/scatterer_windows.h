// scatterer_windows.h -- loops over the bins of a row that find their windows of the scatterer lattice.

#pragma once

#include <cstdint>

#include "echo/grid/echo_grid.h"

namespace insonify {

/// Windows have kShortest to kShortest kLadder steps. Where the lattice would give fewer or more, one with steps
/// kLadder^n as long is used.
inline constexpr float kShortest = 1.5F;
inline constexpr double kLadder = 1.6;

/// Lowest bits of ScattererRow::patch, which hold n; 0 for the lattice itself.
inline constexpr int kRungBits = 6;

/// Nominal position of a scatterer in its step, which decides whether a window contains it [steps].
inline constexpr float kPlace = 0.5F;

/// Mean elevation of each bin's label [rad]; 0 in bins without one.
void mean_elevations(BinRange bins, const SurfaceLabel* surface, const float* energy, const float* moment,
                     float* elevation);

/// Replaces the values of `bins` by their mean over `half` bins on either side, fewer at the ends.
/// @param sums  Scratch memory, one more than bins.
void smooth(BinRange bins, int half, double* sums, float* values);

/// Coordinates of a point of the surface, in lattice steps, along and up, from range and elevation.
struct Projection {
  float first_range, bin_length;                         ///< [m]
  float ahead_level, ahead_normal, up_level, up_normal;  ///< [steps / m]
};

/// Computes the coordinates of the edges between bins [first, last], from the mean of the neighbouring elevations.
void project_edges(BinRange bins, Projection projection, const float* elevation, float* ahead, float* up);

/// The same where all elevations are 0.
void project_level_edges(BinRange bins, Projection projection, float* ahead, float* up);

/// A coordinate as whole and fractional part, in steps and in layers.
struct Origin {
  std::uint32_t whole;
  float rest;
  float in_layers;     ///< Fractional part of the coordinate in layers.
  std::int32_t layer;  ///< Whole part.
};

struct Windows {
  Origin ahead, up;
  float share;  ///< Window over bin length.
  float layers_per_step;
};

/// Finds the window of each bin of one surface, see ScattererRow. Returns whether any needs another lattice, see
/// kShortest.
bool find_windows(BinRange bins, const Windows& windows, const float* ahead, const float* up, std::uint32_t* patch,
                  std::uint32_t* index, float* begin, float* length);

}  // namespace insonify
