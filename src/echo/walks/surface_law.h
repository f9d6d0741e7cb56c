// surface_law.h -- scattering law of a surface for random walks: densities, and sampling of directions.

#pragma once

#include "insonify/geometry.h"
#include "insonify/scattering.h"

namespace insonify {

/// Smallest rms slope of facets for random walks. A smoother surface has such a narrow lobe that connections to the
/// sonar rarely hit it, with very high levels (high variance). Its lobe is widened at equal energy.
inline constexpr double kLeastWalkSlope = 0.1;

/// The laws of acoustics/backscatter.h as shares of the energy that falls on a surface, which may be smaller than 1
/// together: the rest is absorbed. Normals are on the side that the sound comes from.
///
///     diffuse:   pi mu, into `out` with the density cos(out) / pi
///     mirrored:  |R|^2, by facets of Gaussian slopes: into `out` with the density facet_scatter() facet_masking() /
///                cos(in), as mirror_facet() draws them. |R| is that at the angle of incidence on the facet. What a
///                facet reflects into the surface leaves it again: as if the surface without facets reflected it
///
/// A surface whose material would send out more than falls on it sends out exactly that: both shares are reduced by
/// the same factor.
struct SurfaceLaw {
  float diffuse = 0;   ///< Share that is scattered diffusely, 0..1.
  float mirrored = 0;  ///< Share that facets reflect, 0..1; with a `reflectance` about its largest, for draws.
  const AngleTable* reflectance =
      nullptr;  ///< |R|^2 of facets by angle, times `scale`; null: `mirrored` at all angles.
  float scale = 1;
  float coherent = 1;                                 ///< Share of it that other echoes follow, as from a mirror, 0..1.
  float slope = static_cast<float>(kLeastWalkSlope);  ///< Rms slope of the facets along each axis.

  /// @param scattering  Must outlive the law.
  /// @param texture  Factor on the amplitude, ReliefPoint::reflectivity.
  /// @param cosine   Of the angle of incidence on the surface, of either sign.
  [[nodiscard]] static SurfaceLaw of(const Scattering& scattering, float texture, float cosine = 1);

  /// Share of the energy that falls on a facet that the facet reflects, 0..1.
  /// @param cosine  Of the angle of incidence on the facet, 0..1.
  [[nodiscard]] float reflected_by_facet(float cosine) const;

  /// Energy per steradian in a direction, relative to that which falls on the surface [1/sr].
  /// @param in   Direction in which the incident sound travels; a unit vector, as all of these.
  /// @param out  Direction in which it leaves.
  [[nodiscard]] float diffuse_into(const Vec3f& normal, const Vec3f& out) const;
  [[nodiscard]] float mirrored_into(const Vec3f& normal, const Vec3f& in, const Vec3f& out) const;

  /// Density with which draw() draws a direction [1/sr].
  [[nodiscard]] float density(const Vec3f& normal, const Vec3f& in, const Vec3f& out) const;

  /// A random direction of the scattered sound.
  struct Next {
    Vec3f direction;
    float share = 0;        ///< Factor on the walk's energy that makes its expected value right; 0: the walk ends.
    bool mirrored = false;  ///< Whether it belongs to the share `coherent`.
  };
  /// Chooses diffuse or mirrored in proportion to their shares, and samples a direction from its density above.
  /// @param choice, radius, turn  Uniform in (0, 1).
  [[nodiscard]] Next draw(const Vec3f& normal, const Vec3f& in, float choice, float radius, float turn) const;
};

}  // namespace insonify
