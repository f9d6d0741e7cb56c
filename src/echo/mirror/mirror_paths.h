// mirror_paths.h -- echoes over a mirror in the calibrated model, sixteen paths at a time.

#pragma once

#include "echo/grid/echo.h"
#include "echo/model/scatter_table.h"

namespace insonify {

inline constexpr int kPathLanes = 16;

/// MirrorPath of sixteen paths, in single precision.
struct alignas(64) MirrorPaths {
  float reflectance[kPathLanes];  ///< |R|^2 of the mirror at the angle of incidence, times its texture squared.
  float share[kPathLanes];        ///< As in MirrorPath.
  float steepness[kPathLanes];    ///< 1 / (2 s^2) of the mirror.
  float there[kPathLanes];        ///< [m]
  float spread[kPathLanes];       ///< Relative to a plane mirror.
  float returned[kPathLanes];     ///< As in MirrorPath.
  float back[kPathLanes];         ///< [m]
  float in[kPathLanes];           ///< Cosines at the second surface.
  float out[kPathLanes];
  float half[kPathLanes];
  float facet[kPathLanes];
  float glint[kPathLanes];           ///< FacetReturn::half; `in` without facets.
  float variance[kPathLanes];        ///< FacetReturn
  float coherent[kPathLanes];        ///< The same.
  float texture[kPathLanes];         ///< Texture of the second surface.
  SurfaceLabel surface[kPathLanes];  ///< The second surface; kNoSurface where nothing was hit.
};

/// MirrorIntensities of sixteen paths; 0 where nothing was hit.
struct alignas(64) MirrorPowers {
  float once[kPathLanes], twice[kPathLanes];
};

/// mirror_intensities() of sixteen paths, in single precision.
void fill_mirror_powers(const ScatterTable& scatter, float neper_per_metre, const MirrorPaths& paths,
                        MirrorPowers& powers);

}  // namespace insonify
