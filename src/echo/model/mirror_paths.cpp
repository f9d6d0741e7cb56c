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

INSONIFY_VECTOR_CLONES
void fill(const ScatterTable::Laws laws, float neper_per_metre, const MirrorPaths& __restrict__ paths,
          MirrorPowers& __restrict__ powers) {
  for (int lane = 0; lane < kPathLanes; ++lane) {
    const std::uint32_t material = laws.index_of(paths.surface[lane]);
    const float mu = laws.lambert[material], lobe = laws.lobe[material], steepness = laws.steepness[material];
    const float in = held(std::abs(paths.in[lane])), out = std::abs(paths.out[lane]);
    const float half = held(std::abs(paths.half[lane]));
    const float there = paths.there[lane], back = paths.back[lane];
    const float spread = paths.spread[lane] < kLeastSpread ? kLeastSpread : paths.spread[lane];
    const float once_reflected =
        paths.share[lane] * paths.reflectance[lane] * paths.texture[lane] * paths.texture[lane];

    const float smoother = paths.steepness[lane] > steepness ? 1.0F : paths.steepness[lane] < steepness ? 0.0F : 0.5F;
    const float glint_across = smoother * facet_lobe(lobe, steepness, half) / in;
    const float glint_along = facet_lobe(lobe, steepness, in) / in;
    const float once =
        once_reflected * (mu * out + glint_across) / (back * back) * fast_exp(-2 * neper_per_metre * (there + back));
    const float twice = once_reflected * paths.reflectance[lane] * (mu * in + glint_along) / (there * there * spread) *
                        fast_exp(-4 * neper_per_metre * there);
    const bool same_side = paths.in[lane] * paths.out[lane] > 0;
    const bool met = paths.surface[lane] != kNoSurface;
    powers.once[lane] = met & same_side ? once : 0.0F;
    powers.twice[lane] = met ? twice : 0.0F;
  }
}

}  // namespace

void fill_mirror_powers(const ScatterTable& scatter, float neper_per_metre, const MirrorPaths& paths,
                        MirrorPowers& powers) {
  fill(scatter.laws(), neper_per_metre, paths, powers);
}

}  // namespace insonify
