// coherent_share.h -- coherent share of the reflection by rough surfaces.

#pragma once

#include <cmath>

#include "echo/model/ping_plan.h"

namespace insonify {

/// e^-g with the Rayleigh parameter g = 4 k^2 h^2 cos^2: Brekhovskikh and Lysanov, Fundamentals of Ocean Acoustics, ch.
/// 9. With rough_mirrors it is 0.
/// @param cosine  Cosine of the angle of incidence, of either sign.
inline double coherent_share(const PingPlan& plan, SurfaceLabel surface, double cosine) {
  return plan.rough_mirrors ? 0 : std::exp(-plan.scatter.scattering(surface).roughness * cosine * cosine);
}

/// Coherent reflectance |R|^2 e^-g.
/// @param cosine  Cosine of the angle of incidence, 0..1.
inline double coherent_reflectance(const PingPlan& plan, SurfaceLabel surface, double cosine) {
  return plan.scatter.scattering(surface).reflectance(cosine) * coherent_share(plan, surface, cosine);
}

}  // namespace insonify
