// spare_engine.cpp -- repeats on `cpu` what a device has not done.

#include "echo/spare_engine.h"

#include <fmt/format.h>

#include <utility>

namespace insonify {

SpareEngine::SpareEngine(const EngineKind& kind, std::string_view device, Workers& workers, Log log)
    : workers_(workers), log_(std::move(log)) {
  try {
    engine_ = kind.make(workers, device);
  } catch (const Error& failure) {
    start_host(failure);
  }
}

void SpareEngine::start_host(const Error& failure) {
  failed_ = std::exchange(engine_, make_engine("cpu", workers_));
  on_host_ = true;
  if (log_) {
    log_(Severity::kWarning, fmt::format("{}; engine cpu goes on", failure.what()));
  }
}

template <typename Call>
void SpareEngine::attempt(const Call& call) {
  try {
    call();
  } catch (const DeviceFailure& failure) {
    if (on_host_) {
      throw;
    }
    give_up(failure);
    call();
  }
}

void SpareEngine::give_up(const DeviceFailure& failure) {
  if (on_host_) {
    return;
  }
  start_host(failure);
  if (expects_paper()) {
    engine_->expect_paper();
  }
  if (scene_ != nullptr) {
    engine_->set_scene(*scene_);
    engine_->leave_out(left_out_);
  }
  if (placement_) {
    engine_->place(*placement_);
  }
}

void SpareEngine::set_scene(const Scene& scene) {
  scene_ = &scene;
  left_out_ = nullptr;
  placement_.reset();
  attempt([&] {
    if (expects_paper()) {
      engine_->expect_paper();
    }
    engine_->set_scene(scene);
  });
}

void SpareEngine::leave_out(std::shared_ptr<const LeftOut> left_out) {
  left_out_ = std::move(left_out);
  attempt([&] { engine_->leave_out(left_out_); });
}

void SpareEngine::place(const Placement& placement) {
  placement_ = placement;
  attempt([&] { engine_->place(placement); });
}

std::unique_ptr<EchoBatch> SpareEngine::make_batch() {
  std::unique_ptr<EchoBatch> batch;
  attempt([&] { batch = engine_->make_batch(); });
  return batch;
}

void SpareEngine::trace(std::span<const RayRun> runs) {
  attempt([&] { engine_->trace(runs); });
}

}  // namespace insonify
