// spare_engine.h -- an engine on a device, and `cpu` for when the device cannot go on.

#pragma once

#include <memory>
#include <optional>
#include <string>

#include "base/device_failure.h"
#include "echo/engine.h"
#include "insonify/log.h"

namespace insonify {

/// Passes everything on to the engine of a device. From the first DeviceFailure on, a `cpu` engine with the same scene
/// takes its place, and the failure is logged, once. Calls that fail are repeated there, but those of batches throw:
/// their pings have to be made again with a batch of the new engine.
class SpareEngine final : public Engine {
 public:
  SpareEngine(const EngineKind& kind, std::string_view device, Workers& workers, Log log);

  [[nodiscard]] const EngineKind& kind() const override { return engine_->kind(); }
  void set_scene(const Scene& scene) override;
  void leave_out(std::shared_ptr<const LeftOut> left_out) override;
  void place(const Placement& placement) override;
  [[nodiscard]] std::unique_ptr<EchoBatch> make_batch() override;
  [[nodiscard]] bool receives() const override { return engine_->receives(); }
  using Engine::trace;
  void trace(std::span<const RayRun> runs) override;
  [[nodiscard]] EngineMemory memory() const override { return engine_->memory(); }
  [[nodiscard]] std::vector<double> time_traversal(const PingView& view, int repetitions) override {
    return engine_->time_traversal(view, repetitions);
  }

  /// Goes on with `cpu`, after a failure of a batch. Nothing is done where it does already.
  void give_up(const DeviceFailure& failure);

 private:
  template <typename Call>
  void attempt(const Call& call);
  void start_host(const Error& failure);

  Workers& workers_;
  Log log_;
  std::unique_ptr<Engine> engine_;
  std::unique_ptr<Engine> failed_;  // Batches of it may still be there.
  bool on_host_ = false;
  const Scene* scene_ = nullptr;
  std::shared_ptr<const LeftOut> left_out_;
  std::optional<Placement> placement_;
};

}  // namespace insonify
