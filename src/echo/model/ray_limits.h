// ray_limits.h -- clearance of rays from the surfaces at their ends.

#pragma once

namespace insonify {

/// Length at both ends of a reflected ray or return leg within which it hits nothing [m]: more than the rounding error
/// of single precision at sonar ranges, less than any detail that a sonar resolves.
inline constexpr float kRayClearance = 1e-3F;

}  // namespace insonify
