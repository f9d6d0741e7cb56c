// housing.h -- the sonar's housing in a camera view: a small cylinder.

#pragma once

#include "insonify/sonar_config.h"

namespace insonify {

/// A capped cylinder along the acoustic axis, or upright for a scanning head. The transducer end is darker.
class Housing {
 public:
  /// @param radius  [m]
  Housing(const SonarConfig& sonar, const Pose& world_from_sonar, double radius);

  struct Cut {
    double distance = 0;  ///< From the ray's origin [m]; infinite for a miss.
    Vec3 normal = Vec3::Zero();
    bool transducer = false;
  };
  [[nodiscard]] Cut cut(const Ray& ray) const;

 private:
  Pose housing_from_world_;  // z along the cylinder.
  Pose world_from_housing_;
  double radius_, low_, high_;  // The cylinder reaches from low_ to high_ along z.
  double band_;                 // The transducer is above this z.
};

}  // namespace insonify
