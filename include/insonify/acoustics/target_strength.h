// target_strength.h -- target strength (backscattering cross section) of bodies of simple shape.

#pragma once

#include <limits>

namespace insonify {

// Backscattering cross sections [m^2] of rigid bodies: echo intensity at range r is cross section / r^4 of the source's
// intensity at 1 m, without absorption. For other materials multiply by |R|^2 (reflection.h). All are valid for bodies
// much larger than the wavelength (ka >> 1), which is 2 mm at 720 kHz. Urick, Principles of Underwater Sound (1983),
// table 9.1.
//
// Lengths are in m and > 0. A range is the distance to the nearest point of the body; infinite means the far field. All
// functions throw Error on a length out of its limits.

inline constexpr double kFarField = std::numeric_limits<double>::infinity();

/// Target strength, 10 log10 of a cross section [dB re 1 m^2]; minus infinity for 0.
[[nodiscard]] double target_strength_db(double cross_section);

/// Specular highlight of a smooth convex body with principal radii of curvature r1 and r2 at the point that faces the
/// sonar (Kirchhoff approximation): 1/4 [r1 r/(r1 + r)] [r2 r/(r2 + r)]. With two infinite radii it is a wall, whose
/// echo is that of the sonar's mirror image at 2 r.
[[nodiscard]] double convex_cross_section(double radius1, double radius2, double range = kFarField);

/// A sphere: a^2/4 in the far field.
[[nodiscard]] double sphere_cross_section(double radius, double range = kFarField);

/// A cylinder at broadside, with the sonar opposite its middle: a L^2/(2 lambda) for r > L^2/lambda, and nearer
///
///     1/4 [a r/(a + r)] 2 r (C^2 + S^2),    C, S: Fresnel integrals at L/sqrt(lambda r)
///
/// whose limit for long cylinders is convex_cross_section() of an infinite one.
[[nodiscard]] double cylinder_cross_section(double radius, double length, double wavelength, double range = kFarField);

/// A rectangular plate at normal incidence, with the sonar opposite its middle: (A/lambda)^2 for r > A/lambda, and
/// nearer
///
///     r^2 (C^2 + S^2)(u1) (C^2 + S^2)(u2),  u = side/sqrt(lambda r)
///
/// which oscillates about r^2/4, the echo of an infinite mirror. A square metre at 720 kHz is in this near field out to
/// 480 m.
[[nodiscard]] double plate_cross_section(double width, double height, double wavelength, double range = kFarField);

/// A sphere whose surface scatters by Lambert's law: 2 pi mu a^2/3, far field.
/// @param mu  Lambert parameter, linear, >= 0 (backscatter.h).
[[nodiscard]] double lambert_sphere_cross_section(double mu, double radius);

// Corner reflectors seen along their axis of symmetry, in the far field.

/// Dihedral of two plates of width x height, joined at a right angle along `height`: 2 (width height/lambda)^2.
[[nodiscard]] double dihedral_cross_section(double width, double height, double wavelength);
/// Trihedral of three right triangles with legs of length `edge`: edge^4/(3 lambda^2).
[[nodiscard]] double triangular_trihedral_cross_section(double edge, double wavelength);
/// Trihedral of three squares of side `edge`: 3 edge^4/lambda^2.
[[nodiscard]] double square_trihedral_cross_section(double edge, double wavelength);

}  // namespace insonify
