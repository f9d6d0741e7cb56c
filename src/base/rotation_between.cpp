#include "base/rotation_between.h"

#include <cmath>

namespace insonify {

Eigen::Quaterniond rotation_between(const Vec3& from, const Vec3& to) {
  const Vec3 start = from.normalized(), end = to.normalized();
  const double cosine = end.dot(start);
  Eigen::Quaterniond turn;
  if (cosine < -1 + 1e-12) {
    turn.vec() = start.unitOrthogonal();
    turn.w() = 0;
    return turn;
  }
  const double twice_half_cosine = std::sqrt((1 + cosine) * 2);
  turn.vec() = start.cross(end) * (1 / twice_half_cosine);
  turn.w() = twice_half_cosine * 0.5;
  return turn;
}

}  // namespace insonify
