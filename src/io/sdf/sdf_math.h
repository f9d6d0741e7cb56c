// sdf_math.h -- the vectors and poses of libsdformat: from Gazebo's library since version 13, from Ignition's before.

#pragma once

#include <sdf/sdf_config.h>

#if SDF_MAJOR_VERSION >= 13
#include <gz/math/Pose3.hh>
namespace insonify {
namespace sdf_math = gz::math;
}
#else
#include <ignition/math/Pose3.hh>
namespace insonify {
namespace sdf_math = ignition::math;
}
#endif
