// geographic.h -- metres east and north of a place on the Earth, as latitude and longitude, and back.

#pragma once

#include <array>

#include "insonify/geometry.h"

namespace insonify {

/// A place on the ellipsoid of WGS84.
struct GeographicPoint {
  double latitude = 0;   ///< [deg], -90..90; north positive.
  double longitude = 0;  ///< [deg], -180..180; east positive.
};

/// The plane that touches the ellipsoid of WGS84 at a world's origin, x east and y north. Distances on it are those on
/// the Earth within 1 mm at 4 km from the origin, 8 mm at 10 km.
class LocalGrid {
 public:
  /// @throws Error as check_origin().
  explicit LocalGrid(const GeographicPoint& origin);

  /// The place under or over a point of the plane. @param point  [m]; z is not used.
  [[nodiscard]] GeographicPoint geographic(const Vec3& point) const;

  /// East and north of a place [m], z = 0.
  [[nodiscard]] Vec3 local(const GeographicPoint& place) const;

 private:
  std::array<double, 3> origin_;  // [m], centred on the Earth.
  double sin_latitude_, cos_latitude_, sin_longitude_, cos_longitude_;
};

/// @throws Error unless the latitude is within 89 degrees and the longitude within 180.
void check_origin(const GeographicPoint& origin);

}  // namespace insonify
