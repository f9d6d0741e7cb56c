// ray_limits.h -- how far a ray keeps clear of the surfaces at its ends.

#pragma once

namespace insonify {

/// FootprintSegment at both ends of a reflected ray or return leg that meets nothing [m]: more than the rounding of
/// single precision at the distances sonars reach, less than any detail they resolve.
inline constexpr float kRayClearance = 1e-3F;

}  // namespace insonify
