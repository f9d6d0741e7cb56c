// value_noise.h -- smooth pseudo-random texture of surfaces in a camera view.

#pragma once

#include "insonify/geometry.h"

namespace insonify {

/// Value noise in -1..1 with zero mean: three octaves with grid spacings `size`, half of it and a quarter of it.
[[nodiscard]] float value_noise(const Vec3& point, double size);

}  // namespace insonify
