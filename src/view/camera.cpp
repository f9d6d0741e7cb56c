// camera.cpp -- perspective projection and its inverse.

#include "view/camera.h"

#include <cmath>

namespace insonify {

Camera::Camera(const ViewConfig& view, int width, int height)
    : position_(view.position),
      forward_((view.look_at - view.position).normalized()),
      half_width_(std::tan(view.field_of_view / 2)),
      half_height_(half_width_ * height / width),
      width_(width),
      height_(height) {
  constexpr double kStraightDown = 0.9999;
  const Vec3 above = std::abs(forward_.z()) > kStraightDown ? Vec3(Vec3::UnitX()) : Vec3(Vec3::UnitZ());
  right_ = forward_.cross(above).normalized();
  up_ = right_.cross(forward_);
}

Vec3 Camera::direction(double x, double y) const {
  const double across = (2 * x / width_ - 1) * half_width_;
  const double along = (1 - 2 * y / height_) * half_height_;
  return (forward_ + across * right_ + along * up_).normalized();
}

Camera::Image Camera::image_of(const Vec3& point) const {
  const Vec3 offset = point - position_;
  const double depth = offset.dot(forward_);
  return {(1 + offset.dot(right_) / (depth * half_width_)) * width_ / 2,
          (1 - offset.dot(up_) / (depth * half_height_)) * height_ / 2, depth};
}

}  // namespace insonify
