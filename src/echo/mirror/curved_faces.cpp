// curved_faces.cpp -- compares the normals of a group of triangles with their mean, and sums their divergence.

#include "echo/mirror/curved_faces.h"

#include <algorithm>
#include <cmath>

#include "echo/mirror/faces.h"

namespace insonify {
namespace {

constexpr float kSamePlane = 0.9994F;  // Cosine of 2 degrees.
constexpr float kTurned = 0.0035F;     // 0.2 degrees [rad].
constexpr float kLeastDivergence = 0.5F;

struct Bend {
  Vec3f mean = Vec3f::Zero();          // Normal, weighted by area.
  float divergence = 0, gradient = 0;  // Integrals over the group [m].
  bool turned = false, curved = false;
};

// Adds the divergence of the vertex normals of a triangle times its area, and the norm of their gradient. The gradient
// of what is f_k at the corners is the sum of f_k (n x e_k) over twice the area, with e_k the side opposite the corner.
void add_turns(const Mesh& mesh, std::size_t triangle, const Vec3f& normal, Bend& bend) {
  const auto& corners = mesh.triangles[triangle];
  Eigen::Matrix3f gradient = Eigen::Matrix3f::Zero();
  for (int k = 0; k < 3; ++k) {
    const Vec3f side = mesh.vertices[corners[(k + 2) % 3]] - mesh.vertices[corners[(k + 1) % 3]];
    const Vec3f& own = mesh.normals[corners[k]];
    const Vec3f outwards = own.dot(bend.mean) < 0 ? Vec3f(-own) : own;
    gradient += 0.5F * outwards * normal.cross(side).transpose();
    bend.turned = bend.turned || (outwards - bend.mean).squaredNorm() > kTurned * kTurned;
  }
  bend.divergence += gradient.trace();
  bend.gradient += gradient.norm();
}

}  // namespace

std::vector<std::uint8_t> curved_faces(const Mesh& mesh, const std::vector<Vec3f>& normals,
                                       const std::vector<std::uint32_t>& face_of, std::size_t count) {
  std::vector<Bend> bends(count);
  const auto for_each_triangle = [&](const auto& visit) {
    for (std::size_t i = 0; i < face_of.size(); ++i) {
      if (face_of[i] != MeshFaces::kNone) {
        visit(i, bends[face_of[i]]);
      }
    }
  };
  for_each_triangle([&](std::size_t i, Bend& own) {
    const auto& [a, b, c] = mesh.triangles[i];
    const float area = (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]).norm();
    own.mean += normals[i].dot(own.mean) < 0 ? Vec3f(-area * normals[i]) : Vec3f(area * normals[i]);
  });
  for (Bend& own : bends) {
    own.mean.normalize();
  }
  for_each_triangle([&](std::size_t i, Bend& own) {
    const auto& [a, b, c] = mesh.triangles[i];
    own.curved = own.curved || std::abs(normals[i].dot(own.mean)) < kSamePlane;
    if (mesh.normals[a] != mesh.normals[b] || mesh.normals[a] != mesh.normals[c]) {
      add_turns(mesh, i, normals[i], own);
    }
  });
  std::vector<std::uint8_t> curved(count);
  std::ranges::transform(bends, curved.begin(), [](const Bend& own) {
    return own.curved || (own.turned && std::abs(own.divergence) > kLeastDivergence * own.gradient) ? 1 : 0;
  });
  return curved;
}

}  // namespace insonify
