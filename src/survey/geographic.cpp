// geographic.cpp -- the tangent plane in coordinates centred on the Earth, as in Hofmann-Wellenhof, Lichtenegger and
// Wasle, GNSS (2008), sections 8.2.1 and 8.2.2; latitude from these by Bowring, Survey Review 23 (1976) 323-327.

#include "insonify/survey/geographic.h"

#include <cmath>

#include "insonify/field.h"

namespace insonify {
namespace {

// WGS84.
constexpr double kEquator = 6378137;  // Semi-major axis a [m].
constexpr double kFlattening = 1 / 298.257223563;
constexpr double kPole = kEquator * (1 - kFlattening);             // Semi-minor axis b [m].
constexpr double kEccentricity = kFlattening * (2 - kFlattening);  // e^2
constexpr double kSecond = kEccentricity / (1 - kEccentricity);    // e'^2

// Coordinates of a point of the ellipsoid, from the middle of the Earth [m].
std::array<double, 3> earth_centred(const GeographicPoint& place) {
  const double latitude = radians_from_degrees(place.latitude), longitude = radians_from_degrees(place.longitude);
  const double sine = std::sin(latitude), cosine = std::cos(latitude);
  const double normal = kEquator / std::sqrt(1 - kEccentricity * sine * sine);
  return {normal * cosine * std::cos(longitude), normal * cosine * std::sin(longitude),
          (1 - kEccentricity) * normal * sine};
}

}  // namespace

LocalGrid::LocalGrid(const GeographicPoint& origin)
    : origin_(earth_centred(origin)),
      sin_latitude_(std::sin(radians_from_degrees(origin.latitude))),
      cos_latitude_(std::cos(radians_from_degrees(origin.latitude))),
      sin_longitude_(std::sin(radians_from_degrees(origin.longitude))),
      cos_longitude_(std::cos(radians_from_degrees(origin.longitude))) {
  check_origin(origin);
}

GeographicPoint LocalGrid::geographic(const Vec3& point) const {
  const double east = point.x(), north = point.y();
  const double x = origin_[0] - sin_longitude_ * east - sin_latitude_ * cos_longitude_ * north;
  const double y = origin_[1] + cos_longitude_ * east - sin_latitude_ * sin_longitude_ * north;
  const double z = origin_[2] + cos_latitude_ * north;
  const double from_axis = std::hypot(x, y);
  const double reduced = std::atan2(z * kEquator, from_axis * kPole);
  const double latitude = std::atan2(z + kSecond * kPole * std::pow(std::sin(reduced), 3),
                                     from_axis - kEccentricity * kEquator * std::pow(std::cos(reduced), 3));
  return {degrees_from_radians(latitude), degrees_from_radians(std::atan2(y, x))};
}

Vec3 LocalGrid::local(const GeographicPoint& place) const {
  const std::array<double, 3> there = earth_centred(place);
  const double x = there[0] - origin_[0], y = there[1] - origin_[1], z = there[2] - origin_[2];
  return {cos_longitude_ * y - sin_longitude_ * x,
          cos_latitude_ * z - sin_latitude_ * (cos_longitude_ * x + sin_longitude_ * y), 0};
}

void check_origin(const GeographicPoint& origin) {
  check_field("origin", {"latitude", "deg", from_to(-89, 89), ""}, origin.latitude);
  check_field("origin", {"longitude", "deg", from_to(-180, 180), ""}, origin.longitude);
}

}  // namespace insonify
