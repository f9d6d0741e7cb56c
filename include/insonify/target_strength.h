// target_strength.h -- how strong an echo bodies of simple shape send back.

#pragma once

#include <limits>

namespace insonify {

// Backscattering cross sections [m^2] of rigid bodies: echo intensity at range r is cross section / r^4 of the source's
// intensity at 1 m, without absorption. For other materials multiply by |R|^2 (reflection.h). All hold for bodies large
// against the wavelength (ka >> 1), as all are at the frequencies of imaging sonars: 2 mm at 720 kHz.
// Urick, Principles of Underwater Sound (1983), table 9.1.
//
// Lengths are in m and > 0; a range is the distance to the nearest point of the body, and infinite where the body is
// in the far field. All throw Error on a length out of its limits.

inline constexpr double kFarField = std::numeric_limits<double>::infinity();

/// 10 lg of a cross section: target strength [dB re 1 m^2], minus infinity for 0.
[[nodiscard]] double target_strength_db(double cross_section);

/// The highlight of a smooth convex body, whose surface has principal radii of curvature r1 and r2 where it faces the
/// sonar (Kirchhoff approximation): 1/4 [r1 r/(r1 + r)] [r2 r/(r2 + r)]. An infinite radius is straight: two make a
/// wall, whose echo is that of the sonar's mirror image at 2 r.
[[nodiscard]] double convex_cross_section(double radius1, double radius2, double range = kFarField);

/// A sphere: a^2/4 in the far field.
[[nodiscard]] double sphere_cross_section(double radius, double range = kFarField);

/// A cylinder from the side, the sonar in the plane of its middle: a L^2/(2 lambda) for r > L^2/lambda, and nearer
///
///     1/4 [a r/(a + r)] 2 r (C^2 + S^2),    C, S: Fresnel's integrals to L/sqrt(lambda r)
///
/// which levels off at the infinite cylinder's convex_cross_section().
[[nodiscard]] double cylinder_cross_section(double radius, double length, double wavelength, double range = kFarField);

/// A rectangular plate at normal incidence, the sonar above its middle: (A/lambda)^2 for r > A/lambda, and nearer
///
///     r^2 (C^2 + S^2)(u1) (C^2 + S^2)(u2),  u: side/sqrt(lambda r)
///
/// which ripples about the mirror's r^2/4. A square metre at 720 kHz is a mirror out to 480 m.
[[nodiscard]] double plate_cross_section(double width, double height, double wavelength, double range = kFarField);

/// A sphere whose surface scatters after Lambert: 2 pi mu a^2/3, far field. @param mu linear, >= 0 (backscatter.h).
[[nodiscard]] double lambert_sphere_cross_section(double mu, double radius);

/// Corner reflectors along their axis, far field; edges as measured along the corner's own edges.
/// Two plates of width x height at a right angle, joined along `height`: 2 (width height/lambda)^2.
[[nodiscard]] double dihedral_cross_section(double width, double height, double wavelength);
/// Three right triangles: edge^4/(3 lambda^2).
[[nodiscard]] double triangular_trihedral_cross_section(double edge, double wavelength);
/// Three squares: 3 edge^4/lambda^2.
[[nodiscard]] double square_trihedral_cross_section(double edge, double wavelength);

}  // namespace insonify
