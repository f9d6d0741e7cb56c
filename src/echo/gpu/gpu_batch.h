// gpu_batch.h -- a batch of pings on a device.

#pragma once

#include <map>
#include <memory>
#include <string_view>
#include <vector>

#include "echo/batch/host_batch.h"
#include "echo/gpu/gpu_plan.h"
#include "echo/gpu/gpu_world.h"
#include "echo/gpu/ping_memory.h"
#include "echo/rays/choose_sampling.h"

namespace insonify {

/// The kernels of a ping, each a step: the shader of the same name.
struct PingKernels {
  explicit PingKernels(gpu::Device& device);

  gpu::Kernel trace_primaries, turn_up, evaluate, select, deposit, count_groups, reflect, mirror, gather;
};

/// All pings of a batch are computed in one submission.
class GpuBatch final : public HostBatch {
 public:
  GpuBatch(GpuWorld& world, const PingKernels& kernels, Workers& workers);

  [[nodiscard]] std::size_t capacity(std::span<const PingView> views) const override;
  [[nodiscard]] std::vector<StepTime> step_times() const override;

 protected:
  void insonify(std::span<const PingView> views) override;

 private:
  struct Ping {
    GpuPlacement placement;
    PingMemory memory;
    SamplingProbes probes;
  };

  void refuse(const FlatPlan& plan) const;
  void choose_sampling(std::span<const PingView> views);
  void set_plans(std::span<const PingView> views);
  void prepare(std::span<const PingView> views);
  void fill_jobs(std::span<const PingView> views);
  void record(std::span<const PingView> views);
  bool enough_room();
  void read(std::span<const PingView> views);

  GpuWorld& world_;
  const PingKernels& kernels_;
  gpu::Commands commands_;
  std::map<const FlatPlan*, GpuPlan> plans_;
  std::vector<std::unique_ptr<Ping>> pings_;  // [view]
  std::vector<SecondarySampling> sampling_;   // [view]
  gpu::StagedBuffer jobs_;                    // PingAt[view]
  std::vector<std::string_view> steps_;       // Names of the steps that record() has recorded.
  std::vector<double> step_seconds_;          // [step]
  std::vector<RayRun> probes_;
};

}  // namespace insonify
