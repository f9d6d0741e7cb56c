// cpu_world.h -- a scene as the rays and the rasteriser of the `cpu` engine need it.

#pragma once

#include <memory>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "echo/batch/ping_view.h"
#include "echo/cpu/cpu_scene.h"
#include "echo/cpu/raster_scene.h"
#include "echo/model/hit.h"
#include "echo/model/left_out.h"
#include "insonify/scene.h"

namespace insonify {

class CpuWorld {
 public:
  void set(const Scene& scene, bool with_faces, Workers& workers);
  void place(const Placement& placement);
  void leave_out(std::shared_ptr<const LeftOut> left_out) { left_out_ = std::move(left_out); }

  /// Makes raster_scene(), which only sonars that rasterise their primaries need.
  void prepare_raster();

  static constexpr std::size_t kRaysTogether = 1024;

  /// Finds the first surface along each of the first kRaysTogether rays: one thread's task.
  /// @param refraction  Null: they are straight.
  void trace(std::span<const Ray> rays, std::span<Hit> hits, const Refraction* refraction) const;

  [[nodiscard]] const CpuScene& scene() const { return scene_; }
  [[nodiscard]] const RasterScene& raster_scene() const { return raster_scene_; }
  [[nodiscard]] std::size_t triangle_count() const { return triangle_count_; }
  [[nodiscard]] const LeftOut* left_out() const { return left_out_.get(); }
  [[nodiscard]] EngineMemory memory() const;

 private:
  void move(int instance, const Pose& world_from_mesh);
  void trace_packet(std::span<const Ray> rays, std::span<Hit> hits, const Refraction* refraction) const;

  CpuScene scene_;
  const Scene* source_ = nullptr;
  bool raster_ready_ = false;
  std::size_t triangle_count_ = 0;
  std::vector<Placement::Moved> moved_;  // Instances that are not where the scene has them.
  RasterScene raster_scene_;
  std::shared_ptr<const LeftOut> left_out_;
};

}  // namespace insonify
