// camera.h -- pinhole camera: converts pixels to rays and points to pixels.

#pragma once

#include "insonify/scenario.h"

namespace insonify {

/// Pixel coordinates run right and down from the upper left corner; the first pixel's centre is (0.5, 0.5).
class Camera {
 public:
  /// World z points up in the picture; world x if the camera looks straight up or down.
  Camera(const ViewConfig& view, int width, int height);

  [[nodiscard]] const Vec3& position() const { return position_; }  ///< [m]
  [[nodiscard]] const Vec3& forward() const { return forward_; }    ///< Unit vector; likewise right and up.
  [[nodiscard]] const Vec3& right() const { return right_; }
  [[nodiscard]] const Vec3& up() const { return up_; }

  /// Width of the picture at distance 1 in front of the camera.
  [[nodiscard]] double width_at_one() const { return 2 * half_width_; }

  /// Unit vector through a point of the picture, world frame.
  [[nodiscard]] Vec3 direction(double x, double y) const;

  struct Image {
    double x = 0, y = 0;  ///< [pixels]
    double depth = 0;     ///< Along the optical axis [m]; x and y are valid only where it is > 0.
  };
  [[nodiscard]] Image image_of(const Vec3& point) const;

 private:
  Vec3 position_, forward_, right_, up_;
  double half_width_, half_height_;  // At distance 1.
  double width_, height_;            // [pixels]
};

}  // namespace insonify
