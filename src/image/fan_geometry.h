// fan_geometry.h -- converts between pixels of a fan picture and range, azimuth and beam.

#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "image/canvas.h"
#include "insonify/picture.h"
#include "insonify/sonar_config.h"

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

/// First and last pixel of a row that the fan may touch; none if first > last.
struct Columns {
  int first = 0, last = -1;
};
[[nodiscard]] Columns columns_of_row(const FanShape& shape, const FanGeometry& geometry, int y, int width);

/// A fan that fills its picture.
struct BareFan {
  int width = 0, height = 0;  ///< [pixels]
  FanGeometry geometry;
};

/// A fan of the given height; at most twice as wide, with room above and below if need be. One of up to 180 degrees
/// whose middle points up is 2 height sin(aperture / 2) wide, its apex at the middle of the lower border.
[[nodiscard]] BareFan bare_fan(const FanShape& shape, int height);
/// One of the display's height, or with a pixel for each bin, up to the greatest height of a display.
[[nodiscard]] BareFan bare_fan(const FanShape& shape, const Display& display, double bin_length);

/// Continuous beam coordinate of a sonar: b at the centre of beam b, linear between centres and out to the outer edges,
/// which are at -0.5 and beam_count - 0.5. A gap between beams b and b + 1 is at b + 0.5.
class BeamAxis {
 public:
  explicit BeamAxis(const SonarConfig& sonar);

  [[nodiscard]] double port_edge() const { return knots_.front().azimuth; }      ///< [rad]
  [[nodiscard]] double starboard_edge() const { return knots_.back().azimuth; }  ///< [rad]

  /// Beam coordinate of an azimuth [rad], clamped to the outer edges.
  [[nodiscard]] double beam_at(double azimuth) const {
    const double step = (port_edge() - azimuth) * steps_per_radian_;
    int i = first_[static_cast<int>(std::clamp(step, 0.0, last_step_))];
    while (i + 2 < static_cast<int>(knots_.size()) && knots_[i + 1].azimuth > azimuth) {
      ++i;
    }
    return std::clamp(knots_[i].beam + (knots_[i].azimuth - azimuth) * knots_[i].beams_per_radian, -0.5, last_);
  }

 private:
  struct Knot {
    double azimuth, beam, beams_per_radian;  // beams_per_radian is valid up to the next knot.
  };
  std::vector<Knot> knots_;  // The port edge, the beam centres, the edges of gaps and the starboard edge.
  std::vector<int> first_;   // Index of the knot at or before each of many equal steps from the port edge.
  double steps_per_radian_ = 0, last_step_ = 0, last_ = 0;
};

}  // namespace insonify
