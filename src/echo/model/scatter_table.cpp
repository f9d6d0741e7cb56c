// scatter_table.cpp -- intensities of the primary echoes of a column, in one vector loop.

#include "echo/model/scatter_table.h"

#include <algorithm>
#include <cmath>

#include "base/vector_math.h"
#include "echo/laws/laws.h"
#include "echo/model/hit_column.h"

namespace insonify {
namespace {

// Reads one of the tables of AngularScattering for each sample. A loop of its own: within a longer one, compilers
// branch and do not vectorise it.
// @param stride  Values per material.
INSONIFY_VECTOR_CLONES
void look_up_rows(int rows, const float* by_angle, std::uint32_t stride, std::uint32_t table, std::uint32_t nothing,
                  const SurfaceLabel* __restrict__ surface, const float* __restrict__ facing,
                  float* __restrict__ values) {
  for (int row = 0; row < rows; ++row) {
    const std::uint32_t own = surface[row] & 0xffffU;  // material_of()
    const std::uint32_t material = own < nothing ? own : nothing;
    values[row] = ScatterTable::at_angle(by_angle, stride * material + table, std::abs(facing[row]));
  }
}

// If `on_top`, `power` holds what an AngularScattering adds to both laws.
template <bool on_top>
[[gnu::always_inline]] inline void scatter_rows(int rows, const ScatterTable::Laws& laws, float neper_per_metre,
                                                const SurfaceLabel* __restrict__ surface,
                                                const float* __restrict__ facing, const float* __restrict__ range,
                                                float* __restrict__ power) {
  for (int row = 0; row < rows; ++row) {
    const Scatterer own = laws.scatterer(laws.index_of(surface[row]));
    power[row] = primary_intensity(own.lambert, glint_of(own, facing[row]), on_top ? power[row] : 0.0F, facing[row],
                                   neper_per_metre, range[row]);
  }
}

// The same where the normal turns within the footprints.
template <bool on_top>
[[gnu::always_inline]] inline void scatter_curved_rows(int rows, const ScatterTable::Laws& laws, float neper_per_metre,
                                                       const HitColumn& hits, float* __restrict__ power) {
  const SurfaceLabel* const surface = hits.surface;
  const float *const range = hits.range, *const facing = hits.facing;
  const float *const dx = hits.direction_x, *const dy = hits.direction_y, *const dz = hits.direction_z;
  const float *const nx = hits.normal_x, *const ny = hits.normal_y, *const nz = hits.normal_z;
  const float *const ux = hits.turn_up_x, *const uy = hits.turn_up_y, *const uz = hits.turn_up_z;
  const float *const vx = hits.turn_side_x, *const vy = hits.turn_side_y, *const vz = hits.turn_side_z;
  for (int row = 0; row < rows; ++row) {
    const Scatterer own = laws.scatterer(laws.index_of(surface[row]));
    const TurnProducts turns = turn_products({ux[row], uy[row], uz[row]}, {vx[row], vy[row], vz[row]},
                                             {dx[row], dy[row], dz[row]}, {nx[row], ny[row], nz[row]});
    const float glint = widened_glint_of(own, facing[row], widen_lobe(turns, facing[row], own.steepness));
    power[row] =
        primary_intensity(own.lambert, glint, on_top ? power[row] : 0.0F, facing[row], neper_per_metre, range[row]);
  }
}

INSONIFY_VECTOR_CLONES
void scatter(int rows, const ScatterTable::Laws laws, float neper_per_metre, const SurfaceLabel* __restrict__ surface,
             const float* __restrict__ facing, const float* __restrict__ range, float* __restrict__ power) {
  scatter_rows<false>(rows, laws, neper_per_metre, surface, facing, range, power);
}

INSONIFY_VECTOR_CLONES
void scatter_on_top(int rows, const ScatterTable::Laws laws, float neper_per_metre,
                    const SurfaceLabel* __restrict__ surface, const float* __restrict__ facing,
                    const float* __restrict__ range, float* __restrict__ power) {
  scatter_rows<true>(rows, laws, neper_per_metre, surface, facing, range, power);
}

INSONIFY_VECTOR_CLONES
void scatter_curved(int rows, const ScatterTable::Laws laws, float neper_per_metre, const HitColumn& hits,
                    float* __restrict__ power) {
  scatter_curved_rows<false>(rows, laws, neper_per_metre, hits, power);
}

INSONIFY_VECTOR_CLONES
void scatter_curved_on_top(int rows, const ScatterTable::Laws laws, float neper_per_metre, const HitColumn& hits,
                           float* __restrict__ power) {
  scatter_curved_rows<true>(rows, laws, neper_per_metre, hits, power);
}

INSONIFY_VECTOR_CLONES
void add_relief(int rows, const HitColumn& hits, float* __restrict__ power) {
  const float *const dx = hits.direction_x, *const dy = hits.direction_y, *const dz = hits.direction_z;
  const float *const gx = hits.gradient_x, *const gy = hits.gradient_y, *const gz = hits.gradient_z;
  const float *const facing = hits.facing, *const texture = hits.texture;
  for (int row = 0; row < rows; ++row) {
    const float share = facet_share({gx[row], gy[row], gz[row]}, {dx[row], dy[row], dz[row]}, facing[row]);
    power[row] *= texture[row] * texture[row] * share;
  }
}

INSONIFY_VECTOR_CLONES
void look_up_constants(int rows, const float* constants, std::uint32_t nothing,
                       const SurfaceLabel* __restrict__ surface, float* __restrict__ mirrored) {
  for (int row = 0; row < rows; ++row) {
    const std::uint32_t own = surface[row] & 0xffffU;
    mirrored[row] = constants[own < nothing ? own : nothing];
  }
}

void append(const AngleTable& table, std::vector<float>& values) {
  for (const double value : table.values()) {
    values.push_back(static_cast<float>(value));
  }
  values.push_back(values.back());
}

// Adds a table, if there is one, and returns its index.
template <typename Value>
std::int32_t add(const std::shared_ptr<const Value>& value, std::vector<Value>& values) {
  if (!value) {
    return -1;
  }
  values.push_back(*value);
  return static_cast<std::int32_t>(values.size()) - 1;
}

}  // namespace

ScatterTable::ScatterTable(std::span<const Material> materials, double frequency, bool facets_mirror) {
  std::vector<Scattering> scatterings;
  for (const Material& material : materials) {
    Scattering scattering = material.scattering(frequency);
    scattering.facets_mirror |= facets_mirror;
    const precise::Scatterer terms =
        precise::scatterer(scattering.lambert, scattering.reflection, scattering.rms_slope);
    mirrored_.push_back(static_cast<float>(scattering.reflection * scattering.reflection));
    lambert_.push_back(static_cast<float>(terms.lambert));
    lobe_.push_back(static_cast<float>(terms.lobe));
    steepness_.push_back(static_cast<float>(terms.steepness));
    roughness_.push_back(scattering.facets_mirror ? static_cast<float>(scattering.roughness) : 0.0F);
    any_rough |= roughness_.back() > 0;
    facets_.push_back(static_cast<float>(precise::scatterer(0, 1, scattering.rms_slope).lobe));
    surfaces_.push_back({scattering.lambert, scattering.reflection, scattering.rms_slope, scattering.roughness,
                         scattering.facets_mirror, add(scattering.by_angle, angular_),
                         add(scattering.passed, passes_)});
    scatterings.push_back(std::move(scattering));
  }
  nothing = static_cast<std::uint32_t>(scatterings.size());
  for (auto* values : {&mirrored_, &lambert_, &lobe_, &steepness_, &facets_}) {
    values->push_back(0);
  }
  if (std::ranges::any_of(scatterings, [](const Scattering& scattering) {
        return scattering.by_angle != nullptr || scattering.mirror_share(1) < 1;
      })) {
    for (const Scattering& scattering : scatterings) {
      append(AngleTable([&](double cosine) { return scattering.reflectance(cosine); }), by_angle_);
      append(scattering.by_angle ? scattering.by_angle->backscatter : AngleTable(), by_angle_);
      append(scattering.by_angle ? scattering.by_angle->diffuse : AngleTable(), by_angle_);
      append(
          AngleTable([&](double cosine) { return scattering.reflectance(cosine) * scattering.mirror_share(cosine); }),
          by_angle_);
      any_on_top |= scattering.by_angle && std::ranges::any_of(scattering.by_angle->backscatter.values(),
                                                               [](double value) { return value != 0; });
    }
    by_angle_.resize(by_angle_.size() + kAngleStride, 0);
  }
  if (std::ranges::any_of(scatterings, [](const Scattering& scattering) { return scattering.passed != nullptr; })) {
    for (const Scattering& scattering : scatterings) {
      append(scattering.passed ? *scattering.passed : AngleTable(), passed_);
    }
    passed_.resize(passed_.size() + kAngleNodes, 0);
  }
}

void ScatterTable::fill_passed(int rows, const SurfaceLabel* surface, const float* facing, float* passed) const {
  look_up_rows(rows, passed_.data(), kAngleNodes, 0, nothing, surface, facing, passed);
}

void ScatterTable::fill_mirrored(int rows, const SurfaceLabel* surface, const float* facing, float* mirrored) const {
  if (by_angle_.empty()) {
    look_up_constants(rows, mirrored_.data(), nothing, surface, mirrored);
  } else {
    look_up_rows(rows, by_angle_.data(), kAngleStride, kMirrored, nothing, surface, facing, mirrored);
  }
}

void ScatterTable::fill_powers(int rows, float neper_per_metre, const HitColumn& hits) const {
  if (any_on_top) {
    look_up_rows(rows, by_angle_.data(), kAngleStride, kBackscatter, nothing, hits.surface, hits.facing, hits.power);
  }
  if (hits.curved) {
    (any_on_top ? scatter_curved_on_top : scatter_curved)(rows, laws(), neper_per_metre, hits, hits.power);
  } else {
    (any_on_top ? scatter_on_top : scatter)(rows, laws(), neper_per_metre, hits.surface, hits.facing, hits.range,
                                            hits.power);
  }
  if (hits.has_relief) {
    add_relief(rows, hits, hits.power);
  }
}

}  // namespace insonify
