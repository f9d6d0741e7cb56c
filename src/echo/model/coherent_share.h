// coherent_share.h -- what rough mirrors reflect as smooth ones.

#pragma once

#include <cmath>

#include "echo/model/ping_plan.h"

namespace insonify {

/// Share of the sound that mirrors reflect (ScatterTable::mirrored()) that goes as by a smooth one: e^-g with the
/// Rayleigh parameter g = 4 k^2 h^2 cos^2: Brekhovskikh and Lysanov, Fundamentals of Ocean Acoustics, ch. 9; 1 where
/// facets are no mirrors, since mirrored() has that share. With rough_mirrors it is 0.
/// @param cosine  Of the angle of incidence, of either sign.
inline double coherent_share(const PingPlan& plan, SurfaceLabel surface, double cosine) {
  return std::exp(-double{plan.mirror_roughness(surface)} * cosine * cosine);
}

/// |R|^2 e^-g of any surface.
inline double coherent_reflectance(const PingPlan& plan, SurfaceLabel surface, double cosine) {
  return double{plan.scatter.mirrored(surface, static_cast<float>(cosine))} * coherent_share(plan, surface, cosine);
}

}  // namespace insonify
