// local_grid.h -- metres east and north of a point of the Earth, as latitude and longitude.

#pragma once

#include <array>

namespace insonify {

/// The plane that touches the ellipsoid of WGS84 at an origin, x east and y north.
class LocalGrid {
 public:
  /// @param latitude, longitude  Of the origin [deg].
  LocalGrid(double latitude, double longitude);

  /// Latitude and longitude of a point of the plane [deg]; longitude from -180 to 180.
  [[nodiscard]] std::array<double, 2> geographic(double east, double north) const;

  /// East and north of a point of the ellipsoid [m].
  [[nodiscard]] std::array<double, 2> local(double latitude, double longitude) const;

 private:
  std::array<double, 3> origin_;  // [m], centred on the Earth.
  double sin_latitude_, cos_latitude_, sin_longitude_, cos_longitude_;
};

}  // namespace insonify
