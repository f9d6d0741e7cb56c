// find_compact_bodies.cpp -- finds the smooth surfaces that are about as long as they are thick, such as balls.

#include <algorithm>
#include <numeric>

#include "echo/thin/thin_parts.h"

namespace insonify {
namespace {

constexpr float kCompact = 2;   // Most that the greatest extent is of the least.
constexpr float kTurned = 0.5;  // Least change of the normal within a surface, as a difference of unit vectors.

// Sets of vertices that triangles connect (union-find, with paths halved).
class Connected {
 public:
  explicit Connected(const Mesh& mesh) : parent_(mesh.vertices.size()) {
    std::iota(parent_.begin(), parent_.end(), 0U);
    for (const auto& corners : mesh.triangles) {
      join(corners[0], corners[1]);
      join(corners[1], corners[2]);
    }
  }

  std::uint32_t root(std::uint32_t vertex) {
    while (parent_[vertex] != vertex) {
      vertex = parent_[vertex] = parent_[parent_[vertex]];
    }
    return vertex;
  }

 private:
  // Under the lower one, so that a root is the first vertex of its set.
  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

  std::vector<std::uint32_t> parent_;
};

// What is known of the smooth surface with a given root.
struct Surface {
  Eigen::AlignedBox3f box;
  float area = 0, volume = 0;  // [m^2, m^3]; the volume is negative if the triangles are wound inwards.
  bool turned = false, has_relief = false;
  int body = -1;

  [[nodiscard]] bool is_compact() const {
    const Vec3f size = box.sizes();
    const float of_box = 2 * (size.x() * size.y() + size.y() * size.z() + size.z() * size.x());
    // What is convex has no more surface than its box; the parts of what is not may hide each other.
    return turned && !has_relief && size.maxCoeff() <= kCompact * size.minCoeff() && area <= of_box;
  }
  // Second smallest extent [m].
  [[nodiscard]] float thickness() const {
    const Vec3f size = box.sizes();
    return size.sum() - size.maxCoeff() - size.minCoeff();
  }
};

}  // namespace

std::vector<ThinTriangle> find_compact_bodies(const Instance& instance, const std::vector<std::uint32_t>& first_of) {
  const Mesh& mesh = *instance.mesh;
  Connected connected(mesh);
  std::vector<Surface> surfaces(mesh.vertices.size());  // [root]
  const auto surface_of = [&](std::uint32_t t) -> Surface& { return surfaces[connected.root(mesh.triangles[t][0])]; };
  std::vector<std::uint8_t> repeated(first_of.size(), 0);
  for (std::uint32_t t = 0; t < first_of.size(); ++t) {
    if (first_of[t] != t) {
      repeated[first_of[t]] = 1;
    }
  }
  // The surface is the first of the triangles that cover each other, but not one that is wound inwards.
  const auto is_copy = [&](std::uint32_t t) {
    return !first_of.empty() &&
           (first_of[t] == t ? repeated[t] != 0 && surface_of(t).volume < 0
                             : &surface_of(t) == &surface_of(first_of[t]) || !(surface_of(first_of[t]).volume < 0));
  };
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& corners = mesh.triangles[t];
    const std::uint32_t root = connected.root(corners[0]);
    Surface& surface = surfaces[root];
    const Vec3f &a = mesh.vertices[corners[0]], &b = mesh.vertices[corners[1]], &c = mesh.vertices[corners[2]];
    surface.box.extend(a).extend(b).extend(c);
    const bool again = !first_of.empty() && first_of[t] != t && connected.root(mesh.triangles[first_of[t]][0]) == root;
    surface.area += again ? 0 : 0.5F * (b - a).cross(c - a).norm();
    const Vec3f& from = mesh.vertices[root];
    surface.volume += (a - from).dot((b - from).cross(c - from)) / 6;
    surface.turned =
        surface.turned || (mesh.normals[corners[0]] - mesh.normals[root]).squaredNorm() > kTurned * kTurned;
    const std::size_t slot = mesh.slot_of(t);
    surface.has_relief = surface.has_relief || (slot < instance.reliefs.size() && instance.reliefs[slot] != nullptr);
  }
  std::vector<ThinTriangle> found;
  int bodies = 0;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    Surface& surface = surface_of(t);
    if (surface.body < 0 && surface.is_compact()) {
      surface.body = bodies++;
    }
    if (surface.body >= 0) {
      found.push_back({t, surface.thickness(), 0, surface.body, is_copy(t)});
    }
  }
  return found;
}

}  // namespace insonify
