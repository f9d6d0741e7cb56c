// mirror_paths.cpp -- intensities of sixteen mirror paths in one vector loop.

#include "echo/mirror/mirror_paths.h"

#include <cmath>

#include "base/vector_math.h"
#include "echo/model/echo_laws.h"

namespace insonify {
namespace {

constexpr float kTiny = 1e-20F;  // Added to a divisor that may be zero.

[[gnu::always_inline]] inline float held(float cosine) {
  return cosine < kLeastCosine ? kLeastCosine : cosine;
}

// Values of the AngularScattering tables at the second surfaces.
struct AngleLanes {
  float facets[kPathLanes];                             // ScatterTable::Laws::facets
  float reflectance[kPathLanes], mirrored[kPathLanes];  // |R|^2 and its mirrored share, of facets at the half vector.
  float diffuse_in[kPathLanes], diffuse_out[kPathLanes], backscatter[kPathLanes];
};

// In a separate loop, since compilers do not vectorise it inside fill_lanes().
INSONIFY_VECTOR_CLONES
void look_up_lanes(const ScatterTable::Laws laws, const MirrorPaths& __restrict__ paths,
                   AngleLanes& __restrict__ angles) {
  const float* const by_angle = laws.by_angle;
  for (int lane = 0; lane < kPathLanes; ++lane) {
    const std::uint32_t material = laws.index_of(paths.surface[lane]);
    const std::uint32_t tables = ScatterTable::kAngleStride * material;
    angles.facets[lane] = laws.facets[material];
    const float in = held(std::abs(paths.in[lane])), out = std::abs(paths.out[lane]), facet = paths.facet[lane];
    angles.reflectance[lane] = ScatterTable::at_angle(by_angle, tables + ScatterTable::kReflectance, facet);
    angles.mirrored[lane] = ScatterTable::at_angle(by_angle, tables + ScatterTable::kMirrored, facet);
    angles.diffuse_in[lane] = ScatterTable::at_angle(by_angle, tables + ScatterTable::kDiffuse, in);
    angles.diffuse_out[lane] = ScatterTable::at_angle(by_angle, tables + ScatterTable::kDiffuse, out);
    angles.backscatter[lane] = ScatterTable::at_angle(by_angle, tables + ScatterTable::kBackscatter, in);
  }
}

template <bool by_angle>
[[gnu::always_inline]] inline void fill_lanes(const ScatterTable::Laws& laws, const AngleLanes* __restrict__ angles,
                                              float neper_per_metre, const MirrorPaths& __restrict__ paths,
                                              MirrorPowers& __restrict__ powers) {
  for (int lane = 0; lane < kPathLanes; ++lane) {
    const std::uint32_t material = laws.index_of(paths.surface[lane]);
    const float steepness = laws.steepness[material], lobe_back = laws.lobe[material];
    // 1 where the mirror is smoother than the second surface, 0.5 where both are equal, else 0. Without a branch.
    const float smoother = 0.5F * (static_cast<float>(paths.steepness[lane] > steepness) +
                                   static_cast<float>(paths.steepness[lane] >= steepness));
    float mu = laws.lambert[material], lobe = smoother * lobe_back, back_on_top = 0;
    const float in = held(std::abs(paths.in[lane])), out = std::abs(paths.out[lane]);
    const float half = held(std::abs(paths.half[lane]));
    const float there = paths.there[lane], back = paths.back[lane];
    const float spread = paths.spread[lane] < kLeastSpread ? kLeastSpread : paths.spread[lane];
    const float once_reflected =
        paths.share[lane] * paths.reflectance[lane] * paths.texture[lane] * paths.texture[lane];

    if constexpr (by_angle) {
      lobe = angles->facets[lane] * (angles->reflectance[lane] - (1 - smoother) * angles->mirrored[lane]);
      mu += angles->diffuse_in[lane] * angles->diffuse_out[lane];
      back_on_top = angles->backscatter[lane];
    }
    const float glint_across = facet_lobe(lobe, steepness, half) / in;
    const float glint = held(std::abs(paths.glint[lane]));
    const float narrowed = 1 / (1 + 2 * paths.variance[lane] * steepness), coherent = paths.coherent[lane];
    const float glint_along = (coherent * facet_lobe(lobe_back, steepness, glint) +
                               (1 - coherent) * facet_lobe(narrowed * lobe_back, narrowed * steepness, glint)) /
                              in;
    const float once =
        once_reflected * (mu * out + glint_across) / (back * back) * fast_exp(-2 * neper_per_metre * (there + back));
    float lobe_and_more = glint_along + back_on_top;
    if constexpr (by_angle) {
      // The sea reflects less than its facets' lobe: by this factor, also where the lobe is widened.
      const float whole = facet_lobe(lobe_back, steepness, in) / in + kTiny;
      const float less = glint_along * (1 + back_on_top / whole);
      lobe_and_more = back_on_top < 0 ? (less > 0 ? less : 0.0F) : lobe_and_more;
    }
    const float scattered_back = laws.lambert[material] * in + lobe_and_more;
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
  fill_lanes<false>(laws, nullptr, neper_per_metre, paths, powers);
}

INSONIFY_VECTOR_CLONES
void fill_by_angle(const ScatterTable::Laws laws, const AngleLanes& __restrict__ angles, float neper_per_metre,
                   const MirrorPaths& __restrict__ paths, MirrorPowers& __restrict__ powers) {
  fill_lanes<true>(laws, &angles, neper_per_metre, paths, powers);
}

}  // namespace

void fill_mirror_powers(const ScatterTable& scatter, float neper_per_metre, const MirrorPaths& paths,
                        MirrorPowers& powers) {
  const ScatterTable::Laws laws = scatter.laws();
  if (laws.by_angle == nullptr) {
    fill(laws, neper_per_metre, paths, powers);
  } else {
    AngleLanes angles;
    look_up_lanes(laws, paths, angles);
    fill_by_angle(laws, angles, neper_per_metre, paths, powers);
  }
}

}  // namespace insonify
