// paper_echoes.h -- what a hit sends back in the `paper` model, and which hits are worth following to a second surface.

#pragma once

#include <span>

#include "echo/deposit.h"
#include "echo/echo.h"
#include "echo/ping_plan.h"

namespace insonify {

/// Sets the power of each hit of a measured column: S(|cos(incidence)| x reflectivity x absorption of pressure there
/// and back). Paper, sections "Rasterized reflections" and "Unified reflections"; PHYSICS: e^(-2 gamma r) is the
/// two-way loss of a pressure amplitude.
/// @param reflectivity  Of each of the scene's materials.
void shade_column(const PingPlan& plan, std::span<const float> reflectivity, HitColumn& hits);

/// What one hit would send on towards a second surface: its own strength, an upper bound of that of the echo.
float onward_strength(const PingPlan& plan, float incidence, float reflectivity, float range);

/// Whether a hit's onward ray is traced, and how many such hits it then stands for: 0 when it is not. With `all`
/// always 1. With `selective` a hit whose echo can be strong is always traced, a weaker one with a probability in
/// proportion, and then counts for all of its kind, so that the sums of energy and weight stay unbiased. The lots are
/// drawn from a low-discrepancy lattice (Roberts' R2 sequence) turned by the seed, so that they lie evenly over a
/// surface and a still scene gives the same ping twice.
float selection_weight(const PingPlan& plan, int column, int row, float onward);

/// The secondary echo: S of both surfaces' strengths and of the absorption along the whole path.
/// @param onward        onward_strength() of the first hit.
/// @param path_length   Out, across and back [m].
float secondary_power(const PingPlan& plan, float onward, float incidence, float reflectivity, float first_range,
                      float path_length);

/// Samples in the sector that a row stands for: half of the intervals on both sides [sr].
inline float sample_weight(const Lattice& lattice, int column, int row) {
  const float* interval = lattice.intervals(column);
  const int rows = lattice.rows;
  const float below = row == 0 ? interval[0] : 0.5F * interval[row];
  const float above = row + 1 == rows ? interval[rows] : 0.5F * interval[row + 1];
  return (below + above) * lattice.column_width[column];
}

}  // namespace insonify
