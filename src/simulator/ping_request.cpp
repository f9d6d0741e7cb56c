// ping_request.cpp -- validates ping requests.

#include "insonify/ping_request.h"

#include <fmt/format.h>

#include <cmath>

#include "insonify/error.h"
#include "insonify/field.h"
#include "simulator/checks.h"

namespace insonify {
namespace {

// Ten times the error of a quaternion in single precision, in which many programs keep poses.
constexpr double kNormTolerance = 1e-6;

void check_vector(std::string_view object, const Field& field, const Vec3& vector) {
  for (int axis = 0; axis < 3; ++axis) {
    check_field(object, field, vector[axis], axis);
  }
}

void check_moved(const MovedObject& moved, std::size_t index) {
  try {
    if (moved.name.empty() == (moved.instance < 0)) {
      throw Error(moved.name.empty() ? " must have a name or an instance"
                                     : " must have a name or an instance, not both");
    }
    check_pose(".world_from_object", moved.world_from_object);
  } catch (const Error& error) {
    throw Error(fmt::format("moved[{}]{}", index, error.what()));
  }
}

}  // namespace

void check_pose(std::string_view object, const Pose& pose) {
  check_vector(object, {"position", "m", coordinate(), ""}, pose.position);
  const double norm = pose.orientation.norm();
  if (!(std::abs(norm - 1) <= kNormTolerance)) {
    throw Error(fmt::format("{}.orientation must be a unit quaternion; the norm of this one is {:.10g}", object, norm));
  }
}

void PingRequest::validate() const {
  check_field("", {"time", "s", kPingTimes, ""}, time);
  check_pose("world_from_vehicle", world_from_vehicle);
  check_vector("twist", {"linear", "m/s", any_number(), ""}, twist.linear);
  check_vector("twist", {"angular", "rad/s", any_number(), ""}, twist.angular);
  for (std::size_t i = 0; i < moved.size(); ++i) {
    check_moved(moved[i], i);
  }
  if (head_angle) {
    check_field("", {"head_angle", "", any_number(), ""}, *head_angle);  // In radians; a head may turn on and on.
  }
}

}  // namespace insonify
