// reliefs.cpp -- sorts hits by their relief, and evaluates those of one relief together, in vector loops.

#include "echo/model/reliefs.h"

#include <algorithm>

#include "base/vector_math.h"
#include "echo/model/map_relief.h"

namespace insonify {
namespace {

// A rotation in rows.
struct Turn {
  Triple x, y, z;
};

Triple turned(const Turn& turn, Triple v) {
  return {inner(turn.x, v), inner(turn.y, v), inner(turn.z, v)};
}

Turn turn_of(const Eigen::Matrix3f& matrix) {
  return {triple_of(matrix.row(0)), triple_of(matrix.row(1)), triple_of(matrix.row(2))};
}

// Points in the mesh's frame. Lanes that are not `own` repeat lane `first`.
INSONIFY_VECTOR_CLONES
void to_mesh(const ReliefHits& __restrict__ hits, const std::int32_t* __restrict__ own, int first, Turn turn,
             Triple offset, MeshPoints& __restrict__ points) {
  const std::uint32_t triangle = hits.triangle[first];
  const Triple point = {hits.x[first], hits.y[first], hits.z[first]};
  const Triple normal = {hits.normal_x[first], hits.normal_y[first], hits.normal_z[first]};
  for (int lane = 0; lane < kHitLanes; ++lane) {
    const bool is_own = own[lane] != 0;
    points.triangle[lane] = is_own ? hits.triangle[lane] : triangle;
    const Triple at = turned(turn, {is_own ? hits.x[lane] : point.x, is_own ? hits.y[lane] : point.y,
                                    is_own ? hits.z[lane] : point.z}) +
                      offset;
    const Triple unit =
        direction_of(turned(turn, {is_own ? hits.normal_x[lane] : normal.x, is_own ? hits.normal_y[lane] : normal.y,
                                   is_own ? hits.normal_z[lane] : normal.z}));
    points.x[lane] = at.x;
    points.y[lane] = at.y;
    points.z[lane] = at.z;
    points.normal_x[lane] = unit.x;
    points.normal_y[lane] = unit.y;
    points.normal_z[lane] = unit.z;
  }
}

// Copies the lanes whose mask is not 0, turned to the world's frame.
INSONIFY_VECTOR_CLONES
void to_world(const ReliefLanes& __restrict__ from, const std::int32_t* __restrict__ mask, Turn turn,
              ReliefLanes& __restrict__ reliefs) {
  for (int lane = 0; lane < kHitLanes; ++lane) {
    const Triple gradient = turned(turn, {from.gradient_x[lane], from.gradient_y[lane], from.gradient_z[lane]});
    const bool copied = mask[lane] != 0;
    reliefs.gradient_x[lane] = copied ? gradient.x : reliefs.gradient_x[lane];
    reliefs.gradient_y[lane] = copied ? gradient.y : reliefs.gradient_y[lane];
    reliefs.gradient_z[lane] = copied ? gradient.z : reliefs.gradient_z[lane];
    reliefs.reflectivity[lane] = copied ? from.reflectivity[lane] : reliefs.reflectivity[lane];
  }
}

INSONIFY_VECTOR_CLONES
void bend_normals(const ReliefLanes& __restrict__ reliefs, float* __restrict__ x, float* __restrict__ y,
                  float* __restrict__ z) {
  for (int lane = 0; lane < kHitLanes; ++lane) {
    const Triple normal = bent_normal({x[lane], y[lane], z[lane]},
                                      {reliefs.gradient_x[lane], reliefs.gradient_y[lane], reliefs.gradient_z[lane]});
    x[lane] = normal.x;
    y[lane] = normal.y;
    z[lane] = normal.z;
  }
}

}  // namespace

void ReliefLanes::flatten() {
  for (float* const part : {gradient_x, gradient_y, gradient_z}) {
    std::fill_n(part, kHitLanes, 0.0F);
  }
  std::fill_n(reflectivity, kHitLanes, 1.0F);
}

void ReliefLanes::bend(float* normal_x, float* normal_y, float* normal_z) const {
  bend_normals(*this, normal_x, normal_y, normal_z);
}

void Reliefs::set(const Scene& scene, const Vec3& origin) {
  origin_ = origin;
  any_ = false;
  parts_.assign(scene.instances.size(), {});
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const Instance& instance = scene.instances[i];
    parts_[i].instance = &instance;
    move(static_cast<int>(i), instance.world_from_mesh);
    any_ |= std::ranges::any_of(instance.reliefs, [](const auto& relief) { return relief != nullptr; });
  }
}

