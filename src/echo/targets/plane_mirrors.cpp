// plane_mirrors.cpp -- groups flat triangles by their planes, the largest triangles first.

#include "echo/targets/plane_mirrors.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "echo/mirror/faces.h"

namespace insonify {
namespace {

constexpr double kSameDirection = 1e-3;  // Largest angle between normals of one mirror's triangles [rad].

// Normals are flipped to this side. No plane of a real scene contains this direction.
const Vec3 kTowards(0.2672612419, 0.5345224838, 0.8017837257);

struct FlatTriangle {
  PlaneMirror::Triangle triangle;
  Vec3 normal;
  double area;
};

void add_flat_triangles(const Instance& instance, int index, const Pose& frame, std::vector<FlatTriangle>& flat) {
  const Mesh& mesh = *instance.mesh;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& vertices = mesh.triangles[t];
    const Vec3f area = 0.5F * (mesh.vertices[vertices[1]] - mesh.vertices[vertices[0]])
                                  .cross(mesh.vertices[vertices[2]] - mesh.vertices[vertices[0]]);
    const float size = area.norm();
    const std::size_t slot = mesh.slot_of(t);
    const bool relief = slot < instance.reliefs.size() && instance.reliefs[slot] != nullptr;
    if (!(size > 0) || relief || !is_flat(mesh, t, area / size)) {
      continue;
    }
    FlatTriangle one;
    for (int k = 0; k < 3; ++k) {
      one.triangle.corners[k] = frame * mesh.vertices[vertices[k]].cast<double>().eval();
    }
    const auto& [a, b, c] = one.triangle.corners;
    one.normal = (b - a).cross(c - a).normalized();
    one.triangle.front = one.normal.dot(kTowards) > 0;
    one.normal *= one.triangle.front ? 1 : -1;
    one.triangle.surface = surface_label(static_cast<std::uint16_t>(index), instance.materials[slot]);
    one.area = double{size};
    flat.push_back(one);
  }
}

// Hash table of planes by normal and offset, which finds planes within the tolerances.
class PlaneTable {
 public:
  // Index of the mirror in whose plane a triangle lies; -1 if there is none yet.
  [[nodiscard]] int find(const FlatTriangle& one, const std::vector<PlaneMirror>& mirrors) const {
    const std::array<double, 4> place = place_of(one.normal, one.normal.dot(one.triangle.corners[0]));
    for (int choice = 0; choice < 16; ++choice) {
      std::array<double, 4> near = place;
      bool is_new = true;
      for (int k = 0; k < 4; ++k) {
        near[k] += (choice >> k & 1) == 0 ? -kNear : kNear;
        is_new = is_new && ((choice >> k & 1) == 0 || std::floor(near[k]) != std::floor(place[k] - kNear));
      }
      if (!is_new) {
        continue;
      }
      const auto [first, last] = cells_.equal_range(key_of(near));
      for (auto cell = first; cell != last; ++cell) {
        const PlaneMirror& mirror = mirrors[cell->second];
        const bool flush = std::ranges::all_of(one.triangle.corners, [&](const Vec3& corner) {
          return std::abs(mirror.normal.dot(corner) - mirror.offset) < PlaneMirror::kFlush;
        });
        if (flush && mirror.normal.cross(one.normal).norm() < kSameDirection) {
          return static_cast<int>(cell->second);
        }
      }
    }
    return -1;
  }

  void add(const PlaneMirror& mirror, std::size_t index) {
    cells_.emplace(key_of(place_of(mirror.normal, mirror.offset)), index);
  }

 private:
  // Width of a cell in tolerances, and its inverse.
  static constexpr double kWide = 8, kNear = 1 / kWide;

  static std::array<double, 4> place_of(const Vec3& normal, double offset) {
    const Vec3 place = normal / (kWide * kSameDirection);
    return {place.x(), place.y(), place.z(), offset / (kWide * PlaneMirror::kFlush)};
  }
  static std::uint64_t key_of(const std::array<double, 4>& place) {
    std::uint64_t key = 0;
    for (const double x : place) {
      key = key * 0x9e3779b97f4a7c15U + static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(x)));
    }
    return key;
  }

  std::unordered_multimap<std::uint64_t, std::size_t> cells_;
};

void add_to(PlaneMirror& mirror, const FlatTriangle& one) {
  for (const Vec3& corner : one.triangle.corners) {
    mirror.low = mirror.low.cwiseMin(corner);
    mirror.high = mirror.high.cwiseMax(corner);
  }
  mirror.area += one.area;
  mirror.triangles.push_back(one.triangle);
}

}  // namespace

const PlaneMirror::Triangle* PlaneMirror::triangle_at(const Vec3& point, double margin) const {
  for (const Triangle& triangle : triangles) {
    const Vec3 out = triangle.front ? normal : Vec3(-normal);
    bool inside = true;
    for (int k = 0; inside && k < 3; ++k) {
      const Vec3 side = triangle.corners[(k + 1) % 3] - triangle.corners[k];
      inside = out.dot(side.cross(point - triangle.corners[k])) > -margin * side.norm();
    }
    if (inside) {
      return &triangle;
    }
  }
  return nullptr;
}

std::vector<PlaneMirror> find_plane_mirrors(const Scene& scene, int instance) {
  std::vector<FlatTriangle> flat;
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& each = scene.instances[i];
    const auto index = static_cast<int>(i);
    if (each.present && !each.endless && (instance < 0 ? !each.moving : index == instance)) {
      add_flat_triangles(each, index, instance < 0 ? each.world_from_mesh : Pose{}, flat);
    }
  }
  // A plane takes the normal of its largest triangle, which is the most accurate.
  std::ranges::stable_sort(flat, std::greater<>(), &FlatTriangle::area);
  std::vector<PlaneMirror> mirrors;
  PlaneTable table;
  for (const FlatTriangle& one : flat) {
    const int found = table.find(one, mirrors);
    if (found >= 0) {
      add_to(mirrors[found], one);
      continue;
    }
    PlaneMirror mirror;
    mirror.normal = one.normal;
    mirror.offset = one.normal.dot(one.triangle.corners[0]);
    mirror.low = mirror.high = one.triangle.corners[0];
    add_to(mirror, one);
    table.add(mirror, mirrors.size());
    mirrors.push_back(std::move(mirror));
  }
  std::erase_if(mirrors, [](const PlaneMirror& mirror) { return mirror.area < PlaneMirror::kLeastArea; });
  std::ranges::stable_sort(mirrors, std::greater<>(), &PlaneMirror::area);
  if (mirrors.size() > PlaneMirror::kMostMirrors) {
    mirrors.resize(PlaneMirror::kMostMirrors);
  }
  return mirrors;
}

}  // namespace insonify
