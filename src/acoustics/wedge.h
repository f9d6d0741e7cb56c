// wedge.h -- echo of a straight edge by the geometrical theory of diffraction.

#pragma once

#include <array>

namespace insonify {

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
