// geographic.h -- places on the Earth near an origin, as metres east and north of it.

#pragma once

#include "insonify/geometry.h"

namespace insonify {

/// A place on the ellipsoid WGS 84 [deg].
struct Geographic {
  double latitude = 0;   ///< Positive north, -90..90.
  double longitude = 0;  ///< Positive east, -180..180.
};

/// Metres that a degree of latitude and of longitude have near a place, by the ellipsoid's radii of curvature (WGS 84):
/// x east, y north, z 0. Straight lines on a survey's chart: 10 km from the origin they are wrong by some metres.
[[nodiscard]] Vec3 metres_a_degree(const Geographic& origin);

/// Place in a world with x east and y north of the origin [m], z = 0, and back.
[[nodiscard]] Vec3 world_from_geographic(const Geographic& place, const Geographic& origin);
[[nodiscard]] Geographic geographic_from_world(const Vec3& place, const Geographic& origin);

/// @throws Error unless the latitude is within 89 degrees and the longitude within 180.
void check_origin(const Geographic& origin);

}  // namespace insonify
