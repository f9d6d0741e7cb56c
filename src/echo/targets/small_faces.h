// small_faces.h -- plane faces up to a metre wide, as strips whose echo does not depend on the samples that hit them.

#pragma once

#include "base/parallel.h"
#include "echo/thin/thin_parts.h"

namespace insonify {

/// Adds the small plane faces of a scene to its thin parts. Where one is less than four samples wide, and turned
/// towards the sonar by its edge, no sample may hit it. Left out are faces of thin parts, those that fill less than
/// 0.45 of their bounding rectangle, such as frames, and all faces of an instance with more than 16 small ones.
/// @param engine    Has the scene.
/// @param left_out  Of find_thin_parts() and find_glinting_faces(); receives the widths of small faces as thickness.
void add_small_faces(const Scene& scene, Engine& engine, Workers& workers, LeftOut& left_out, ThinParts& parts);

}  // namespace insonify