void Reliefs::move(int instance, const Pose& world_from_mesh) {
  Part& part = parts_[instance];
  const Pose mesh_from_world = world_from_mesh.inverse();
  part.mesh_from_world = mesh_from_world.orientation.toRotationMatrix().cast<float>();
  part.offset = (mesh_from_world * origin_).cast<float>();
}

const Relief* Reliefs::relief_of(int instance, std::uint32_t triangle) const {
  const Instance& own = *parts_[instance].instance;
  return own.reliefs.empty() ? nullptr : own.reliefs[own.mesh->slot_of(triangle)].get();
}

void Reliefs::find(const ReliefHits& hits, ReliefLanes& reliefs) const {
  reliefs.flatten();
  const Relief* reliefs_left[kHitLanes];
  for (int lane = 0; lane < kHitLanes; ++lane) {
    const int instance = hits.instance[lane];
    reliefs_left[lane] = instance == ReliefHits::kNone ? nullptr : relief_of(instance, hits.triangle[lane]);
  }
  // Neighbouring hits mostly have the same relief: those that do are evaluated together.
  for (int first = 0; first < kHitLanes; ++first) {
    const Relief* const relief = reliefs_left[first];
    if (relief == nullptr) {
      continue;
    }
    alignas(64) std::int32_t own[kHitLanes] = {};
    for (int lane = first; lane < kHitLanes; ++lane) {
      if (reliefs_left[lane] == relief && hits.instance[lane] == hits.instance[first]) {
        own[lane] = -1;
        reliefs_left[lane] = nullptr;
      }
    }
    find_alike(*relief, hits, own, first, reliefs);
  }
}

ReliefPoint Reliefs::at(int instance, std::uint32_t triangle, const Vec3f& position, const Vec3f& normal) const {
  ReliefHits hits = {};
  std::ranges::fill(hits.instance, ReliefHits::kNone);
  hits.set(0, instance, triangle, position, normal);
  ReliefLanes found;
  find(hits, found);
  return {{found.gradient_x[0], found.gradient_y[0], found.gradient_z[0]}, found.reflectivity[0]};
}

void Reliefs::find_alike(const Relief& relief, const ReliefHits& hits, std::int32_t* own, int first,
                         ReliefLanes& reliefs) const {
  const Part& part = parts_[hits.instance[first]];
  const Mesh& mesh = *part.instance->mesh;
  const Turn world_from_mesh = turn_of(part.mesh_from_world.transpose());
  MeshPoints points;
  to_mesh(hits, own, first, turn_of(part.mesh_from_world), triple_of(part.offset), points);
  ReliefLanes found;
  if (!relief.by_position && !mesh.texture_coordinates.empty()) {
    alignas(64) std::int32_t usable[kHitLanes], mapped[kHitLanes];
    found.flatten();
    map_by_texture(relief, mesh, points, usable, found);
    int left = 0;
    for (int lane = 0; lane < kHitLanes; ++lane) {
      mapped[lane] = own[lane] & usable[lane];
      own[lane] &= ~usable[lane];
      left |= own[lane];
    }
    to_world(found, mapped, world_from_mesh, reliefs);
    if (left == 0) {
      return;
    }
  }
  if (relief.tile_size > 0) {
    found.flatten();
    map_by_position(relief, points, found);
    to_world(found, own, world_from_mesh, reliefs);
  }
}

}  // namespace insonify
