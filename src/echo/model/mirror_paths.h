// mirror_paths.h -- echoes by way of one mirror, in the `calibrated` model.

#pragma once

#include "echo/grid/echo.h"
#include "echo/model/scatter_table.h"

namespace insonify {

inline constexpr int kPathLanes = 16;

/// Paths from the sonar by way of a mirror, the first surface, to a second one. Each stands for three echoes: from the
/// second straight back to the sonar; its reciprocal, straight out and back by the mirror; and back the way it came.
struct alignas(64) MirrorPaths {
  float reflectance[kPathLanes];  ///< |R|^2 of the mirror, its texture's share included.
  float share[kPathLanes];        ///< MirrorFacet::share of the facet that sends sound there and takes it back; else 1.
  float steepness[kPathLanes];    ///< 1 / (2 s^2) of the mirror.
  float there[kPathLanes];        ///< Out and across [m].
  float spread[kPathLanes];       ///< Area of a tube of sound at the second surface over that by a plane mirror.
  float back[kPathLanes];         ///< From the second surface straight to the sonar [m].

  // Cosines between the second surface's unit normal and: the way it was reached, the way straight back, and the half
  // vector of both; of one sign where both ways are on one side.
  float in[kPathLanes], out[kPathLanes], half[kPathLanes];
  float texture[kPathLanes];         ///< Of the second surface: ReliefPoint::reflectivity.
  SurfaceLabel surface[kPathLanes];  ///< The second.
};

/// Echo intensities relative to the source's at 1 m per unit of the launched solid angle; 0 where nothing was met.
struct alignas(64) MirrorPowers {
  float once[kPathLanes];   ///< By the mirror one way: of each of the two reciprocal echoes.
  float twice[kPathLanes];  ///< By the mirror both ways.
};

/// Sound that leaves in dOmega falls on dA = dOmega there'^2 / in whatever the mirror's curvature, so that
///
///     once  = share |R|^2 s_b(in, out) / (in back^2)  e^(-2 gamma (there + back))
///     twice = share |R|^4 s_b(in, in) / (in there^2 spread)  e^(-4 gamma there)
///
/// with s_b of PHYSICS 0, its lobe taken at the half vector and cos^2 as in x out. On its way back `twice` spreads as
/// on its way out, by reciprocity; near a focus no less than to a hundredth of what it would by a plane mirror.
///
/// Where both surfaces glint, their reciprocal path is also found the other way round, with the second for a mirror. So
/// the lobe counts in `once` only where the mirror is the smoother of the two, and half where they are alike: a corner
/// of two planes is heard as its one image.
void fill_mirror_powers(const ScatterTable& scatter, float neper_per_metre, const MirrorPaths& paths,
                        MirrorPowers& powers);

}  // namespace insonify
