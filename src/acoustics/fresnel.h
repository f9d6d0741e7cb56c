// fresnel.h -- Fresnel's integrals, of waves that pass a straight edge.

#pragma once

#include <complex>

namespace insonify {

/// C(x) + i S(x) with C, S the integrals from 0 to x of cos and sin of pi t^2/2: Abramowitz and Stegun, Handbook of
/// Mathematical Functions (1964), 7.3.1 and 7.3.2. To 1e-14 of its modulus, for x >= 0.
[[nodiscard]] std::complex<double> fresnel_integral(double x);

}  // namespace insonify
