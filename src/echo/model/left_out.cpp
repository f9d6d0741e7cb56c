// left_out.cpp -- clears the echoes of hits on thin parts, and removes the coherent share from the lobes of plane
// faces.

#include "echo/model/left_out.h"

#include <algorithm>
#include <cmath>

#include "echo/model/coherent_share.h"
#include "echo/model/echo_laws.h"

namespace insonify {
namespace {

// LeftOut of one instance: pointers to its triangles' values, null if it has none.
struct OfInstance {
  const float* thickness = nullptr;
  const std::uint8_t* glinting = nullptr;
};

template <typename Value>
const Value* of(const std::vector<std::vector<Value>>& values, std::uint16_t instance) {
  return instance < values.size() && !values[instance].empty() ? values[instance].data() : nullptr;
}

// Coherent part of the facets' lobe in the echo of a hit, as ScatterTable::fill_powers() computes it.
float coherent_lobe(const PingPlan& plan, SurfaceLabel surface, float cosine, float range) {
  constexpr float kNothingLeft = 16;
  const ScatterTable::Laws laws = plan.scatter.laws();
  const std::uint32_t material = laws.index_of(surface);
  const float held = std::max(cosine, kLeastCosine);
  if ((1 / (held * held) - 1) * laws.steepness[material] > kNothingLeft) {
    return 0;
  }
  const float spread = fast_exp(-4 * plan.neper_per_metre * range) / (range * range);
  return static_cast<float>(coherent_share(plan, surface, double{cosine})) *
         facet_lobe(laws.lobe[material], laws.steepness[material], held) / held * spread;
}

}  // namespace

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

void leave_out(const LeftOut& left_out, const PingPlan& plan, const HitColumn& hits) {
  const float per_metre = thin_per_metre(plan);
  const bool calibrated = plan.model == EchoModel::kCalibrated;
  SurfaceLabel surface = kNoSurface;
  OfInstance own;
  for (int row = 0; row < std::min(hits.rows, plan.lattice.rows); ++row) {
    if (hits.surface[row] != surface) {
      surface = hits.surface[row];
      own = {};
      if (surface != kNoSurface) {
        own = {of(left_out.thickness, instance_of(surface)), of(left_out.glinting, instance_of(surface))};
      }
    }
    if (own.thickness != nullptr && own.thickness[hits.triangle[row]] < per_metre * hits.range[row]) {
      hits.power[row] = 0;
    } else if (calibrated && own.glinting != nullptr && own.glinting[hits.triangle[row]] != 0) {
      const float lobe = coherent_lobe(plan, surface, std::abs(hits.facing[row]), hits.range[row]);
      hits.power[row] = std::max(hits.power[row] - lobe, 0.0F);
    }
  }
}

}  // namespace insonify
