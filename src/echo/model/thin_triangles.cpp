// thin_triangles.cpp -- compares thickness with the spacing of the samples.

#include "echo/model/thin_triangles.h"

#include <algorithm>

namespace insonify {

float thin_per_metre(const PingPlan& plan) {
  constexpr float kSamples = 4;
  const Lattice& lattice = plan.lattice;
  const int middle = lattice.columns / 2;
  const float* const elevation = lattice.elevations(middle);
  const float rows = lattice.rows > 1
                         ? (elevation[lattice.rows - 1] - elevation[0]) / static_cast<float>(lattice.rows - 1)
                         : static_cast<float>(plan.sonar.elevation_aperture);
  return kSamples * std::max(rows, lattice.column_width[middle]);
}

void mute_thin(const ThinTriangles& thin, const PingPlan& plan, const HitColumn& hits) {
  const float per_metre = thin_per_metre(plan);
  SurfaceLabel surface = kNoSurface;
  const float* thickness = nullptr;
  for (int row = 0; row < std::min(hits.rows, plan.lattice.rows); ++row) {
    if (hits.surface[row] != surface) {
      surface = hits.surface[row];
      thickness = surface == kNoSurface ? nullptr : thin.of(surface);
    }
    if (thickness != nullptr && thickness[hits.triangle[row]] < per_metre * hits.range[row]) {
      hits.power[row] = 0;
    }
  }
}

}  // namespace insonify
