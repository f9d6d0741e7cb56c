// fan_geometry.h -- converts between pixels of a fan picture and range and azimuth.

#pragma once

#include <cmath>
#include <numbers>

#include "image/canvas.h"

namespace insonify {

/// The angle wrapped to -pi..pi [rad]. Much faster than std::remainder for angles that are already close to that.
[[nodiscard]] inline double near_zero(double angle) {
  constexpr double kPi = std::numbers::pi;
  while (angle > kPi) {
    angle -= 2 * kPi;
  }
  while (angle < -kPi) {
    angle += 2 * kPi;
  }
  return angle;
}

/// The part of a disc that a fan covers. Azimuths grow counterclockwise, as seen from above.
struct FanShape {
  double low = 0, high = 0;             ///< Azimuths of its starboard and its port edge [rad]; high - low in (0, 2 pi].
  double min_range = 0, max_range = 1;  ///< [m]
  double up = 0;                        ///< Azimuth that is drawn upwards [rad].

  [[nodiscard]] double aperture() const { return high - low; }      ///< [rad]
  [[nodiscard]] double middle() const { return (low + high) / 2; }  ///< [rad]
  [[nodiscard]] bool full_circle() const;

  /// Distance of an azimuth from the nearer edge [rad]; positive inside the fan, negative outside.
  [[nodiscard]] double inside_by(double azimuth) const {
    return aperture() / 2 - std::abs(near_zero(azimuth - middle()));
  }
};

/// Bounding box of a fan about its apex, in units of max_range, right and up positive. It contains the apex.
struct FanExtent {
  double left = 0, right = 0, bottom = 0, top = 0;
};
[[nodiscard]] FanExtent extent_of(const FanShape& shape);

/// Position, scale and orientation of a fan on a picture.
struct FanGeometry {
  Point apex;                   ///< The sonar.
  double metres_per_pixel = 1;  ///< [m]
  double up = 0;                ///< Azimuth that is drawn upwards [rad].

  struct Place {
    double range = 0;    ///< [m]
    double azimuth = 0;  ///< [rad], within pi of `up`.
  };
  /// Range and azimuth at the middle of pixel (x, y).
  [[nodiscard]] Place place_at(int x, int y) const {
    const double right = (x + 0.5 - apex.x) * metres_per_pixel;
    const double above = (apex.y - (y + 0.5)) * metres_per_pixel;
    return {std::sqrt(right * right + above * above), up + std::atan2(-right, above)};
  }
  /// Point of the picture at which a range and azimuth are drawn.
  [[nodiscard]] Point point_at(double range, double azimuth) const;
};

/// A fan that fills its picture.
struct BareFan {
  int width = 0, height = 0;  ///< [pixels]
  FanGeometry geometry;
};

/// A fan of the given height; at most twice as wide, with room above and below if need be. One of up to 180 degrees
/// whose middle points up is 2 height sin(aperture / 2) wide, its apex at the middle of the lower border.
[[nodiscard]] BareFan bare_fan(const FanShape& shape, int height);

}  // namespace insonify
