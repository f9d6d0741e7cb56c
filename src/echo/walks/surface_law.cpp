// surface_law.cpp -- densities of scattered sound, and sampling of directions from them.

#include "echo/walks/surface_law.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "echo/laws/laws.h"

namespace insonify {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

// Orthonormal basis with the normal: Duff et al., "Building an orthonormal basis, revisited", JCGT 6 (2017).
struct Tangents {
  Vec3f along, across;

  explicit Tangents(const Vec3f& n) {
    const float sign = std::copysign(1.0F, n.z()), a = -1 / (sign + n.z()), b = n.x() * n.y() * a;
    along = {1 + sign * n.x() * n.x() * a, sign * b, -sign * n.x()};
    across = {b, sign + n.y() * n.y() * a, -n.y()};
  }
};

// Samples the density cos / pi about the normal: a point of the unit disc projected onto the hemisphere (Malley's
// method).
Vec3f lambert_direction(const Vec3f& n, float radius, float turn) {
  const Tangents tangents(n);
  const float sine = std::sqrt(radius), angle = 2 * kPi * turn;
  return (sine * std::cos(angle) * tangents.along + sine * std::sin(angle) * tangents.across +
          std::sqrt(1 - radius) * n)
      .normalized();
}

// Mirrors a direction at the surface.
Vec3f folded(const Vec3f& normal, const Vec3f& direction) {
  return direction - 2 * direction.dot(normal) * normal;
}

// Density of directions reflected by facets [1/sr], before those into the surface are mirrored at it.
float facet_density(const SurfaceLaw& law, const Vec3f& normal, const Vec3f& in, const Vec3f& out) {
  const Vec3f half = (out - in).normalized();
  const float upright = half.dot(normal);
  if (!(upright > 0) || !(half.dot(in) < 0)) {
    return 0;
  }
  const float held = std::max(-in.dot(normal), kLeastFacing);
  const float secant_square = 1 / (upright * upright), variance = law.slope * law.slope;
  const float facets = secant_square * secant_square * std::exp((1 - secant_square) / (2 * variance));
  return law.reflected_by_facet(-half.dot(in)) / (8 * kPi * variance) * facets * facet_masking(held, law.slope) / held;
}

// Density with which draw() draws directions reflected by facets [1/sr], before those into the surface are mirrored at
// it: that of Gaussian slopes, 1/cos^3 of them per solid angle of the facet's normal, which is 1/(4 cos) of that of the
// direction.
float drawn_density(const SurfaceLaw& law, const Vec3f& normal, const Vec3f& in, const Vec3f& out) {
  const Vec3f half = (out - in).normalized();
  const float upright = half.dot(normal), met = -half.dot(in);
  if (!(upright > 0) || !(met > 0)) {
    return 0;
  }
  const float secant = 1 / upright, variance = law.slope * law.slope;
  return secant * secant * secant * std::exp((1 - secant * secant) / (2 * variance)) / (8 * kPi * variance * met);
}

}  // namespace

SurfaceLaw SurfaceLaw::of(const Scattering& scattering, float texture, float cosine) {
  const double incidence = std::min(std::abs(double{cosine}), 1.0);
  const double slope = std::max(scattering.rms_slope, kLeastWalkSlope);
  const double intensity = double{texture} * double{texture};
  const double diffuse = intensity * std::numbers::pi * scattering.lambert;
  const double mirrored = intensity * scattering.reflectance(incidence);
  const double most = std::max(1.0, diffuse + mirrored);
  SurfaceLaw law{.diffuse = static_cast<float>(diffuse / most),
                 .mirrored = static_cast<float>(mirrored / most),
                 .coherent = static_cast<float>(scattering.mirror_share(incidence)),
                 .slope = static_cast<float>(slope)};
  if (scattering.by_angle) {
    law.reflectance = &scattering.by_angle->reflectance;
    law.scale = static_cast<float>(intensity / most);
    // The largest of what most facets reflect: those tilted by up to twice the slope, to either side.
    const double reach = 1 / std::sqrt(1 + 4 * slope * slope);
    const double towards = reach * incidence, aside = 2 * slope * reach * std::sqrt(1 - incidence * incidence);
    for (const double tilted : {towards + aside, towards - aside}) {
      law.mirrored = std::max(law.mirrored, law.reflected_by_facet(static_cast<float>(std::clamp(tilted, 0.0, 1.0))));
    }
  }
  return law;
}

float SurfaceLaw::reflected_by_facet(float cosine) const {
  return reflectance ? std::min(scale * static_cast<float>(reflectance->at(double{cosine})), 1 - diffuse) : mirrored;
}

float SurfaceLaw::diffuse_into(const Vec3f& normal, const Vec3f& out) const {
  return diffuse / kPi * std::max(normal.dot(out), 0.0F);
}

float SurfaceLaw::mirrored_into(const Vec3f& normal, const Vec3f& in, const Vec3f& out) const {
  if (mirrored == 0 || !(normal.dot(out) > 0)) {
    return 0;
  }
  return facet_density(*this, normal, in, out) + facet_density(*this, normal, in, folded(normal, out));
}

float SurfaceLaw::density(const Vec3f& normal, const Vec3f& in, const Vec3f& out) const {
  const float both = diffuse + mirrored;
  if (!(both > 0) || !(normal.dot(out) > 0)) {
    return 0;
  }
  const float by_facets =
      mirrored > 0 ? drawn_density(*this, normal, in, out) + drawn_density(*this, normal, in, folded(normal, out)) : 0;
  return (diffuse / kPi * normal.dot(out) + mirrored * by_facets) / both;
}

SurfaceLaw::Next SurfaceLaw::draw(const Vec3f& normal, const Vec3f& in, float choice, float radius, float turn) const {
  const float both = diffuse + mirrored;
  if (choice * both < diffuse) {
    return {.direction = lambert_direction(normal, radius, turn), .share = both};
  }
  // Slopes of a facet (Box and Muller), and its weight: see mirror_facet().
  const Tangents tangents(normal);
  const float reach = slope * std::sqrt(-2 * std::log(radius)), angle = 2 * kPi * turn;
  const Vec3f tilted = normal + reach * std::cos(angle) * tangents.along + reach * std::sin(angle) * tangents.across;
  const float upright = 1 / tilted.norm();
  const Vec3f facet = upright * tilted;
  const float met = -in.dot(facet), held = std::max(-in.dot(normal), kLeastFacing);
  const Vec3f out = (in + 2 * met * facet).normalized();
  const float reflected = met > 0 && mirrored > 0 ? reflected_by_facet(std::min(met, 1.0F)) / mirrored : 0.0F;
  return {.direction = out.dot(normal) > 0 ? out : folded(normal, out),
          .share = both * reflected * met / (held * upright) * facet_masking(held, slope),
          .mirrored = choice * both < diffuse + coherent * mirrored};
}

}  // namespace insonify
