// value_noise.h -- irregular light and dark on surfaces, as nature has it.

#pragma once

#include "insonify/geometry.h"

namespace insonify {

/// Noise about 0, within -1..1, that varies smoothly in space over lengths of about `size`, half of it and a quarter of
/// it.
[[nodiscard]] float value_noise(const Vec3& point, double size);

}  // namespace insonify
