// plane_mirrors.cpp -- groups flat triangles by their planes, the largest triangles first.

#include "echo/targets/plane_mirrors.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <utility>

#include "base/parallel_blocks.h"
#include "echo/mirror/faces.h"
#include "scene/alike.h"

namespace insonify {
namespace {

constexpr double kSameDirection = 1e-3;  // Largest angle between normals of one mirror's triangles [rad].

// Normals are flipped to this side. No plane of a real scene contains this direction.
const Vec3 kTowards(0.2672612419, 0.5345224838, 0.8017837257);

constexpr std::uint32_t kNone = 0xffffffff;

struct FlatTriangle {
  std::uint32_t instance, triangle;
  float area;
};

// A flat triangle in the frame of the mirrors.
struct PlacedTriangle {
  PlaneMirror::Triangle triangle;
  Vec3 normal;
};

void add_flat_triangles(const Instance& instance, std::uint32_t index, Workers& workers,
                        std::vector<FlatTriangle>& flat) {
  const Mesh& mesh = *instance.mesh;
  std::vector<float> sizes(mesh.triangles.size(), 0);  // 0 where they are not flat.
  for_each_block(workers, sizes.size(), 1 << 14, [&](std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last; ++t) {
      const auto& vertices = mesh.triangles[t];
      const Vec3f area = 0.5F * (mesh.vertices[vertices[1]] - mesh.vertices[vertices[0]])
                                    .cross(mesh.vertices[vertices[2]] - mesh.vertices[vertices[0]]);
      const float size = area.norm();
      const std::size_t slot = mesh.slot_of(t);
      const bool relief = slot < instance.reliefs.size() && instance.reliefs[slot] != nullptr;
      sizes[t] = size > 0 && !relief && is_flat(mesh, t, area / size) ? size : 0;
    }
  });
  for (std::uint32_t t = 0; t < sizes.size(); ++t) {
    if (sizes[t] > 0) {
      flat.push_back({index, t, sizes[t]});
    }
  }
}

bool is_used(const Instance& instance) {
  return instance.present && !instance.endless;
}

// Those of all static instances.
std::vector<FlatTriangle> flat_triangles(const Scene& scene, Workers& workers) {
  std::vector<FlatTriangle> flat;
  const std::vector<std::size_t> first = first_alike(scene);
  std::vector<std::pair<std::size_t, std::size_t>> own(first.size());  // [instance] The range of its triangles.
  for (std::size_t i = 0; i < first.size(); ++i) {
    const Instance& instance = scene.instances[i];
    if (!is_used(instance) || instance.moving) {
      continue;
    }
    own[i].first = flat.size();
    if (first[i] == i || scene.instances[first[i]].moving) {
      add_flat_triangles(instance, static_cast<std::uint32_t>(i), workers, flat);
    } else {
      for (std::size_t k = own[first[i]].first; k < own[first[i]].second; ++k) {
        flat.push_back({static_cast<std::uint32_t>(i), flat[k].triangle, flat[k].area});
      }
    }
    own[i].second = flat.size();
  }
  return flat;
}

PlacedTriangle placed(const Scene& scene, const FlatTriangle& one, bool in_world) {
  const Instance& instance = scene.instances[one.instance];
  const Pose frame = in_world ? instance.world_from_mesh : Pose{};
  PlacedTriangle placed;
  for (int k = 0; k < 3; ++k) {
    const Vec3f& vertex = instance.mesh->vertices[instance.mesh->triangles[one.triangle][k]];
    placed.triangle.corners[k] = frame * vertex.cast<double>().eval();
  }
  const auto& [a, b, c] = placed.triangle.corners;
  placed.normal = (b - a).cross(c - a).normalized();
  placed.triangle.front = placed.normal.dot(kTowards) > 0;
  placed.normal *= placed.triangle.front ? 1 : -1;
  placed.triangle.surface =
      surface_label(static_cast<std::uint16_t>(one.instance), instance.materials[instance.mesh->slot_of(one.triangle)]);
  return placed;
}

// Keys of the cells of a PlaneTable in which the plane of a triangle may be.
struct PlaneKeys {
  std::array<std::uint64_t, 16> near;
  std::size_t count = 0;
  std::uint64_t own = 0;  // Key of the cell that the plane itself lies in.
};

// Planes in a hash table by normal and offset, which finds those within the tolerances.
class PlaneTable {
 public:
  struct Plane {
    Vec3 normal;
    double offset, area;
    std::uint64_t key;
    std::uint32_t next, triangles;  // The plane that was added before at the same head; number of triangles.
  };

