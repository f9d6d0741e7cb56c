// wedge.h -- echo of a straight edge by the geometrical theory of diffraction.

#pragma once

#include <array>

namespace insonify {

/// One face of a wedge as the sound falls on it.
struct WedgeFace {
  double angle;  ///< Direction to the source from the face, about the edge, through the water [rad], 0..2 pi.
  double
      reflection;  ///< Pressure reflection coefficient, -1..1; 0 leaves out what the edge adds to this face's mirror.
};

/// Amplitude S per length that an edge scatters straight back, relative to a plane mirror's in sign: from the range r
/// it echoes the pressure S |integral of e^(2ikr)/r^2 along the edge| of that at 1 m. An endless edge has the intensity
/// S^2 lambda/(2 r^3), one of the length L far off S^2 L^2/r^4. With water in the angle n pi between the faces,
///
///     S = -1/(4 pi n) (2 cot(pi/2n) + R_1 cot((pi - 2 phi_1)/2n) + R_2 cot((pi - 2 phi_2)/2n)),  phi_2 = n pi - phi_1
///
/// which is D sqrt(k/2 pi) of the coefficient D of Keller, J. Opt. Soc. Am. 52, 116 (1962), in terms of cotangents as
/// by Kouyoumjian and Pathak, Proc. IEEE 62, 1448 (1974), with the faces' R as by Luebbers, IEEE Trans. Antennas
/// Propag. 32, 70 (1984). Valid some wavelengths off, for sound that falls on the edge at right angles.
///
/// Where a face is seen head on (phi = pi/2) its term grows without limit: there the face is a mirror, whose echo is
/// not the edge's alone. Within `mirror` of that angle the term keeps the value that it has there.
/// @param exterior  n, 1..2: 3/2 for the edge of a box, 2 for that of a thin plate.
/// @param mirror    [rad], > 0.
[[nodiscard]] double wedge_backscatter(double exterior, const std::array<WedgeFace, 2>& faces, double mirror);

}  // namespace insonify
