// geographic.cpp -- the ellipsoid's radii of curvature at an origin, as metres a degree.

#include "insonify/survey/geographic.h"

#include <cmath>

#include "insonify/field.h"

namespace insonify {

Vec3 metres_a_degree(const Geographic& origin) {
  constexpr double kAxis = 6378137, kFlattening = 1 / 298.257223563;  // WGS 84 [m].
  constexpr double kSquare = kFlattening * (2 - kFlattening);         // Of the eccentricity.
  const double latitude = radians_from_degrees(origin.latitude);
  const double curve = 1 - kSquare * std::sin(latitude) * std::sin(latitude);
  const double along_parallel = kAxis / std::sqrt(curve) * std::cos(latitude);
  const double along_meridian = kAxis * (1 - kSquare) / (curve * std::sqrt(curve));
  return {radians_from_degrees(along_parallel), radians_from_degrees(along_meridian), 0};
}

Vec3 world_from_geographic(const Geographic& place, const Geographic& origin) {
  const Vec3 metres = metres_a_degree(origin);
  return {metres.x() * std::remainder(place.longitude - origin.longitude, 360),
          metres.y() * (place.latitude - origin.latitude), 0};
}

Geographic geographic_from_world(const Vec3& place, const Geographic& origin) {
  const Vec3 metres = metres_a_degree(origin);
  return {origin.latitude + place.y() / metres.y(), origin.longitude + place.x() / metres.x()};
}

void check_origin(const Geographic& origin) {
  check_field("origin", {"latitude", "deg", from_to(-89, 89), ""}, origin.latitude);
  check_field("origin", {"longitude", "deg", from_to(-180, 180), ""}, origin.longitude);
}

}  // namespace insonify
