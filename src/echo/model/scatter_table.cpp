// scatter_table.cpp -- intensities of the primary echoes of a column, in one vector loop.

#include "echo/model/scatter_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/vector_math.h"
#include "echo/model/echo_laws.h"
#include "echo/model/hit_column.h"

namespace insonify {
namespace {

// Where the cosine of incidence is below kLeastCosine, the lobe is computed at kLeastCosine: nothing is left of it
// there.
INSONIFY_VECTOR_CLONES
void scatter(int rows, const ScatterTable::Laws laws, float neper_per_metre, const SurfaceLabel* __restrict__ surface,
             const float* __restrict__ facing, const float* __restrict__ range, float* __restrict__ power) {
  for (int row = 0; row < rows; ++row) {
    const std::uint32_t material = laws.index_of(surface[row]);
    const float cosine = std::abs(facing[row]);
    const float held = cosine < kLeastCosine ? kLeastCosine : cosine;
    const float glint = facet_lobe(laws.lobe[material], laws.steepness[material], held) / held;
    const float spread = fast_exp(-4 * neper_per_metre * range[row]) / (range[row] * range[row]);
    const float echo = (laws.lambert[material] * cosine + glint) * spread;
    power[row] = (range[row] > 0) & (cosine > 0) ? echo : 0.0F;
  }
}

// The same where the normal turns within the footprints.
INSONIFY_VECTOR_CLONES
void scatter_curved(int rows, const ScatterTable::Laws laws, float neper_per_metre, const HitColumn& hits) {
  const SurfaceLabel* const surface = hits.surface;
  const float *const range = hits.range, *const facing = hits.facing;
  const float *const dx = hits.direction_x, *const dy = hits.direction_y, *const dz = hits.direction_z;
  const float *const nx = hits.normal_x, *const ny = hits.normal_y, *const nz = hits.normal_z;
  const float *const ux = hits.turn_up_x, *const uy = hits.turn_up_y, *const uz = hits.turn_up_z;
  const float *const vx = hits.turn_side_x, *const vy = hits.turn_side_y, *const vz = hits.turn_side_z;
  float* __restrict__ const power = hits.power;
  for (int row = 0; row < rows; ++row) {
    const std::uint32_t material = laws.index_of(surface[row]);
    const TurnProducts<float> turns = {
        ux[row] * ux[row] + uy[row] * uy[row] + uz[row] * uz[row],
        vx[row] * vx[row] + vy[row] * vy[row] + vz[row] * vz[row],
        ux[row] * vx[row] + uy[row] * vy[row] + uz[row] * vz[row],
        ux[row] * dx[row] + uy[row] * dy[row] + uz[row] * dz[row],
        vx[row] * dx[row] + vy[row] * dy[row] + vz[row] * dz[row],
        ux[row] * nx[row] + uy[row] * ny[row] + uz[row] * nz[row],
        vx[row] * nx[row] + vy[row] * ny[row] + vz[row] * nz[row],
    };
    const LobeWidening<float> widening = widen_lobe(turns, facing[row], laws.steepness[material]);
    const float cosine = std::abs(facing[row]);
    const float held = cosine < kLeastCosine ? kLeastCosine : cosine;
    const float glint = widened_lobe(laws.lobe[material], laws.steepness[material], held, widening);
    const float spread = fast_exp(-4 * neper_per_metre * range[row]) / (range[row] * range[row]);
    const float echo = (laws.lambert[material] * cosine + glint) * spread;
    power[row] = (range[row] > 0) & (cosine > 0) ? echo : 0.0F;
  }
}

}  // namespace

ScatterTable::ScatterTable(std::span<const Material> materials, double frequency) {
  for (const Material& material : materials) {
    const Scattering scattering = material.scattering(frequency);
    scattering_.push_back(scattering);
    const double variance = scattering.rms_slope * scattering.rms_slope;
    const double intensity = scattering.reflection * scattering.reflection;
    reflectance_.push_back(static_cast<float>(intensity));
    lambert_.push_back(static_cast<float>(scattering.lambert));
    lobe_.push_back(static_cast<float>(intensity / (8 * std::numbers::pi * variance)));
    steepness_.push_back(static_cast<float>(1 / (2 * variance)));
  }
  for (auto* values : {&lambert_, &lobe_, &steepness_}) {
    values->push_back(0);
  }
}

void ScatterTable::fill_powers(int rows, float neper_per_metre, const HitColumn& hits) const {
  if (hits.curved) {
    scatter_curved(rows, laws(), neper_per_metre, hits);
  } else {
    scatter(rows, laws(), neper_per_metre, hits.surface, hits.facing, hits.range, hits.power);
  }
  if (hits.has_relief) {
    for (int row = 0; row < rows; ++row) {
      hits.power[row] *= hits.texture[row] * hits.texture[row];
    }
  }
}

}  // namespace insonify
