// mirror_paths.cpp -- intensities of sixteen mirror paths in one vector loop.

#include "echo/mirror/mirror_paths.h"

#include <cmath>

#include "base/vector_math.h"

namespace insonify {
namespace {

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
    const float in = held_cosine(paths.arriving[lane]), out = std::abs(paths.leaving[lane]), facet = paths.facet[lane];
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
    const Scatterer towards = laws.scatterer(laws.index_of(paths.surface[lane]));
    const float share = lobe_share(paths.steepness[lane], towards.steepness);
    SecondSurface second = {towards, 0, towards.lambert, share * towards.lobe};
    if constexpr (by_angle) {
      second.on_top = angles->backscatter[lane];
      second.mu += angles->diffuse_in[lane] * angles->diffuse_out[lane];
      second.lobe = lobe_by_angle(angles->facets[lane], angles->reflectance[lane], angles->mirrored[lane], share);
    }
    const MirrorIntensities intensities = mirror_intensities(paths.at(lane), second, neper_per_metre);
    const bool met = paths.surface[lane] != kNoSurface;
    powers.once[lane] = met ? intensities.once : 0.0F;
    powers.twice[lane] = met ? intensities.twice : 0.0F;
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
