// bench_scene.h -- scene and sonar of the engine benchmarks.

#pragma once

#include "insonify/scene.h"
#include "insonify/sonar_config.h"

namespace insonify {

/// A sea bed of 50 x 60 m (40 % of the triangles), a quay wall at 18 m (10 %) and 24 spheres, boxes, cylinders and
/// cones at 4 to 16 m (50 %); the bed 3 m below the origin, where the sonar is. Materials are assigned.
[[nodiscard]] Scene make_bench_scene(int triangle_count);

/// 256 beams x 500 bins, 120 x 20 degrees, 20 m, pitched down 10 degrees.
[[nodiscard]] SonarConfig bench_sonar();

}  // namespace insonify
