// echo_laws.cpp -- strengths and intensities from the scattering laws of insonify/acoustics/backscatter.h.

#include "echo/model/echo_laws.h"

#include <algorithm>
#include <cmath>

#include "base/square.h"
#include "insonify/acoustics/backscatter.h"

namespace insonify {
namespace {

// Angle of a direction on either side of a surface from its normal, 0..pi/2. Cosines from single precision may
// exceed 1.
double incidence_of(double cosine) {
  return std::acos(std::min(std::abs(cosine), 1.0));
}

// Backscattering cross section s_b of the second surface towards the mirror: both laws, and what comes on top.
double backscatter_to_mirror(const MirrorPath& path, double in) {
  const Scattering& second = path.second;
  const double incidence = incidence_of(in);
  const double glint = incidence_of(std::max(std::abs(path.glint.value_or(in)), double{kLeastCosine}));
  const double on_top = second.by_angle ? second.by_angle->backscatter.at(in) * in : 0;
  const double lobe =
      path.coherent * facet_backscatter(second.reflection, second.rms_slope, glint) +
      (1 - path.coherent) *
          facet_backscatter(second.reflection, std::sqrt(square(second.rms_slope) + path.variance), glint);
  double added = on_top;
  if (on_top < 0) {  // The sea reflects less than its facets' lobe: by this factor, also where the lobe is widened.
    added = lobe * on_top / facet_backscatter(second.reflection, second.rms_slope, incidence);
  }
  return lambert_backscatter(second.lambert, incidence) + std::max(lobe + added, 0.0);
}

// Diffuse cross section between two directions.
double diffuse_scatter(const Scattering& surface, double in, double out) {
  const double on_top =
      surface.by_angle ? surface.by_angle->diffuse.at(in) * surface.by_angle->diffuse.at(out) * in * out : 0;
  return lambert_scatter(surface.lambert, incidence_of(in), incidence_of(out)) + on_top;
}

// Share of the second surface's lobe that counts in `once`: see mirror_intensities().
double lobe_share(double mirror_slope, double second_slope) {
  if (mirror_slope == second_slope) {
    return 0.5;
  }
  return mirror_slope < second_slope ? 1 : 0;
}

}  // namespace

double paper_strength(double cosine, double reflectivity, double neper_per_metre, double length) {
  return std::abs(cosine) * reflectivity * std::exp(-neper_per_metre * length);
}

double primary_intensity(const Scattering& surface, double cosine, double texture, double neper_per_metre, double range,
                         const LobeWidening<double>& widening) {
  if (cosine == 0) {
    return 0;
  }
  const double incidence = incidence_of(cosine), cosine_square = square(std::cos(incidence));
  const double on_top = surface.by_angle ? surface.by_angle->backscatter.at(std::abs(cosine)) : 0;
  const double diffuse = lambert_backscatter(surface.lambert, incidence) / std::abs(cosine) + on_top;
  const double glint = facet_backscatter(surface.reflection, surface.rms_slope,
                                         incidence_of(std::sqrt(cosine_square + widening.spared))) *
                       std::sqrt(widening.share) /
                       std::sqrt(cosine_square + (1 - widening.share) * (1 - cosine_square));
  return square(texture) * (diffuse + glint) * std::exp(-4 * neper_per_metre * range) / square(range);
}

MirrorIntensities mirror_intensities(const MirrorPath& path, double neper_per_metre) {
  const Scattering& mirror = path.mirror;
  const Scattering& second = path.second;
  const double in = std::max(std::abs(path.in), double{kLeastCosine});
  const double half = std::max(std::abs(path.half), double{kLeastCosine});
  const double spread = std::max(path.spread, double{kLeastSpread});
  const double incidence = std::abs(path.incidence);
  const double reflectance =
      mirror.reflectance(incidence) * mirror.mirror_share(incidence) * square(path.mirror_texture);
  const double reflected = path.share * reflectance * square(path.second_texture);

  MirrorIntensities intensities;
  if (path.in * path.out > 0) {
    const double reflection = std::sqrt(second.reflectance(path.facet));
    const double scattered =
        diffuse_scatter(second, in, std::abs(path.out)) +
        (1 - second.mirror_share(path.facet) * (1 - lobe_share(mirror.rms_slope, second.rms_slope))) *
            facet_scatter(reflection, second.rms_slope, incidence_of(half));
    intensities.once =
        reflected * scattered / (in * square(path.back)) * std::exp(-2 * neper_per_metre * (path.there + path.back));
  }
  intensities.twice = reflected * reflectance * path.returned * backscatter_to_mirror(path, in) /
                      (in * square(path.there) * spread) * std::exp(-4 * neper_per_metre * path.there);
  return intensities;
}

}  // namespace insonify
