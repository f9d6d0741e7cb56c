// piping.h -- bent pipes, flanges, beams and anodes: what steelwork under water is put together from.

#pragma once

#include <string>
#include <vector>

#include "kit/kit.h"
#include "kit/shape.h"

namespace modelling {

/// A path through corners, each rounded by an arc that starts at most `radius` before it [m].
[[nodiscard]] std::vector<Vec3> bent_path(const std::vector<Vec3>& corners, double radius);

/// A pipe bent round its corners, closed at both ends.
[[nodiscard]] Shape bent_pipe(const std::string& material, const std::vector<Vec3>& corners, double pipe_radius,
                              double bend_radius, int sides = 16);

/// A pair of flanges with their bolts, about the origin, axis along z. `pipe_radius` [m] gives the size.
[[nodiscard]] Shape make_flange_pair(const std::string& material, double pipe_radius);

/// A rolled I section from one point to another, its web upright (or along x where the beam is upright).
[[nodiscard]] Shape i_beam(const std::string& material, const Vec3& from, const Vec3& to, double height, double width);

/// A stand-off anode of aluminium, along x, its bar 0.12 m above z = 0 on two bent rods.
[[nodiscard]] Shape make_anode(double length);

/// Turns z to `direction` and puts the origin at `position`. x comes as near to the world's x or y as it can.
[[nodiscard]] Pose along_axis(const Vec3& position, const Vec3& direction);

}  // namespace modelling
