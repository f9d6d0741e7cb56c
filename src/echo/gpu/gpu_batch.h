// gpu_batch.h -- a batch of pings on a device.

#pragma once

#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string_view>
#include <vector>

#include "echo/batch/host_batch.h"
#include "echo/gpu/gpu_plan.h"
#include "echo/gpu/gpu_receiver.h"
#include "echo/gpu/gpu_world.h"
#include "echo/gpu/ping_kernels.h"
#include "echo/gpu/ping_memory.h"
#include "echo/gpu/reception_memory.h"
#include "echo/rays/choose_sampling.h"

namespace insonify {

/// The pings of a batch are computed in a few submissions, in order: the host receives the first while the device
/// computes the last.
class GpuBatch final : public HostBatch {
 public:
  GpuBatch(GpuWorld& world, const PingKernels& kernels, Workers& workers);

  [[nodiscard]] std::size_t capacity(std::span<const PingView> views) const override;
  [[nodiscard]] std::vector<StepTime> step_times() const override;

 protected:
  void insonify(std::span<const PingView> views) override;
  void finish(std::size_t view, Workers& workers) override;
  [[nodiscard]] std::optional<FormedBeams> formed(std::size_t view) const override;

 private:
  struct Ping {
    GpuPlacement placement;
    PingMemory memory;
    ReceptionMemory reception;
    SamplingProbes probes;
  };

  // Neighbouring views that the device computes in one submission.
  struct Part {
    explicit Part(gpu::Device& device) : commands(device) {}

    gpu::Commands commands;
    gpu::StagedBuffer jobs;               // PingAt[view]
    gpu::StagedBuffer layers;             // LayerGroups[kMostPassed]; empty where no surface lets sound through.
    std::size_t first = 0, count = 0;     // Views.
    std::vector<std::string_view> steps;  // Names of the steps that record() has recorded.
    std::vector<double> step_seconds;     // [step], when it has finished.
    bool finished = false;
    std::exception_ptr failure;
  };

  void choose_sampling(std::span<const PingView> views);
  void set_plans(std::span<const PingView> views);
  void set_receivers(std::span<const PingView> views);
  void prepare(std::span<const PingView> views);
  void fill_jobs(Part& part);
  void fill_layers(Part& part);
  void copy_inputs(Part& part);
  void record(Part& part);
  void record_layers(Part& part);
  void record_echoes(Part& part);
  void record_reception(Part& part);
  void record_beams(Part& part);
  static void finish_step(Part& part, std::string_view name);
  [[nodiscard]] shader::PingJob job_of_layer(const Part& part, std::uint32_t passed) const;
  void start_part(Part& part);
  void finish_part(Part& part);
  bool enough_room(const Part& part);
  void copy_rest(Part& part);
  void read(std::size_t view, Workers& workers);

  GpuWorld& world_;
  const PingKernels& kernels_;
  std::map<const FlatPlan*, GpuPlan> plans_;
  std::map<const FlatReceiver*, GpuReceiver> receivers_;
  std::vector<std::unique_ptr<Ping>> pings_;  // [view]
  std::vector<SecondarySampling> sampling_;   // [view]
  std::vector<std::unique_ptr<Part>> parts_;  // In the order of their views; those after the last view are spare.
  bool sees_through_ = false;                 // Whether any view does.
  std::mutex finishing_;                      // Held while a part is finished.
  std::vector<RayRun> probes_;
};

}  // namespace insonify
