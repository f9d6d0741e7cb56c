// absorption.h -- absorption of sound in fresh and sea water, by frequency.

#pragma once

#include "insonify/water.h"

namespace insonify {

/// Absorption after Ainslie and McColm, J. Acoust. Soc. Am. 103(3), 1671 (1998); the default.
///
/// The sum of three losses: relaxation of boric acid, relaxation of magnesium sulphate, and viscosity of the water.
/// Within 10 % of Francois and Garrison from 100 Hz to 1 MHz; above 1 MHz, where only viscosity matters, the formula is
/// extrapolated. At salinity 0 only viscosity remains.
///
/// @param frequency  [Hz], >= 0.
/// @return           Loss per metre travelled, one way [dB/m].
[[nodiscard]] double absorption_db_per_m(double frequency, const Water& water);

/// Absorption after Francois and Garrison, J. Acoust. Soc. Am. 72(3), 896 and 72(6), 1879 (1982). 200 Hz to 1 MHz, +-5
/// %.
[[nodiscard]] double francois_garrison_db_per_m(double frequency, const Water& water);

/// 1 dB = ln(10)/20 Np. (The paper of the `paper` model prints 0.0115, ten times too small.)
inline constexpr double kNeperPerDecibel = 0.11512925464970229;

}  // namespace insonify
