// fan_geometry.cpp -- extent of a fan and its polar coordinates about the apex.

#include "image/fan_geometry.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "image/canvas.h"

namespace insonify {
namespace {

constexpr double kApertureTolerance = 1e-6;  // Tolerance for apertures summed over beams [rad].

}  // namespace

bool FanShape::full_circle() const {
  return aperture() >= kTwoPi - kApertureTolerance;
}

FanExtent extent_of(const FanShape& shape) {
  FanExtent extent;
  const auto include = [&](double azimuth) {
    const double right = -std::sin(azimuth - shape.up);
    const double above = std::cos(azimuth - shape.up);
    extent = {std::min(extent.left, right), std::max(extent.right, right), std::min(extent.bottom, above),
              std::max(extent.top, above)};
  };
  include(shape.low);
  include(shape.high);
  for (int quarter = 0; quarter < 4; ++quarter) {
    const double azimuth = shape.up + quarter * std::numbers::pi / 2;
    if (shape.full_circle() || shape.inside_by(azimuth) > 0) {
      include(azimuth);
    }
  }
  return extent;
}

Point FanGeometry::point_at(double range, double azimuth) const {
  const double radius = range / metres_per_pixel;
  return {apex.x - radius * std::sin(azimuth - up), apex.y - radius * std::cos(azimuth - up)};
}

BareFan bare_fan(const FanShape& shape, int height) {
  const FanExtent extent = extent_of(shape);
  const double across = extent.right - extent.left;
  const double along = extent.top - extent.bottom;
  const double pixels = std::min(height / along, 2 * height / across);  // Length of max_range [pixels].
  BareFan fan{std::max(1, static_cast<int>(std::lround(across * pixels))), height, {}};
  fan.geometry.up = shape.up;
  fan.geometry.metres_per_pixel = shape.max_range / pixels;
  fan.geometry.apex = {fan.width / 2.0 - (extent.left + extent.right) / 2 * pixels,
                       height / 2.0 + (extent.top + extent.bottom) / 2 * pixels};
  return fan;
}

}  // namespace insonify
