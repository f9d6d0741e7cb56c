// precise_echoes.h -- the laws of the `calibrated` model for materials, in double precision.

#pragma once

#include <cmath>

#include "echo/laws/laws.h"
#include "insonify/scattering.h"

namespace insonify::precise {

inline Scatterer scatterer_of(const Scattering& surface) {
  return scatterer(surface.lambert, surface.reflection, surface.rms_slope);
}

/// |R|^2 that a surface reflects as a mirror.
/// @param cosine  Of the angle of incidence, of either sign.
inline double mirrored_by(const Scattering& surface, double cosine) {
  return surface.reflectance(std::abs(cosine)) * surface.mirror_share(std::abs(cosine));
}

/// @param texture  Factor on the amplitude, ReliefPoint::reflectivity.
inline double primary_intensity_of(const Scattering& surface, double facing, double texture, double neper_per_metre,
                                   double range, LobeWidening widening = {1, 0}) {
  const double on_top = surface.by_angle ? surface.by_angle->backscatter.at(std::abs(facing)) : 0;
  const double glint = widened_glint_of(scatterer_of(surface), facing, widening);
  return texture * texture * primary_intensity(surface.lambert, glint, on_top, facing, neper_per_metre, range);
}

/// @param mirror_slope  Rms slope of the mirror; infinite where the second surface's mirrored share does not count.
inline SecondSurface second_surface_of(const Scattering& surface, const SecondAngles& at, double mirror_slope) {
  const Scatterer towards = scatterer_of(surface);
  const double in = held_cosine(at.arriving),
               share = lobe_share(scatterer(0, 1, mirror_slope).steepness, towards.steepness);
  SecondSurface second{.towards = towards, .on_top = 0, .mu = surface.lambert, .lobe = 0};
  if (surface.by_angle) {
    second.on_top = surface.by_angle->backscatter.at(in);
    second.mu += surface.by_angle->diffuse.at(in) * surface.by_angle->diffuse.at(std::abs(at.leaving));
  }
  second.lobe = lobe_by_angle(scatterer(0, 1, surface.rms_slope).lobe, surface.reflectance(at.facet),
                              mirrored_by(surface, at.facet), share);
  return second;
}

}  // namespace insonify::precise
