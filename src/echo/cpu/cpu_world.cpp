// cpu_world.cpp -- moves instances in both forms of the scene, and traces rays that are not part of a lattice.

#include "echo/cpu/cpu_world.h"

#include <algorithm>
#include <limits>

#include "base/denormals.h"

namespace insonify {

void CpuWorld::set(const Scene& scene, bool with_faces, Workers& workers) {
  scene_.set(scene, with_faces, workers);
  source_ = &scene;
  raster_scene_ = {};
  raster_ready_ = false;
  left_out_ = nullptr;
  triangle_count_ = scene.triangle_count();
  moved_.clear();
}

void CpuWorld::move(int instance, const Pose& world_from_mesh) {
  scene_.move(instance, world_from_mesh);
  if (raster_ready_) {
    raster_scene_.move(instance, world_from_mesh);
  }
}

void CpuWorld::place(const Placement& placement) {
  const std::vector<Placement::Moved>& moved = placement.moved;
  for (const Placement::Moved& before : moved_) {
    if (std::ranges::find(moved, before.instance, &Placement::Moved::instance) == moved.end()) {
      move(before.instance, placement.at_home[static_cast<std::size_t>(before.instance)]);
    }
  }
  for (const Placement::Moved& now : moved) {
    if (std::ranges::find(moved_, now) == moved_.end()) {
      move(now.instance, now.world_from_mesh);
    }
  }
  moved_.assign(moved.begin(), moved.end());
  scene_.commit_moves();
}

void CpuWorld::prepare_raster() {
  if (!raster_ready_) {
    raster_scene_.set(*source_);
    for (const Placement::Moved& one : moved_) {
      raster_scene_.move(one.instance, one.world_from_mesh);
    }
    raster_ready_ = true;
  }
}

EngineMemory CpuWorld::memory() const {
  return {scene_.bytes() + raster_scene_.bytes(), scene_.embree_bytes()};
}

void CpuWorld::trace(std::span<const Ray> rays, std::span<Hit> hits, const Refraction* refraction) const {
  const DenormalsOff denormals_off;
  const std::size_t end = std::min(rays.size(), kRaysTogether);
  for (std::size_t first = 0; first < end; first += kPacketSize) {
    const std::size_t count = std::min<std::size_t>(kPacketSize, end - first);
    trace_packet(rays.subspan(first, count), hits.subspan(first, count), refraction);
  }
}

// Traces at most kPacketSize rays.
void CpuWorld::trace_packet(std::span<const Ray> rays, std::span<Hit> hits, const Refraction* refraction) const {
  RayPacket packet;
  const auto count = static_cast<int>(rays.size());
  packet.set_count(count);
  float reach = 0;
  for (int lane = 0; lane < count; ++lane) {
    const Ray& ray = rays[lane];
    packet.set_origin(lane, (ray.origin - scene_.origin()).cast<float>());
    packet.set_direction(lane, ray.direction.cast<float>());
    packet.rays.ray.tnear[lane] = static_cast<float>(ray.min_distance);
    reach = std::max(reach, static_cast<float>(ray.max_distance));
  }
  packet.set_reach(reach);
  scene_.intersect(packet, refraction);
  CpuScene::Shading shading;
  scene_.shade(packet.rays.hit, shading);
  CpuScene::Shading flat = shading;
  if (scene_.reliefs().any()) {
    scene_.bend_normals(packet.rays, refraction, shading);
  }
  if (refraction != nullptr) {
    scene_.appear(packet.rays.ray, *refraction, shading, nullptr);
    scene_.appear(packet.rays.ray, *refraction, flat, nullptr);
  }
  for (int lane = 0; lane < count; ++lane) {
    const Ray& ray = rays[lane];
    const double distance = static_cast<double>(packet.rays.ray.tfar[lane]);
    Hit& hit = hits[lane];
    hit = {.distance = std::numeric_limits<double>::infinity()};
    if (packet.hit(lane) && distance <= ray.max_distance) {
      const Vec3 normal = shading.normal(lane).cast<double>().normalized();
      const bool from_behind = flat.normal(lane).cast<double>().dot(ray.direction) > 0;
      hit = {distance,
             from_behind ? Vec3(-normal) : normal,
             instance_of(shading.surface[lane]),
             material_of(shading.surface[lane]),
             shading.reflectivity[lane],
             shading.texture[lane]};
    }
  }
}

}  // namespace insonify