  [[nodiscard]] static PlaneKeys keys_of(const PlacedTriangle& one) {
    const std::array<double, 4> place = place_of(one.normal, one.normal.dot(one.triangle.corners[0]));
    PlaneKeys keys;
    keys.own = key_of(place);
    for (int choice = 0; choice < 16; ++choice) {
      std::array<double, 4> near = place;
      bool is_new = true;
      for (int k = 0; k < 4; ++k) {
        near[k] += (choice >> k & 1) == 0 ? -kNear : kNear;
        is_new = is_new && ((choice >> k & 1) == 0 || std::floor(near[k]) != std::floor(place[k] - kNear));
      }
      if (is_new) {
        keys.near[keys.count++] = key_of(near);
      }
    }
    return keys;
  }

  // Adds a triangle to the plane in which it lies, or to a new one; returns the plane's number.
  std::uint32_t add(const PlacedTriangle& one, const PlaneKeys& keys, float area) {
    std::uint32_t plane = find(one, keys);
    if (plane == kNone) {
      plane = static_cast<std::uint32_t>(planes_.size());
      planes_.push_back({one.normal, one.normal.dot(one.triangle.corners[0]), 0, keys.own, kNone, 0});
      if (planes_.size() > heads_.size()) {
        heads_.assign(2 * heads_.size(), kNone);
        for (std::uint32_t i = 0; i < plane; ++i) {
          link(i);
        }
      }
      link(plane);
    }
    planes_[plane].area += double{area};
    ++planes_[plane].triangles;
    return plane;
  }

  [[nodiscard]] const std::vector<Plane>& planes() const { return planes_; }

 private:
  // Width of a cell in tolerances, and its inverse.
  static constexpr double kWide = 8, kNear = 1 / kWide;

  [[nodiscard]] std::uint32_t find(const PlacedTriangle& one, const PlaneKeys& keys) {
    for (std::size_t k = 0; k < keys.count; ++k) {
      for (std::uint32_t i = head_of(keys.near[k]); i != kNone; i = planes_[i].next) {
        if (planes_[i].key == keys.near[k] && holds(planes_[i], one)) {
          return i;
        }
      }
    }
    return kNone;
  }

  void link(std::uint32_t plane) { planes_[plane].next = std::exchange(head_of(planes_[plane].key), plane); }

  static bool holds(const Plane& plane, const PlacedTriangle& one) {
    const bool flush = std::ranges::all_of(one.triangle.corners, [&](const Vec3& corner) {
      return std::abs(plane.normal.dot(corner) - plane.offset) < PlaneMirror::kFlush;
    });
    return flush && plane.normal.cross(one.normal).norm() < kSameDirection;
  }

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

  [[nodiscard]] std::uint32_t& head_of(std::uint64_t key) {
    return heads_[(key ^ key >> 32) * 0x9e3779b97f4a7c15U >> 32 & (heads_.size() - 1)];
  }

  std::vector<std::uint32_t> heads_ = std::vector<std::uint32_t>(1 << 10, kNone);  // As many as planes, or more.
  std::vector<Plane> planes_;
};

// Prepares make(i) on all threads for those numbers below `count` for which wanted(i), and calls use(i, made) in order.
template <typename Made, typename Wanted, typename Make, typename Use>
void prepare(std::size_t count, Workers& workers, const Wanted& wanted, const Make& make, const Use& use) {
  constexpr std::size_t kMadeTogether = 1 << 13, kTask = 1 << 9;
  std::vector<Made> made(std::min(count, kMadeTogether));
  for (std::size_t start = 0; start < count; start += kMadeTogether) {
    const std::size_t some = std::min(kMadeTogether, count - start);
    for_each_block(workers, some, kTask, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        if (wanted(start + i)) {
          made[i] = make(start + i);
        }
      }
    });
    for (std::size_t i = 0; i < some; ++i) {
      if (wanted(start + i)) {
        use(start + i, made[i]);
      }
    }
  }
}

