// echo_laws.h -- intensity of one echo, in double precision: the definitions of both models.
//
// The reference engine uses these functions. The loops over many samples (ScatterTable, fill_mirror_powers(),
// PaperShape) are single-precision forms of them; tests/echo/echo_laws_test.cpp compares the two. The scattering laws
// themselves are in insonify/acoustics/backscatter.h, the paper's sigmoid is PaperModel::shape().

#pragma once

#include <optional>

#include "echo/model/lobe_widening.h"
#include "insonify/material.h"

namespace insonify {

/// Least cosine of incidence that an intensity is divided by (89.4 degrees): bounds echoes at grazing incidence.
inline constexpr float kLeastCosine = 0.01F;

/// Least ray-tube spreading relative to that of a plane mirror: bounds echoes near a focus.
inline constexpr float kLeastSpread = 0.01F;

/// Strength of an echo in the `paper` model before the sigmoid: |cosine| x reflectivity x e^(-gamma length), gamma
/// being the absorption of a pressure amplitude. A path of several surfaces has the product of their strengths.
/// docs/concepts/paper-model.md.
/// @param cosine           Of the angle of incidence, of either sign.
/// @param reflectivity     0..1.
/// @param neper_per_metre  gamma [Np/m].
/// @param length           Length of the path that the absorption acts on, twice the range for a primary echo [m].
[[nodiscard]] double paper_strength(double cosine, double reflectivity, double neper_per_metre, double length);

/// Intensity of a primary echo in the `calibrated` model, relative to the source's at 1 m, per steradian of launched
/// sound: s_b / cos x e^(-4 gamma r) / r^2, where s_b includes AngularScattering::backscatter.
/// docs/concepts/calibrated-model.md, "An echo".
/// @param cosine   Of the angle of incidence, of either sign; 0 gives no echo.
/// @param texture  Factor on the amplitude, ReliefPoint::reflectivity.
/// @param range    r [m], > 0.
/// @param widening By the turn of the normal within the footprint: docs/concepts/scattering.md, "Curved surfaces".
[[nodiscard]] double primary_intensity(const Scattering& surface, double cosine, double texture, double neper_per_metre,
                                       double range, const LobeWidening<double>& widening = {});

/// A path from the sonar to a mirror, the first surface, and on to a second surface.
struct MirrorPath {
  Scattering mirror, second;  ///< Scattering parameters of both surfaces.
  double incidence = 1;       ///< Cosine of incidence on the mirror, of either sign.
  double mirror_texture = 1;  ///< ReliefPoint::reflectivity of the mirror.
  double second_texture = 1;  ///< The same of the second surface.
  double share = 1;           ///< MirrorFacet::share of the facet that reflects the sound; 1 for a smooth mirror.
  double there = 0;           ///< Length from the sonar to the mirror and on to the second surface [m].
  double back = 0;            ///< Length from the second surface straight to the sonar [m].
  double spread = 1;          ///< Area of the ray tube at the second surface, relative to that by a plane mirror.
  double returned = 1;        ///< face_return(): intensity that the mirror returns, relative to one without edges.
  double in = 1;              ///< Cosine between the second surface's normal and the direction the sound comes from.
  double out = 1;             ///< Cosine between that normal and the direction to the sonar.
  double half = 1;            ///< Cosine between that normal and the half vector of both directions.
  std::optional<double> glint = {};  ///< FacetReturn::half of the way back over the mirror; `in` without facets.
  double variance = 0;               ///< FacetReturn::variance
  double coherent = 1;               ///< FacetReturn::coherent
  double facet = 1;                  ///< Cosine between the half vector and either direction: incidence on the facets.
};

/// Intensities relative to the source's at 1 m, per steradian of launched sound.
struct MirrorIntensities {
  double once = 0;   ///< By the mirror one way: of each of the two reciprocal echoes.
  double twice = 0;  ///< By the mirror both ways.
};

/// Intensities of the three echoes of a path by a mirror in the `calibrated` model (docs/concepts/multipath.md, "Three
/// echoes"). Sound that leaves in dOmega falls on an area dA = dOmega A / in of the second surface, A being the area of
/// the ray tube per steradian. The way back by the mirror spreads by A too, by reciprocity:
///
///     once  = share |R|^2 s_b(in, out) / (in back^2)          e^(-2 gamma (there + back))
///     twice = share |R|^4 s_b(in, in)  / (in there^2 spread)  e^(-4 gamma there) returned
///
/// The lobe of s_b(in, in) is that at `glint`, for the share 1 - coherent with `variance` added to that of the slopes.
/// R of the mirror is that at `incidence`. The lobe of s_b(in, out) is that at the half vector, with R at `facet`. `in`
/// is held at kLeastCosine and `spread` at kLeastSpread.
///
/// Where both surfaces have a lobe, the same reciprocal path is also found from the other end, with the second surface
/// as the mirror. The lobe therefore counts in `once` only where the mirror is the smoother of the two surfaces, and
/// half where they are equally rough: two planes in a corner give the echo of their one image. There is no `once` where
/// `in` and `out` lie on opposite sides of the second surface.
[[nodiscard]] MirrorIntensities mirror_intensities(const MirrorPath& path, double neper_per_metre);

}  // namespace insonify
