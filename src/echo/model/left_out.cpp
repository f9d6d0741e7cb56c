// left_out.cpp -- clears the echoes of hits on thin parts, and removes the coherent share from the lobes of plane
// faces.

#include "echo/model/left_out.h"

#include <algorithm>
#include <cmath>

#include "base/vector_math.h"
#include "echo/laws/laws.h"

namespace insonify {
namespace {

// The values of one instance; null: none.
template <typename Value>
const Value* of(const std::vector<LeftOut::ByTriangle<Value>>& values, std::uint16_t instance) {
  return instance < values.size() && values[instance] != nullptr ? values[instance]->data() : nullptr;
}

// Takes the coherent share of the lobe of facets off the echoes of samples on one material, where glinting[i] is 1. The
// lobe is that of ScatterTable::fill_powers().
struct GlintLobe {
  Scatterer surface;
  float coherent;   // 1, or 0 with rough mirrors.
  float roughness;  // Scattering::roughness
  float neper_per_metre;
};
INSONIFY_VECTOR_CLONES
void take_off_lobe(int count, const GlintLobe& of_material, const float* __restrict__ glinting,
                   const float* __restrict__ facing, const float* __restrict__ range, float* __restrict__ power) {
  const GlintLobe own = of_material;
  for (int i = 0; i < count; ++i) {
    const float coherence = own.coherent * coherent_share(own.roughness, std::abs(facing[i]));
    const float rest =
        without_coherent_glint(power[i], own.surface, coherence, facing[i], own.neper_per_metre, range[i]);
    power[i] = glinting[i] > 0 ? rest : power[i];
  }
}

// The same for the samples of rows [first, last), which are on one surface.
void take_off_lobes(const FlatPlan& plan, const std::uint8_t* glinting, int first, int last, const HitColumn& hits) {
  constexpr int kBlock = 64;
  const ScatterTable::Laws laws = plan.scatter.laws();
  const SurfaceLabel surface = hits.surface[first];
  const GlintLobe own{.surface = laws.scatterer(laws.index_of(surface)),
                      .coherent = plan.rough_mirrors ? 0.0F : 1.0F,
                      .roughness = static_cast<float>(plan.scatter.scattering(surface).roughness),
                      .neper_per_metre = plan.neper_per_metre};
  for (int row = first; row < last; row += kBlock) {
    const int count = std::min(kBlock, last - row);
    float glints[kBlock];
    for (int i = 0; i < count; ++i) {
      glints[i] = glinting[hits.triangle[row + i]] != 0 ? 1.0F : 0.0F;
    }
    take_off_lobe(count, own, glints, &hits.facing[row], &hits.range[row], &hits.power[row]);
  }
}

}  // namespace

float thin_per_metre(const FlatPlan& plan) {
  constexpr float kSamples = 4;
  const Lattice& lattice = plan.lattice;
  const int middle = lattice.columns / 2;
  const float* const elevation = lattice.elevations(middle);
  const float rows = lattice.rows > 1
                         ? (elevation[lattice.rows - 1] - elevation[0]) / static_cast<float>(lattice.rows - 1)
                         : static_cast<float>(plan.elevation_aperture);
  return kSamples * std::max(rows, lattice.column_width[middle]);
}

void leave_out(const LeftOut& left_out, const FlatPlan& plan, const HitColumn& hits) {
  const float per_metre = thin_per_metre(plan);
  const int rows = std::min(hits.rows, plan.lattice.rows);
  for (int first = 0, last = 0; first < rows; first = last) {
    const SurfaceLabel surface = hits.surface[first];
    while (last < rows && hits.surface[last] == surface) {
      ++last;
    }
    if (surface == kNoSurface) {
      continue;
    }
    const std::uint8_t* const glinting = of(left_out.glinting, instance_of(surface));
    if (glinting != nullptr && plan.model == EchoModel::kCalibrated) {
      take_off_lobes(plan, glinting, first, last, hits);
    }
    const float* const thickness = of(left_out.thickness, instance_of(surface));
    for (int row = first; thickness != nullptr && row < last; ++row) {
      if (thickness[hits.triangle[row]] < per_metre * hits.range[row]) {
        hits.power[row] = 0;
      }
    }
  }
}

}  // namespace insonify
