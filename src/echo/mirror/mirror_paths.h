// mirror_paths.h -- echoes over a mirror in the calibrated model, sixteen paths at a time.

#pragma once

#include "echo/grid/echo.h"
#include "echo/laws/laws.h"
#include "echo/model/scatter_table.h"

namespace insonify {

inline constexpr int kPathLanes = 16;

/// MirrorPath of sixteen paths.
struct alignas(64) MirrorPaths {
  float reflectance[kPathLanes];  ///< |R|^2 of the mirror at the angle of incidence, times its texture squared.
  float share[kPathLanes];        ///< As in MirrorPath.
  float steepness[kPathLanes];    ///< Scatterer::steepness of the mirror.
  float there[kPathLanes];        ///< [m]
  float spread[kPathLanes];       ///< As in MirrorPath.
  float returned[kPathLanes];     ///< As in MirrorPath.
  float back[kPathLanes];         ///< [m]
  float arriving[kPathLanes], leaving[kPathLanes], between[kPathLanes], facet[kPathLanes];  ///< SecondAngles
  float glint[kPathLanes], variance[kPathLanes], coherence[kPathLanes];                     ///< FacetReturn
  float texture[kPathLanes];         ///< Texture of the second surface.
  SurfaceLabel surface[kPathLanes];  ///< The second surface; kNoSurface where nothing was hit.

  [[nodiscard, gnu::always_inline]] MirrorPath at(int lane) const {
    return {reflectance[lane],
            share[lane],
            there[lane],
            back[lane],
            spread[lane],
            returned[lane],
            {arriving[lane], leaving[lane], between[lane], facet[lane]},
            texture[lane],
            {glint[lane], variance[lane], coherence[lane]}};
  }
};

/// MirrorIntensities of sixteen paths; 0 where nothing was hit.
struct alignas(64) MirrorPowers {
  float once[kPathLanes], twice[kPathLanes];
};

/// mirror_intensities() of sixteen paths.
void fill_mirror_powers(const ScatterTable& scatter, float neper_per_metre, const MirrorPaths& paths,
                        MirrorPowers& powers);

}  // namespace insonify
