// cpu_ping.cpp -- divides a ping into tasks and runs them on all workers.

#include "echo/cpu/cpu_ping.h"

#include <algorithm>
#include <cassert>
#include <chrono>

#include "base/denormals.h"
#include "echo/cpu/cpu_engine.h"
#include "echo/model/deposit.h"
#include "echo/rays/primary_choice.h"

namespace insonify {

CpuPing::CpuPing(const CpuWorld& world, Workers& workers) : world_(world), workers_(workers) {
  for (int worker = 0; worker < workers.count(); ++worker) {
    scratch_.push_back(std::make_unique<BeamTask>(world.scene(), world.raster_scene(), workers));
  }
}

bool CpuPing::draws(const FlatPlan& plan, const CpuWorld& world) {
  return primary_echoes(plan.primary, plan.azimuth_aperture, 1.0 * plan.lattice.columns * plan.lattice.rows,
                        world.triangle_count(), CpuEngine::kKind.draws_primaries,
                        plan.lattice.even_rows) == PrimaryEchoes::kRaster;
}

const FanView* CpuPing::look(const FlatPlan& plan, const Pose& world_from_sonar) {
  if (!draws(plan, world_)) {
    return nullptr;
  }
  assert(plan.lattice.even_rows);
  view_.look(world_.raster_scene(), plan,
             {world_from_sonar.position - world_.raster_scene().origin(), world_from_sonar.orientation});
  return &view_;
}

SecondarySampling CpuPing::choose_sampling(const FlatPlan& plan, const Pose& world_from_sonar,
                                           const Refraction* refraction) {
  if (refraction != nullptr) {
    return probes_.choose_blindly(plan);
  }
  const std::span<const Ray> rays = probes_.aim(plan, world_from_sonar);
  world_.trace(rays, probes_.hits(), nullptr);
  return probes_.choose(plan, world_.scene().origin(), world_.scene().boxes());
}

template <typename Work>
void CpuPing::for_each_task(const FlatPlan& plan, SecondarySampling sampling, const Refraction* refraction,
                            Work&& work) {
  for (const auto& scratch : scratch_) {
    scratch->prepare(plan, sampling, refraction, world_.left_out());
  }
  workers_.for_each(task_count(), [&](int task, int worker) {
    const DenormalsOff denormals_off;
    work(*scratch_[worker], first_beams_[task], first_beams_[task + 1], task);
  });
}

RayCounts CpuPing::insonify(const PingView& of, EchoGrid& grid) {
  const FlatPlan& plan = *of.plan;
  const Pose& world_from_sonar = of.world_from_sonar;
  const FanView* view = of.refraction == nullptr ? look(plan, world_from_sonar) : nullptr;
  const SecondarySampling sampling = choose_sampling(plan, world_from_sonar, of.refraction);
  cut_beams(plan.beam_count, workers_.count(), first_beams_);
  arrivals_.resize(std::max(arrivals_.size(), static_cast<std::size_t>(task_count())));
  for_each_task(plan, sampling, of.refraction, [&](BeamTask& scratch, int first_beam, int last_beam, int task) {
    scratch.run(world_from_sonar, first_beam, last_beam, view, grid, arrivals_[task]);
  });
  deposit_together(plan, workers_, grid, [&](const auto& add) {
    for (int task = 0; task < task_count(); ++task) {
      std::ranges::for_each(arrivals_[task], add);
    }
  });
  RayCounts counts{.secondary = probes_.hits().size()};
  for (const auto& scratch : scratch_) {
    counts += scratch->counts();
  }
  return counts;
}

std::vector<double> CpuPing::time_traversal(const FlatPlan& plan, const Pose& world_from_sonar, int repetitions) {
  cut_beams(plan.beam_count, workers_.count(), first_beams_);
  std::vector<SecondaryTask::Log> logs(task_count());
  EchoGrid grid(plan.beam_count, plan.bin_count, kPathOrders);
  const SecondarySampling sampling = choose_sampling(plan, world_from_sonar, nullptr);
  for_each_task(plan, sampling, nullptr, [&](BeamTask& scratch, int first_beam, int last_beam, int task) {
    std::vector<Echo> arrivals;
    scratch.run(world_from_sonar, first_beam, last_beam, nullptr, grid, arrivals, &logs[task]);
  });

  std::vector<double> seconds;
  for (int repetition = 0; repetition < repetitions; ++repetition) {
    const auto start = std::chrono::steady_clock::now();
    for_each_task(plan, sampling, nullptr, [&](BeamTask& scratch, int first_beam, int last_beam, int task) {
      scratch.trace_only(world_from_sonar, first_beam, last_beam);
      for (const RayPacket& logged : logs[task].reflected) {
        RayPacket packet = logged;
        packet.intersect(world_.scene().handle());
      }
      for (const RayPacket& logged : logs[task].back) {
        RayPacket packet = logged;
        world_.scene().occlude(packet, nullptr);
      }
    });
    seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return seconds;
}

}  // namespace insonify
