// stonefish_torus.h -- a torus, which only Stonefish has.

#pragma once

#include "insonify/mesh.h"

namespace insonify {

/// Centred on the origin, its axis along y. `max_edge_angle` bounds the angle between neighbouring normals [rad].
/// @param major  Radius of the circle in the middle of the tube [m], > 0.
/// @param minor  Radius of the tube [m], > 0.
[[nodiscard]] Mesh make_torus(double major, double minor, double max_edge_angle = 0.05);

}  // namespace insonify
