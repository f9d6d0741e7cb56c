// relief_at.h -- evaluates a relief (slope and reflectivity) at a point of a mesh.

#pragma once

#include "insonify/geometry.h"
#include "insonify/mesh.h"
#include "insonify/relief.h"

namespace insonify {

/// Relief at one point.
struct ReliefPoint {
  Vec3f gradient = Vec3f::Zero();  ///< Surface gradient of the relief's height, in the tangent plane, mesh frame. The
                                   ///< tilted normal is along n - gradient.
  float reflectivity = 1;          ///< Factor on the surface's reflectivity, 0..1.
};

/// Maps the relief by the triangle's texture coordinates, if it has any and the relief is not by_position. The right of
/// the tile is then the direction in which the first coordinate grows fastest, and its top is normal to that (the
/// tangent frame of Mikkelsen, "Simulation of wrinkled surfaces revisited", 2008, for one triangle). Otherwise maps it
/// by position in the mesh frame: projected along each of the three axes, and blended by the components of the normal
/// (Mikkelsen, "Surface gradient-based bump mapping framework", JCGT 9(3), 2020).
/// @param position  Point on the triangle, mesh frame.
/// @param normal    Unit shading normal, mesh frame.
[[nodiscard]] ReliefPoint relief_at(const Relief& relief, const Mesh& mesh, std::uint32_t triangle,
                                    const Vec3f& position, const Vec3f& normal);

}  // namespace insonify
