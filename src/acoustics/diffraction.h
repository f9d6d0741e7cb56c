// diffraction.h -- diffraction at straight edges: Fresnel integrals, and the echo of a wedge's edge.

#pragma once

#include <array>
#include <complex>

namespace insonify {

/// C(x) + i S(x) with C, S the integrals from 0 to x of cos and sin of pi t^2/2: Abramowitz and Stegun, Handbook of
/// Mathematical Functions (1964), 7.3.1 and 7.3.2. For x >= 0; the relative error is below 1e-14.
[[nodiscard]] std::complex<double> fresnel_integral(double x);

/// The integral of exp(i pi t^2/2) between two places of either sign.
[[nodiscard]] std::complex<double> fresnel_between(double from, double to);

/// One face of a wedge, relative to the direction of incidence.
struct WedgeFace {
  double angle;       ///< From the face through the water to the direction of the source [rad], 0..2 pi.
  double reflection;  ///< Pressure reflection coefficient, -1..1; 0 leaves out this face's term.
};

/// Backscattered amplitude S per length of an edge, with the sign of a plane mirror's. The echo's pressure is
/// S |integral of e^(2ikr)/r^2 along the edge| relative to the source's at 1 m: an intensity of S^2 lambda/(2 r^3) for
/// an infinite edge, and S^2 L^2/r^4 for a distant edge of length L. With the exterior angle n pi between the faces,
///
///     S = -1/(4 pi n) (2 cot(pi/2n) + R_1 cot((pi - 2 phi_1)/2n) + R_2 cot((pi - 2 phi_2)/2n)),  phi_2 = n pi - phi_1
///
/// which is sqrt(k/2 pi) times the diffraction coefficient of Keller, J. Opt. Soc. Am. 52, 116 (1962), written with
/// cotangents as by Kouyoumjian and Pathak, Proc. IEEE 62, 1448 (1974), and with the faces' R as by Luebbers, IEEE
/// Trans. Antennas Propag. 32, 70 (1984). Valid from some wavelengths on, for incidence perpendicular to the edge.
///
/// At normal incidence on a face (phi = pi/2) its term has a pole, since there the face itself is a mirror. Within
/// `mirror` of that angle the term has its value at that distance.
/// @param exterior  n, 1..2: 3/2 for the edge of a box, 2 for that of a thin plate.
/// @param mirror    [rad], > 0.
[[nodiscard]] double wedge_backscatter(double exterior, const std::array<WedgeFace, 2>& faces, double mirror);

}  // namespace insonify
