// window.h -- the weights along a line array, or across the band of a pulse.

#pragma once

#include <vector>

#include "insonify/array_pattern.h"

namespace insonify {

/// Weights of elements, symmetric, not normalised.
[[nodiscard]] std::vector<double> element_weights(const ArraySettings& settings);

/// The weight along an unbroken line, as a sum of cosines. Dolph's has none: its ends are spikes.
[[nodiscard]] std::vector<WindowCosine> line_weight(const ArraySettings& settings);

/// sin(pi x) / (pi x).
[[nodiscard]] double sinc(double x);

/// Integral over s of weight(s) cos(2 pi x s): the pattern, or with x = bandwidth x delay the compressed pulse.
[[nodiscard]] double line_pattern(const std::vector<WindowCosine>& weight, double x);

/// Integral over s of weight(s)^2, which is that of the pattern squared over x (Parseval).
[[nodiscard]] double line_power(const std::vector<WindowCosine>& weight);

}  // namespace insonify
