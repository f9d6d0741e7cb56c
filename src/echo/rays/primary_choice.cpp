// primary_choice.cpp -- cost model of rasterising and ray tracing, fitted to `insonify bench primary`.

#include "echo/rays/primary_choice.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace insonify {
namespace {

// Both functions return the time [ns] that exceeds what a sample takes with either method; see bench/README.md.
double drawing_costs(double triangles, double azimuth_aperture) {
  constexpr double kLookedAt = 8;  // Per triangle, to find out whether it lies in the field of view.
  constexpr double kDrawn = 280;   // Per triangle in the field of view.
  // Objects are mostly in front of a sonar.
  const double in_field = std::min(1.0, azimuth_aperture / std::numbers::pi);
  return triangles * (kLookedAt + kDrawn * in_field);
}

double tracing_costs(double triangles, double samples) {
  return samples * (20 + 0.13 * std::sqrt(triangles));
}

}  // namespace

PrimaryEchoes primary_echoes(PrimaryEchoes asked, double azimuth_aperture, double samples, std::size_t triangle_count,
                             bool can_draw, bool even_rows) {
  if (!can_draw || (asked == PrimaryEchoes::kAuto && !even_rows)) {
    return PrimaryEchoes::kRays;
  }
  if (asked != PrimaryEchoes::kAuto) {
    return asked;
  }
  const auto triangles = static_cast<double>(triangle_count);
  return drawing_costs(triangles, azimuth_aperture) <= tracing_costs(triangles, samples) ? PrimaryEchoes::kRaster
                                                                                         : PrimaryEchoes::kRays;
}

}  // namespace insonify
