// window.h -- window functions (tapers) along a line array or over the frequency band of a chirp, and their transforms.

#pragma once

#include <complex>
#include <vector>

#include "insonify/array_pattern.h"

namespace insonify {

/// Weights of the elements, symmetric, not normalised.
[[nodiscard]] std::vector<double> element_weights(const ArraySettings& settings);

/// Window along a continuous line, as a sum of cosines. Not for kDolphChebyshev, whose limit for a continuous line has
/// delta functions at its ends.
[[nodiscard]] std::vector<WindowCosine> line_weight(const ArraySettings& settings);

/// sin(pi x) / (pi x).
[[nodiscard]] double sinc(double x);

/// Integral of weight(s) cos(2 pi x s) over s from -1/2 to 1/2: the beam pattern of a line, or with x = bandwidth x
/// delay the envelope of a compressed chirp.
[[nodiscard]] double line_pattern(const std::vector<WindowCosine>& weight, double x);

/// Integral of weight(s) e^(i (2 pi x s + 4 edge_phase s^2)) over s: line_pattern() out of focus, by Fresnel integrals.
/// @param edge_phase  [rad], not 0.
[[nodiscard]] std::complex<double> defocused_line_pattern(const std::vector<WindowCosine>& weight, double x,
                                                          double edge_phase);

/// Integral of weight(s)^2 over s, which by Parseval's theorem is that of line_pattern(x)^2 over x.
[[nodiscard]] double line_power(const std::vector<WindowCosine>& weight);

}  // namespace insonify