// [flat triangle] Number of its plane. A plane takes the normal of its first triangle.
std::vector<std::uint32_t> planes_of(const Scene& scene, const std::vector<FlatTriangle>& flat, bool in_world,
                                     Workers& workers, PlaneTable& table) {
  std::vector<std::uint32_t> plane_of(flat.size());
  const auto make = [&](std::size_t i) {
    const PlacedTriangle one = placed(scene, flat[i], in_world);
    return std::pair(one, PlaneTable::keys_of(one));
  };
  prepare<std::pair<PlacedTriangle, PlaneKeys>>(
      flat.size(), workers, [](std::size_t) { return true; }, make,
      [&](std::size_t i, const auto& one) { plane_of[i] = table.add(one.first, one.second, flat[i].area); });
  return plane_of;
}

// The planes that become mirrors, largest first.
std::vector<std::uint32_t> largest(const std::vector<PlaneTable::Plane>& planes) {
  std::vector<std::uint32_t> chosen;
  for (std::uint32_t i = 0; i < planes.size(); ++i) {
    if (planes[i].area >= PlaneMirror::kLeastArea) {
      chosen.push_back(i);
    }
  }
  std::ranges::stable_sort(chosen, std::greater<>(), [&](std::uint32_t i) { return planes[i].area; });
  chosen.resize(std::min(chosen.size(), PlaneMirror::kMostMirrors));
  return chosen;
}

}  // namespace

bool PlaneMirror::contains(const Triangle& triangle, const Vec3& point, double margin) const {
  const Vec3 out = triangle.front ? normal : Vec3(-normal);
  for (int k = 0; k < 3; ++k) {
    const Vec3 side = triangle.corners[(k + 1) % 3] - triangle.corners[k];
    if (!(out.dot(side.cross(point - triangle.corners[k])) > -margin * side.norm())) {
      return false;
    }
  }
  return true;
}

void PlaneMirror::add(const Triangle& triangle) {
  if (triangles.empty()) {
    low = high = triangle.corners[0];
  }
  for (const Vec3& corner : triangle.corners) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  triangles.push_back(triangle);
}

const PlaneMirror::Triangle* PlaneMirror::triangle_at(const Vec3& point, double margin) const {
  const auto found =
      std::ranges::find_if(triangles, [&](const Triangle& triangle) { return contains(triangle, point, margin); });
  return found == triangles.end() ? nullptr : &*found;
}

std::vector<PlaneMirror> find_plane_mirrors(const Scene& scene, int instance, Workers& workers) {
  std::vector<FlatTriangle> flat = instance < 0 ? flat_triangles(scene, workers) : std::vector<FlatTriangle>();
  if (instance >= 0 && is_used(scene.instances[instance])) {
    add_flat_triangles(scene.instances[instance], static_cast<std::uint32_t>(instance), workers, flat);
  }
  // A plane takes the normal of its largest triangle, which is the most accurate.
  parallel_sort(workers, flat, [](const FlatTriangle& a, const FlatTriangle& b) {
    return std::tuple(-a.area, a.instance, a.triangle) < std::tuple(-b.area, b.instance, b.triangle);
  });
  PlaneTable table;
  const std::vector<std::uint32_t> plane_of = planes_of(scene, flat, instance < 0, workers, table);
  const std::vector<PlaneTable::Plane>& planes = table.planes();
  const std::vector<std::uint32_t> chosen = largest(planes);
  std::vector<std::uint32_t> mirror_of(planes.size(), kNone);
  std::vector<PlaneMirror> mirrors(chosen.size());
  for (std::uint32_t i = 0; i < chosen.size(); ++i) {
    const PlaneTable::Plane& plane = planes[chosen[i]];
    mirror_of[chosen[i]] = i;
    mirrors[i].normal = plane.normal;
    mirrors[i].offset = plane.offset;
    mirrors[i].area = plane.area;
    mirrors[i].triangles.reserve(plane.triangles);
  }
  prepare<PlaneMirror::Triangle>(
      flat.size(), workers, [&](std::size_t i) { return mirror_of[plane_of[i]] != kNone; },
      [&](std::size_t i) { return placed(scene, flat[i], instance < 0).triangle; },
      [&](std::size_t i, const PlaneMirror::Triangle& triangle) { mirrors[mirror_of[plane_of[i]]].add(triangle); });
  return mirrors;
}

}  // namespace insonify
