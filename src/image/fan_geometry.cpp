// fan_geometry.cpp -- extent of a fan and its polar coordinates about the apex; beam azimuths tabulated for fast
// conversion to beams.

#include "image/fan_geometry.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "image/canvas.h"

namespace insonify {
namespace {

constexpr double kApertureTolerance = 1e-6;  // Tolerance for apertures summed over beams [rad].

// @param pixels  Length of max_range [pixels].
BareFan scaled_fan(const FanShape& shape, const FanExtent& extent, double pixels, int height) {
  BareFan fan{std::max(1, static_cast<int>(std::lround((extent.right - extent.left) * pixels))), height, {}};
  fan.geometry.up = shape.up;
  fan.geometry.metres_per_pixel = shape.max_range / pixels;
  fan.geometry.apex = {fan.width / 2.0 - (extent.left + extent.right) / 2 * pixels,
                       height / 2.0 + (extent.top + extent.bottom) / 2 * pixels};
  return fan;
}

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
  const double along = extent.top - extent.bottom;
  return scaled_fan(shape, extent, std::min(height / along, 2 * height / (extent.right - extent.left)), height);
}

BareFan bare_fan(const FanShape& shape, const Display& display, double bin_length) {
  if (!display.pixel_per_bin) {
    return bare_fan(shape, display.height);
  }
  constexpr int kGreatestHeight = 8192;
  const FanExtent extent = extent_of(shape);
  const double along = extent.top - extent.bottom;
  const double pixels = std::min(shape.max_range / bin_length, kGreatestHeight / along);
  return scaled_fan(shape, extent, pixels, std::max(1, static_cast<int>(std::lround(along * pixels))));
}

BeamAxis::BeamAxis(const SonarConfig& sonar) : last_(sonar.beam_count - 0.5) {
  const BearingGrid beams = sonar.bearings();
  knots_.push_back({beams.port.front(), -0.5, 0});
  for (int beam = 0; beam < beams.count(); ++beam) {
    knots_.push_back({beams.centres[beam], beam * 1.0, 0});
    if (beams.gap_after(beam)) {
      knots_.push_back({beams.starboard[beam], beam + 0.5, 0});
      knots_.push_back({beams.port[beam + 1], beam + 0.5, 0});
    }
  }
  knots_.push_back({beams.starboard.back(), last_, 0});
  for (std::size_t i = 0; i + 1 < knots_.size(); ++i) {
    knots_[i].beams_per_radian = (knots_[i + 1].beam - knots_[i].beam) / (knots_[i].azimuth - knots_[i + 1].azimuth);
  }

  const int steps = 4 * sonar.beam_count;
  steps_per_radian_ = steps / beams.extent();
  last_step_ = steps - 1;
  int knot = 0;
  for (int step = 0; step < steps; ++step) {
    const double azimuth = beams.port.front() - step / steps_per_radian_;
    while (knot + 2 < static_cast<int>(knots_.size()) && knots_[knot + 1].azimuth >= azimuth) {
      ++knot;
    }
    first_.push_back(knot);
  }
}

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
