// relief_at.h -- what a relief says of one point of a mesh.

#pragma once

#include "insonify/geometry.h"
#include "insonify/mesh.h"
#include "insonify/relief.h"

namespace insonify {

struct ReliefPoint {
  Vec3f gradient =
      Vec3f::Zero();       ///< Of the height over the surface, along it; mesh frame. The normal is n - gradient.
  float reflectivity = 1;  ///< Of the surface's own, 0..1.
};

/// By the triangle's texture coordinates where there are some and the relief does not prefer positions: the right of
/// the tile is where they grow fastest to the right, its top across that (the tangent frame of Mikkelsen, "Simulation
/// of wrinkled surfaces revisited", 2008, for one triangle). Else by the position in the mesh frame, as seen along each
/// axis, the three blended by the normal's components (Mikkelsen, "Surface gradient-based bump mapping framework",
/// JCGT 9(3), 2020).
/// @param position  On the triangle, mesh frame.
/// @param normal    Unit shading normal, mesh frame.
[[nodiscard]] ReliefPoint relief_at(const Relief& relief, const Mesh& mesh, std::uint32_t triangle,
                                    const Vec3f& position, const Vec3f& normal);

}  // namespace insonify
