// cone.h -- the cone of the paper's figure on attenuation.

#pragma once

#include "kit/modelling.h"

inline constexpr double kConeRadius = 1.3;  ///< [m]
inline constexpr double kConeHeight = 2.6;  ///< [m]

/// Stands on z = 0, its axis along z.
[[nodiscard]] Shape make_cone();
