// gpu_rays.cpp -- passes rays to a device and turns what comes back into hits.

#include "echo/gpu/gpu_rays.h"

#include <algorithm>
#include <limits>

#include "echo/gpu/shader_values.h"
#include "echo/grid/echo.h"

namespace insonify {
namespace {

constexpr std::uint32_t kTraceRays[] = {
#include "shaders/trace_rays.inc"
};

Vec3 vector_of(const shader::vec3& v) {
  return {v.x, v.y, v.z};
}

}  // namespace

GpuRays::GpuRays(gpu::Device& device) : device_(device), kernel_(device, "trace_rays", kTraceRays), commands_(device) {}

void GpuRays::load(std::span<const RayRun> runs, const Vec3& origin) {
  auto* place = rays_.data<shader::LooseRay>();
  for (const RayRun& run : runs) {
    for (const Ray& ray : run.rays) {
      *place++ = {plain(ray.origin - origin), static_cast<float>(ray.min_distance), plain(ray.direction),
                  static_cast<float>(ray.max_distance)};
    }
  }
}

void GpuRays::read(std::span<const RayRun> runs, const std::vector<float>& reflectivity) const {
  const auto* found = hits_.data<const shader::LooseHit>();
  for (const RayRun& run : runs) {
    for (std::size_t i = 0; i < run.rays.size(); ++i, ++found) {
      Hit& hit = run.hits[i];
      hit = {.distance = std::numeric_limits<double>::infinity()};
      if (found->distance < 0 || double{found->distance} > run.rays[i].max_distance) {
        continue;
      }
      const std::uint16_t material = material_of(found->surface);
      hit = {found->distance, vector_of(found->normal).normalized(),   instance_of(found->surface),
             material,        reflectivity[material] * found->texture, found->texture};
    }
  }
}

// Groups runs that have the scene in one place, and records the copies of these places.
void GpuRays::place(const GpuScene& scene, std::span<const RayRun> runs) {
  jobs_.clear();
  shader::address rays = rays_.address(), hits = hits_.address();
  for (std::size_t first = 0, last = 0; first < runs.size(); first = last) {
    std::uint32_t count = 0;
    for (last = first; last < runs.size() && Placement::same(runs[last].placement, runs[first].placement); ++last) {
      count += static_cast<std::uint32_t>(runs[last].rays.size());
    }
    if (count == 0) {
      continue;
    }
    if (jobs_.size() == placed_.size()) {
      placed_.push_back(std::make_unique<GpuPlacement>());
    }
    GpuPlacement& placed = *placed_[jobs_.size()];
    scene.place(runs[first].placement, placed);
    placed.buffer.copy(commands_);
    jobs_.push_back({placed.address(), rays, hits, count});
    rays += count * sizeof(shader::LooseRay);
    hits += count * sizeof(shader::LooseHit);
  }
}

void GpuRays::trace(const GpuScene& scene, const std::vector<float>& reflectivity, std::span<const RayRun> runs) {
  std::size_t count = 0;
  for (const RayRun& run : runs) {
    count += run.rays.size();
  }
  if (count == 0) {
    return;
  }
  rays_.reserve(device_, count * sizeof(shader::LooseRay), gpu::Memory::kToDevice);
  hits_.reserve(device_, count * sizeof(shader::LooseHit), gpu::Memory::kToHost);
  load(runs, scene.origin());
  commands_.begin();
  place(scene, runs);
  commands_.wait_for_writes();
  for (const shader::TraceRays& job : jobs_) {
    commands_.run(kernel_, job, groups_for(job.count));
  }
  commands_.submit();
  commands_.wait();
  read(runs, reflectivity);
}

}  // namespace insonify
