// trihedral.h -- a corner of three mirrors, as tests use it.

#pragma once

#include "insonify/mesh.h"

namespace insonify {

/// Three triangles or squares with edges of one length along the axes, as one mesh.
inline Mesh trihedral(double edge, bool square) {
  const auto a = static_cast<float>(edge);
  Mesh mesh;
  for (int k = 0; k < 3; ++k) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    const Vec3f one = a * Vec3f::Unit((k + 1) % 3), two = a * Vec3f::Unit((k + 2) % 3);
    for (const Vec3f& vertex : {Vec3f(Vec3f::Zero()), one, two, Vec3f(one + two)}) {
      mesh.vertices.push_back(vertex);
      mesh.normals.emplace_back(Vec3f::Unit(k));
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
    if (square) {
      mesh.triangles.push_back({first + 1, first + 3, first + 2});
    }
  }
  return mesh;
}

}  // namespace insonify
