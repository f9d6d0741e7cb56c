// cpu_engine.h -- the engine for machines without a GPU: Embree packets on all processors.

#pragma once

#include <memory>
#include <vector>

#include "echo/cpu/beam_task.h"
#include "echo/cpu/cpu_scene.h"
#include "echo/engine.h"
#include "echo/rays/choose_sampling.h"

namespace insonify {

/// A ping is divided into tasks of neighbouring beams. Primary rays are traced in packets of 4 columns by 4 rows, or
/// rasterised; shading is done a column at a time; reflected rays and return legs are collected into packets in the
/// same order. A task writes only its own beams of the grid.
class CpuEngine final : public Engine {
 public:
  explicit CpuEngine(int threads);

  static const EngineKind kKind;
  [[nodiscard]] const EngineKind& kind() const override { return kKind; }
  void set_scene(const Scene& scene) override;
  void leave_out(std::shared_ptr<const LeftOut> left_out) override { world_->left_out = std::move(left_out); }
  void move_instance(int instance, const Pose& world_from_mesh) override;
  void insonify(const PingPlan& plan, const Pose& world_from_sonar, EchoGrid& grid) override;
  [[nodiscard]] std::unique_ptr<Engine> share_scene() override;
  void trace(std::span<const Ray> rays, std::span<Hit> hits) override;
  [[nodiscard]] RayCounts ray_counts() const override { return counts_; }

  [[nodiscard]] EngineMemory memory() const override {
    return {world_->scene.bytes() + world_->raster_scene.bytes(), world_->scene.embree_bytes()};
  }

  [[nodiscard]] std::vector<double> time_traversal(const PingPlan& plan, const Pose& world_from_sonar,
                                                   int repetitions) override;

 private:
  // The scene as rays and rasteriser need it.
  struct World {
    CpuScene scene;
    // Scene that raster_scene will be made from by the first ping that needs it; null afterwards.
    const Scene* raster_source = nullptr;
    std::size_t triangle_count = 0;
    std::vector<Pose> poses;  // [instance] World from mesh.
    RasterScene raster_scene;
    std::shared_ptr<const LeftOut> left_out;
  };

  CpuEngine(int threads, std::shared_ptr<World> world);

  // The visible part of the raster scene if primaries are to be rasterised, else null.
  const FanView* look(const PingPlan& plan, const Pose& world_from_sonar);

  SecondarySampling choose_sampling(const PingPlan& plan, const Pose& world_from_sonar);

  // Calls work(scratch, first_beam, last_beam, task) for every task of a ping.
  template <typename Work>
  void for_each_task(const PingPlan& plan, SecondarySampling sampling, Work&& work);
  [[nodiscard]] int task_count() const { return static_cast<int>(first_beams_.size()) - 1; }

  std::shared_ptr<World> world_;
  FanView view_;
  std::vector<std::unique_ptr<BeamTask>> scratch_;  // [worker]
  std::vector<int> first_beams_;                    // [task] See cut_beams().
  std::vector<std::vector<Echo>> arrivals_;         // [task] Echoes that may arrive in beams of other tasks.
  SamplingProbes probes_;
  RayCounts counts_;
};

}  // namespace insonify
