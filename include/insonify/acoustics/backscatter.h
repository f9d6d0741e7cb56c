// backscatter.h -- backscatter of rough surfaces: Lambert's law and Kirchhoff's facets.

#pragma once

#include "insonify/geometry.h"

namespace insonify {

// All return the scattering cross section per unit area of the surface, relative to incident intensity and at 1 m; ten
// times its logarithm is the bottom (or backscatter) strength S_b [dB]. Incidence is measured from the surface's
// normal; at 90 degrees and beyond, where the surface shows its edge or its back, nothing is scattered.

/// The greatest Lambert parameter: a surface of mu = 1/pi sends all the sound that falls on it back into the water.
inline constexpr double kGreatestLambertParameter = 0.3183098861837907;

/// Lambert's law, mu cos^2: a surface rough at every scale of the wavelength. Urick, Principles of Underwater Sound
/// (1983), ch. 8; Mackenzie, J. Acoust. Soc. Am. 33(11), 1498 (1961) found mu = -27 dB on the deep floor. Holds for
/// bottoms up to some 45 degrees of grazing; steeper the lobe below comes on top.
///
/// @param mu         Lambert parameter, linear, >= 0; 1/pi at most for a surface that adds no energy.
/// @param incidence  [rad], 0..pi.
/// @throws Error if mu is out of its limits.
[[nodiscard]] double lambert_backscatter(double mu, double incidence);

/// The same between two directions: mu cos(in) cos(out).
[[nodiscard]] double lambert_scatter(double mu, double incidence_in, double incidence_out);

/// Echo of a surface made of facets whose slopes are normally distributed, each a small mirror; the Kirchhoff
/// approximation where height varies by more than the wavelength:
///
///     |R|^2 / (8 pi s^2 cos^4) exp(-tan^2 / (2 s^2))
///
/// Its integral is right: a large plate gives the mirror's echo for every s, and a sphere a^2/4 up to order s^2 (0.04
/// dB for s = 0.1). It is F D/4 with the distribution D of Beckmann and m = sqrt(2) s. Beckmann and Spizzichino, The
/// Scattering of Electromagnetic Waves from Rough Surfaces (1963), ch. 5. No shadowing of facets by each other: for s
/// up to about 0.5.
///
/// @param reflection  Pressure reflection coefficient R at normal incidence, -1..1.
/// @param rms_slope   Root mean square s of the slope along one axis (tangent of the tilt), > 0.
/// @param incidence   [rad], 0..pi.
/// @throws Error if reflection or rms_slope are out of their limits.
[[nodiscard]] double facet_backscatter(double reflection, double rms_slope, double incidence);

/// The same between two directions, both on the side of the normal: facet_backscatter() at half_vector_tilt(), since
/// only facets that face halfway between them mirror one into the other.
/// @param half_tilt  Angle between the normal and the half vector [rad], 0..pi/2.
[[nodiscard]] double facet_scatter(double reflection, double rms_slope, double half_tilt);

/// Angle between a surface's normal and the vector halfway between two directions away from it [rad], 0..pi. Straight
/// back it is the incidence, in the mirror's direction it is 0.
/// @param towards_source, towards_receiver  From the surface; unit vectors, not opposite to each other.
[[nodiscard]] double half_vector_tilt(const Vec3& normal, const Vec3& towards_source, const Vec3& towards_receiver);

}  // namespace insonify
