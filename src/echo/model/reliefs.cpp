// reliefs.cpp -- transforms points from the world to a mesh's frame, and gradients back.

#include "echo/model/reliefs.h"

#include <algorithm>

namespace insonify {

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

ReliefPoint Reliefs::at(int instance, std::uint32_t triangle, const Vec3f& position, const Vec3f& normal) const {
  const Part& part = parts_[instance];
  const std::vector<std::shared_ptr<const Relief>>& reliefs = part.instance->reliefs;
  if (reliefs.empty()) {
    return {};
  }
  const Mesh& mesh = *part.instance->mesh;
  const Relief* relief = reliefs[mesh.slot_of(triangle)].get();
  if (relief == nullptr) {
    return {};
  }
  ReliefPoint point = relief_at(*relief, mesh, triangle, part.mesh_from_world * position + part.offset,
                                (part.mesh_from_world * normal).normalized());
  point.gradient = part.mesh_from_world.transpose() * point.gradient;
  return point;
}

}  // namespace insonify
