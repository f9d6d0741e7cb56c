// relief_at.cpp -- evaluates a relief at a point, mapped by texture coordinates or by position.

#include "scene/relief_at.h"

#include <cmath>

namespace insonify {
namespace {

using Vec2f = Eigen::Vector2f;

// Texture coordinates at a point of a triangle, and their derivatives.
struct TextureFrame {
  Vec2f at;            // Texture coordinates of the point.
  Vec3f right, up;     // Derivatives of position by the two texture coordinates [m per tile].
  bool usable = true;  // False if the texture coordinates are degenerate on the triangle.
};

TextureFrame texture_frame(const Mesh& mesh, std::uint32_t triangle, const Vec3f& position) {
  const auto& corners = mesh.triangles[triangle];
  const auto& texture = mesh.texture_coordinates[triangle];
  const Vec3f origin = mesh.vertices[corners[0]];
  const Vec3f edge1 = mesh.vertices[corners[1]] - origin, edge2 = mesh.vertices[corners[2]] - origin;
  const Vec2f step1 = texture[1] - texture[0], step2 = texture[2] - texture[0];
  const float determinant = step1.x() * step2.y() - step2.x() * step1.y();
  // Triangles that cover less than this area of the picture have no usable texture coordinates.
  constexpr float kLeast = 1e-12F;
  if (!(std::abs(determinant) > kLeast) || !std::isfinite(determinant)) {
    return {{}, {}, {}, false};
  }
  const Vec3f across = edge1.cross(edge2);
  const float scale = 1 / across.squaredNorm();
  const Vec3f from_origin = position - origin;
  const float weight1 = scale * across.dot(from_origin.cross(edge2));
  const float weight2 = scale * across.dot(edge1.cross(from_origin));
  const Vec2f at = texture[0] + weight1 * step1 + weight2 * step2;
  return {at, (edge1 * step2.y() - edge2 * step1.y()) / determinant,
          (edge2 * step1.x() - edge1 * step2.x()) / determinant, at.allFinite()};
}

Vec3f gradient_in(const TextureFrame& frame, const Relief& relief, const Vec3f& normal) {
  const Vec2f slope = relief.slopes.at(frame.at.x(), frame.at.y());
  if (relief.rise_per_tile) {
    // Gradient of the height, by the reciprocal basis of `right` and `up`.
    const float volume = normal.dot(frame.right.cross(frame.up));
    return (slope.x() * frame.up.cross(normal) + slope.y() * normal.cross(frame.right)) / volume;
  }
  const Vec3f right = (frame.right - normal * normal.dot(frame.right)).normalized();
  const Vec3f across = normal.cross(right);
  const Vec3f up = across.dot(frame.up) < 0 ? Vec3f(-across) : across;
  return slope.x() * right + slope.y() * up;
}

ReliefPoint by_texture(const Relief& relief, const TextureFrame& frame, const Vec3f& normal) {
  ReliefPoint point;
  if (!relief.slopes.empty()) {
    const Vec3f gradient = gradient_in(frame, relief, normal);
    point.gradient = gradient.allFinite() ? gradient : Vec3f::Zero();
  }
  if (!relief.reflectivity.empty()) {
    point.reflectivity = relief.reflectivity.at(frame.at.x(), frame.at.y());
  }
  return point;
}

// A projection along one axis of the mesh frame, and the axes that are right and up in it.
struct View {
  int along, right, up;
};
constexpr View kViews[] = {{0, 1, 2}, {1, 0, 2}, {2, 0, 1}};

// Triplanar mapping: the tile is projected along each axis, and the three results are blended by the fourth powers of
// the normal's components.
ReliefPoint by_position(const Relief& relief, const Vec3f& position, const Vec3f& normal) {
  const Vec3f squares = normal.cwiseAbs2();
  const Vec3f shares = squares.cwiseAbs2() / squares.cwiseAbs2().sum();
  constexpr float kLeastShare = 0.01F;
  const auto tiles_a_metre = static_cast<float>(1 / relief.tile_size);
  ReliefPoint point;
  Vec3f gradient = Vec3f::Zero();
  float reflectivity = 0, sum = 0;
  for (const View& view : kViews) {
    const float share = shares[view.along];
    if (share < kLeastShare) {
      continue;
    }
    const float u = position[view.right] * tiles_a_metre, v = position[view.up] * tiles_a_metre;
    sum += share;
    if (!relief.slopes.empty()) {
      const Vec2f slope = relief.slopes.at(u, v);
      gradient[view.right] += share * slope.x();
      gradient[view.up] += share * slope.y();
    }
    if (!relief.reflectivity.empty()) {
      reflectivity += share * relief.reflectivity.at(u, v);
    }
  }
  gradient *= (relief.rise_per_tile ? tiles_a_metre : 1.0F) / sum;
  point.gradient = gradient - normal * normal.dot(gradient);
  point.reflectivity = relief.reflectivity.empty() ? 1.0F : reflectivity / sum;
  return point;
}

}  // namespace

ReliefPoint relief_at(const Relief& relief, const Mesh& mesh, std::uint32_t triangle, const Vec3f& position,
                      const Vec3f& normal) {
  if (!relief.by_position && !mesh.texture_coordinates.empty()) {
    if (const TextureFrame frame = texture_frame(mesh, triangle, position); frame.usable) {
      return by_texture(relief, frame, normal);
    }
  }
  return relief.tile_size > 0 ? by_position(relief, position, normal) : ReliefPoint{};
}

}  // namespace insonify
