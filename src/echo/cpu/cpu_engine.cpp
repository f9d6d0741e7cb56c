// cpu_engine.cpp -- batches of pings, and rays of many runs, on all workers.

#include "echo/cpu/cpu_engine.h"

#include "echo/batch/host_batch.h"
#include "echo/cpu/cpu_ping.h"

namespace insonify {
namespace {

class CpuBatch final : public HostBatch {
 public:
  CpuBatch(CpuWorld& world, Workers& workers) : HostBatch(workers), world_(world), together_(world, workers) {}

 protected:
  void insonify(std::span<const PingView> views) override {
    if (views.front().placement != nullptr) {
      world_.place(*views.front().placement);
    }
    for (const PingView& view : views) {
      if (view.refraction == nullptr && CpuPing::draws(*view.plan, world_)) {
        world_.prepare_raster();
      }
    }
    if (by_view(views.size())) {
      while (alone_.size() < static_cast<std::size_t>(workers_.count())) {
        alone_.push_back(std::make_unique<CpuPing>(world_, workers_.alone()));
      }
    }
    for_each_view([&](std::size_t view, const Workers& workers, int worker) {
      CpuPing& ping = &workers == &workers_ ? together_ : *alone_[worker];
      counts_[view] = ping.insonify(views[view], *grids_[view]);
    });
  }

 private:
  CpuWorld& world_;
  CpuPing together_;
  std::vector<std::unique_ptr<CpuPing>> alone_;  // [worker], made by the first batch of many views.
};

}  // namespace

const EngineKind CpuEngine::kKind = {.name = "cpu",
                                     .draws_primaries = true,
                                     .bends_rays = true,
                                     .make = [](Workers& workers, std::string_view) -> std::unique_ptr<Engine> {
                                       return std::make_unique<CpuEngine>(workers);
                                     }};

std::unique_ptr<EchoBatch> CpuEngine::make_batch() {
  return std::make_unique<CpuBatch>(world_, workers_);
}

std::vector<double> CpuEngine::time_traversal(const PingView& view, int repetitions) {
  return CpuPing(world_, workers_).time_traversal(*view.plan, view.world_from_sonar, repetitions);
}

// Runs in one placement are traced together.
void CpuEngine::trace(std::span<const RayRun> runs) {
  for (std::size_t first = 0, last = 0; first < runs.size(); first = last) {
    const Placement* placement = runs[first].placement;
    tasks_.clear();
    for (last = first; last < runs.size() && Placement::same(runs[last].placement, placement); ++last) {
      for (std::size_t ray = 0; ray < runs[last].rays.size(); ray += CpuWorld::kRaysTogether) {
        tasks_.push_back({&runs[last], ray});
      }
    }
    if (placement != nullptr) {
      world_.place(*placement);
    }
    workers_.for_each(static_cast<int>(tasks_.size()), [&](int task, int) {
      const auto [run, ray] = tasks_[task];
      world_.trace(run->rays.subspan(ray), run->hits.subspan(ray), run->refraction);
    });
  }
}

}  // namespace insonify
