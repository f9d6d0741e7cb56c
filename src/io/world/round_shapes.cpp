// round_shapes.cpp -- counts the triangles of round shapes, and finds the deviation at which there are few enough.

#include "io/world/round_shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace insonify {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kUsualAngle = 0.05;   // Default of make_sphere() and its like [rad].
constexpr double kWidestAtTips = 1.2;  // Of a long ellipsoid: elsewhere its normals turn more slowly [rad].

}  // namespace

// The counts of shapes.cpp: a sphere has 8 n^2 triangles with n = hypot(1, pi/2) pi/2 / a, a circle 2 pi / a steps. An
// ellipsoid's angle is smaller by the root of its largest over its smallest radius, at which its facets are as far off
// as those of a sphere of the smallest: there the product of an edge's length and its turn of the normal is largest.
RoundShapes::Form RoundShapes::form_of(const Shape& shape) {
  const double rings = std::hypot(1, kPi / 2) * kPi / 2;
  const double sphere = 8 * rings * rings;
  switch (shape.kind) {
    case ShapeKind::kSphere:
      return {shape.radius, sphere, 0};
    case ShapeKind::kCapsule:
      return {shape.radius, sphere, 8 * rings};
    case ShapeKind::kCylinder:
      return {shape.radius, 0, 4 * 2 * kPi};
    case ShapeKind::kCone:
      return {shape.radius, 0, 2 * 2 * kPi};
    case ShapeKind::kEllipsoid: {
      const Vec3 radii = shape.size.value_or(Vec3::Zero());
      const double ratio = radii.maxCoeff() / radii.minCoeff();
      const double widest = std::min(Form().widest * std::sqrt(ratio), kWidestAtTips);
      return ratio <= kMostRatio ? Form{radii.minCoeff(), sphere * ratio, 0, widest} : Form{};
    }
    default:
      return {};
  }
}

double RoundShapes::angle_of(const Form& form, double deviation) {
  return std::clamp(std::sqrt(8 * deviation / form.radius), kUsualAngle, form.widest);
}

double RoundShapes::triangles(double deviation) const {
  double sum = 0;
  for (const Form& form : forms_) {
    const double angle = angle_of(form, deviation);
    sum += form.by_square / (angle * angle) + form.by_angle / angle;
  }
  return sum;
}

void RoundShapes::add(const Shape& shape) {
  const Form form = form_of(shape);
  if (!(form.radius > 0)) {
    return;
  }
  const bool is_ellipsoid = shape.kind == ShapeKind::kEllipsoid;
  const Vec3 size = is_ellipsoid ? *shape.size : Vec3(shape.radius, shape.length, 0);
  if (seen_.emplace(shape.kind, size.x(), size.y(), size.z()).second) {
    forms_.push_back(form);
    is_chosen_ = false;
  }
}

double RoundShapes::deviation() {
  if (is_chosen_) {
    return deviation_;
  }
  is_chosen_ = true;
  deviation_ = 0;
  if (triangles(0) <= kMostTriangles) {
    return deviation_;
  }
  double few = 0;  // A deviation at which all have the widest angle.
  for (const Form& form : forms_) {
    few = std::max(few, form.radius * form.widest * form.widest / 8);
  }
  for (double many = 0; few - many > 1e-3 * few;) {
    const double middle = (few + many) / 2;
    (triangles(middle) > kMostTriangles ? many : few) = middle;
  }
  deviation_ = few;
  return deviation_;
}

double RoundShapes::edge_angle(const Shape& shape) {
  return deviation() > 0 ? angle_of(form_of(shape), deviation_) : kUsualAngle;
}

}  // namespace insonify
