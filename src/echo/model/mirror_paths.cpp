// mirror_paths.cpp -- intensities of sixteen mirror paths in one vector loop.

#include "echo/model/mirror_paths.h"

#include <cmath>

#include "base/vector_math.h"
#include "echo/model/echo_laws.h"

namespace insonify {
namespace {

[[gnu::always_inline]] inline float held(float cosine) {
  return cosine < kLeastCosine ? kLeastCosine : cosine;
}

template <bool by_angle>
[[gnu::always_inline]] inline void fill_lanes(const ScatterTable::Laws& laws, float neper_per_metre,
                                              const MirrorPaths& __restrict__ paths,
                                              MirrorPowers& __restrict__ powers) {
  for (int lane = 0; lane < kPathLanes; ++lane) {
    const std::uint32_t material = laws.index_of(paths.surface[lane]);
    const float steepness = laws.steepness[material], lobe_back = laws.lobe[material];
    const float smoother = paths.steepness[lane] > steepness ? 1.0F : paths.steepness[lane] < steepness ? 0.0F : 0.5F;
    float mu = laws.lambert[material], lobe = smoother * lobe_back, back_on_top = 0;
    const float in = held(std::abs(paths.in[lane])), out = std::abs(paths.out[lane]);
    const float half = held(std::abs(paths.half[lane]));
    const float there = paths.there[lane], back = paths.back[lane];
    const float spread = paths.spread[lane] < kLeastSpread ? kLeastSpread : paths.spread[lane];
    const float once_reflected =
        paths.share[lane] * paths.reflectance[lane] * paths.texture[lane] * paths.texture[lane];

    if constexpr (by_angle) {
      const float* tables = laws.by_angle + ScatterTable::kAngleStride * material;
      lobe = laws.facets[material] *
             (ScatterTable::at_angle(tables, paths.facet[lane], ScatterTable::kReflectance) -
              (1 - smoother) * ScatterTable::at_angle(tables, paths.facet[lane], ScatterTable::kMirrored));
      mu += ScatterTable::at_angle(tables, in, ScatterTable::kDiffuse) *
            ScatterTable::at_angle(tables, out, ScatterTable::kDiffuse);
      back_on_top = ScatterTable::at_angle(tables, in, ScatterTable::kBackscatter);
    }
    const float glint_across = facet_lobe(lobe, steepness, half) / in;
    const float glint_along = facet_lobe(lobe_back, steepness, in) / in;
    const float once =
        once_reflected * (mu * out + glint_across) / (back * back) * fast_exp(-2 * neper_per_metre * (there + back));
    const float scattered_back = laws.lambert[material] * in + glint_along + back_on_top;
    const float twice = once_reflected * paths.reflectance[lane] * paths.returned[lane] * scattered_back /
                        (there * there * spread) * fast_exp(-4 * neper_per_metre * there);
    const bool same_side = paths.in[lane] * paths.out[lane] > 0;
    const bool met = paths.surface[lane] != kNoSurface;
    powers.once[lane] = met & same_side ? once : 0.0F;
    powers.twice[lane] = met ? twice : 0.0F;
  }
}

INSONIFY_VECTOR_CLONES
void fill(const ScatterTable::Laws laws, float neper_per_metre, const MirrorPaths& __restrict__ paths,
          MirrorPowers& __restrict__ powers) {
  fill_lanes<false>(laws, neper_per_metre, paths, powers);
}

INSONIFY_VECTOR_CLONES
void fill_by_angle(const ScatterTable::Laws laws, float neper_per_metre, const MirrorPaths& __restrict__ paths,
                   MirrorPowers& __restrict__ powers) {
  fill_lanes<true>(laws, neper_per_metre, paths, powers);
}

}  // namespace

void fill_mirror_powers(const ScatterTable& scatter, float neper_per_metre, const MirrorPaths& paths,
                        MirrorPowers& powers) {
  const ScatterTable::Laws laws = scatter.laws();
  (laws.by_angle != nullptr ? fill_by_angle : fill)(laws, neper_per_metre, paths, powers);
}

}  // namespace insonify
