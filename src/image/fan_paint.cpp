// fan_paint.cpp -- finds the interval of each row of pixels that a fan covers.

#include "image/fan_paint.h"

namespace insonify {

Columns columns_of_row(const FanShape& shape, const FanGeometry& geometry, int y, int width) {
  // Coordinates in pixels from the apex; one pixel is added to the radius for the anti-aliased border.
  const double above = geometry.apex.y - (y + 0.5);
  const double radius = shape.max_range / geometry.metres_per_pixel + 1;
  if (std::abs(above) > radius) {
    return {};
  }
  double right = std::sqrt(radius * radius - above * above);
  double left = -right;
  // A fan of less than half a circle lies on one side of each of its edges: `to_right` x + `to_top` y >= -1.
  const auto cut = [&](double to_right, double to_top) {
    const double bound = (-1 - to_top * above) / to_right;
    if (to_right > 0) {
      left = std::max(left, bound);
    } else if (to_right < 0) {
      right = std::min(right, bound);
    } else if (to_top * above < -1) {
      right = left - 1;
    }
  };
  if (shape.aperture() < std::numbers::pi) {
    const double high = shape.high - shape.up;
    const double low = shape.low - shape.up;
    cut(std::cos(high), std::sin(high));
    cut(-std::cos(low), -std::sin(low));
  }
  return {std::max(0, static_cast<int>(std::floor(geometry.apex.x + left))),
          std::min(width - 1, static_cast<int>(std::floor(geometry.apex.x + right)))};
}

}  // namespace insonify
