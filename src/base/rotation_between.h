// rotation_between.h -- the shortest rotation from one direction to another.

#pragma once

#include "insonify/geometry.h"

namespace insonify {

/// The shortest rotation that turns `from` to the direction of `to`; about some axis normal to both where they are
/// opposite. The operations are those of Eigen's FromTwoVectors(), which brings along a singular value decomposition
/// for opposite vectors that takes compilers five seconds.
/// @param from,to  Any lengths but 0.
[[nodiscard]] Eigen::Quaterniond rotation_between(const Vec3& from, const Vec3& to);

}  // namespace insonify
