// fresnel.h -- Fresnel integrals, for diffraction at straight edges.

#pragma once

#include <complex>

namespace insonify {

/// C(x) + i S(x) with C, S the integrals from 0 to x of cos and sin of pi t^2/2: Abramowitz and Stegun, Handbook of
/// Mathematical Functions (1964), 7.3.1 and 7.3.2. For x >= 0; the relative error is below 1e-14.
[[nodiscard]] std::complex<double> fresnel_integral(double x);

/// The integral of exp(i pi t^2/2) between two places of either sign.
[[nodiscard]] std::complex<double> fresnel_between(double from, double to);

}  // namespace insonify
