// cpu_engine.cpp -- divides a ping into tasks and runs them on all workers.

#include "echo/cpu/cpu_engine.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <limits>

#include "base/denormals.h"
#include "echo/model/deposit_together.h"
#include "echo/rays/primary_choice.h"

namespace insonify {
namespace {

constexpr int kRaysPerTask = 1024;

}  // namespace

const EngineKind CpuEngine::kKind = {
    .name = "cpu", .draws_primaries = true, .make = [](int threads) -> std::unique_ptr<Engine> {
      return std::make_unique<CpuEngine>(threads);
    }};

CpuEngine::CpuEngine(int threads) : CpuEngine(threads, std::make_shared<World>()) {}

CpuEngine::CpuEngine(int threads, std::shared_ptr<World> world) : Engine(threads), world_(std::move(world)) {
  for (int worker = 0; worker < workers_.count(); ++worker) {
    scratch_.push_back(std::make_unique<BeamTask>(world_->scene, world_->raster_scene, workers_));
  }
}

std::unique_ptr<Engine> CpuEngine::share_scene() {
  return std::unique_ptr<Engine>(new CpuEngine(1, world_));
}

void CpuEngine::set_scene(const Scene& scene) {
  world_->scene.set(scene);
  world_->raster_source = &scene;
  world_->raster_scene = {};
  world_->left_out = nullptr;
  world_->triangle_count = scene.triangle_count();
  world_->poses.clear();
  for (const Instance& instance : scene.instances) {
    world_->poses.push_back(instance.world_from_mesh);
  }
}

void CpuEngine::move_instance(int instance, const Pose& world_from_mesh) {
  world_->scene.move(instance, world_from_mesh);
  world_->poses[instance] = world_from_mesh;
  if (world_->raster_source == nullptr) {
    world_->raster_scene.move(instance, world_from_mesh);
  }
}

const FanView* CpuEngine::look(const PingPlan& plan, const Pose& world_from_sonar) {
  const bool even_rows = plan.lattice.even_rows;
  if (primary_echoes(plan.primary, plan.sonar, world_->triangle_count, kKind.draws_primaries, even_rows) ==
      PrimaryEchoes::kRays) {
    return nullptr;
  }
  assert(even_rows);
  if (world_->raster_source != nullptr) {
    world_->raster_scene.set(*world_->raster_source);
    for (std::size_t i = 0; i < world_->poses.size(); ++i) {
      if (world_->raster_source->instances[i].moving) {
        world_->raster_scene.move(static_cast<int>(i), world_->poses[i]);
      }
    }
    world_->raster_source = nullptr;
  }
  view_.look(world_->raster_scene, plan,
             {world_from_sonar.position - world_->raster_scene.origin(), world_from_sonar.orientation});
  return &view_;
}

SecondarySampling CpuEngine::choose_sampling(const PingPlan& plan, const Pose& world_from_sonar) {
  const std::span<const Ray> rays = probes_.aim(plan, world_from_sonar);
  trace(rays, probes_.hits());
  return probes_.choose(plan, world_->scene.origin(), world_->scene.boxes());
}

template <typename Work>
void CpuEngine::for_each_task(const PingPlan& plan, SecondarySampling sampling, Work&& work) {
  for (const auto& scratch : scratch_) {
    scratch->prepare(plan, sampling, world_->left_out.get());
  }
  workers_.for_each(task_count(), [&](int task, int worker) {
    const DenormalsOff denormals_off;
    work(*scratch_[worker], first_beams_[task], first_beams_[task + 1], task);
  });
}

void CpuEngine::insonify(const PingPlan& plan, const Pose& world_from_sonar, EchoGrid& grid) {
  world_->scene.commit_moves();
  const FanView* view = look(plan, world_from_sonar);
  counts_ = {};
  const SecondarySampling sampling = choose_sampling(plan, world_from_sonar);
  counts_.secondary = probes_.hits().size();
  cut_beams(plan.sonar.beam_count, workers_.count(), first_beams_);
  arrivals_.resize(std::max(arrivals_.size(), static_cast<std::size_t>(task_count())));
  for_each_task(plan, sampling, [&](BeamTask& scratch, int first_beam, int last_beam, int task) {
    scratch.run(world_from_sonar, first_beam, last_beam, view, grid, arrivals_[task]);
  });
  deposit_together(plan, workers_, grid, [&](const auto& add) {
    for (int task = 0; task < task_count(); ++task) {
      std::ranges::for_each(arrivals_[task], add);
    }
  });
  for (const auto& scratch : scratch_) {
    counts_ += scratch->counts();
  }
}

std::vector<double> CpuEngine::time_traversal(const PingPlan& plan, const Pose& world_from_sonar, int repetitions) {
  cut_beams(plan.sonar.beam_count, workers_.count(), first_beams_);
  std::vector<SecondaryTask::Log> logs(task_count());
  EchoGrid grid(plan.sonar.beam_count, plan.sonar.bin_count, kPathOrders);
  const SecondarySampling sampling = choose_sampling(plan, world_from_sonar);
  for_each_task(plan, sampling, [&](BeamTask& scratch, int first_beam, int last_beam, int task) {
    std::vector<Echo> arrivals;
    scratch.run(world_from_sonar, first_beam, last_beam, nullptr, grid, arrivals, &logs[task]);
  });

  std::vector<double> seconds;
  for (int repetition = 0; repetition < repetitions; ++repetition) {
    const auto start = std::chrono::steady_clock::now();
    for_each_task(plan, sampling, [&](BeamTask& scratch, int first_beam, int last_beam, int task) {
      scratch.trace_only(world_from_sonar, first_beam, last_beam);
      for (const RayPacket& logged : logs[task].reflected) {
        RayPacket packet = logged;
        packet.intersect(world_->scene.handle());
      }
      for (const RayPacket& logged : logs[task].back) {
        RayPacket packet = logged;
        world_->scene.occlude(packet);
      }
    });
    seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return seconds;
}

void CpuEngine::trace(std::span<const Ray> rays, std::span<Hit> hits) {
  world_->scene.commit_moves();
  workers_.for_each((static_cast<int>(rays.size()) + kRaysPerTask - 1) / kRaysPerTask, [&](int task, int) {
    const DenormalsOff denormals_off;
    const std::size_t end = std::min(rays.size(), static_cast<std::size_t>(task + 1) * kRaysPerTask);
    RayPacket packet;
    for (std::size_t first = static_cast<std::size_t>(task) * kRaysPerTask; first < end; first += kPacketSize) {
      const int count = static_cast<int>(std::min<std::size_t>(kPacketSize, end - first));
      packet.set_count(count);
      float reach = 0;
      for (int lane = 0; lane < count; ++lane) {
        const Ray& ray = rays[first + lane];
        packet.set_origin(lane, (ray.origin - world_->scene.origin()).cast<float>());
        packet.set_direction(lane, ray.direction.cast<float>());
        packet.rays.ray.tnear[lane] = static_cast<float>(ray.min_distance);
        reach = std::max(reach, static_cast<float>(ray.max_distance));
      }
      packet.set_reach(reach);
      packet.intersect(world_->scene.handle());
      CpuScene::Shading shading;
      world_->scene.shade(packet.rays.hit, shading);
      const CpuScene::Shading flat = shading;
      if (world_->scene.reliefs().any()) {
        world_->scene.bend_normals(packet.rays, shading);
      }
      for (int lane = 0; lane < count; ++lane) {
        const Ray& ray = rays[first + lane];
        const double distance = static_cast<double>(packet.rays.ray.tfar[lane]);
        Hit& hit = hits[first + lane];
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
  });
}

}  // namespace insonify
