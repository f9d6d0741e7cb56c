// camera.h -- a pinhole camera: from pixels to rays and back.

#pragma once

#include "insonify/scenario.h"

namespace insonify {

/// Pixels count right and down from the upper left corner; (0.5, 0.5) is the middle of the first.
class Camera {
 public:
  /// World z points up in the picture, unless the camera looks straight up or down: then x does.
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
    double depth = 0;     ///< Along the optical axis [m]; not positive behind the camera, where x and y mean nothing.
  };
  [[nodiscard]] Image image_of(const Vec3& point) const;

 private:
  Vec3 position_, forward_, right_, up_;
  double half_width_, half_height_;  // At distance 1.
  double width_, height_;            // [pixels]
};

}  // namespace insonify
