// coherent_share.h -- coherent share of the reflection by rough surfaces.

#pragma once

#include "echo/laws/laws.h"
#include "echo/model/flat_plan.h"

namespace insonify {

/// precise::coherent_share() of a surface; with rough_mirrors 0.
/// @param cosine  Cosine of the angle of incidence, of either sign.
inline double coherent_share(const FlatPlan& plan, SurfaceLabel surface, double cosine) {
  return plan.rough_mirrors ? 0 : precise::coherent_share(plan.scatter.scattering(surface).roughness, cosine);
}

/// Coherent reflectance |R|^2 e^-g.
/// @param cosine  Cosine of the angle of incidence, 0..1.
inline double coherent_reflectance(const FlatPlan& plan, SurfaceLabel surface, double cosine) {
  return plan.scatter.scattering(surface).reflectance(cosine) * coherent_share(plan, surface, cosine);
}

}  // namespace insonify
