// remote_engine.h -- an engine that stands for one on a graphics card: its grids are in memory that nobody else reads,
// it needs none of the host's threads, and a call for a single ray costs as much as one for a million.

#pragma once

#include <memory>
#include <stdexcept>
#include <vector>

#include "echo/batch/host_batch.h"
#include "echo/engine.h"
#include "echo/model/deposit.h"

namespace insonify::testing_scenes {

/// Computes with a `cpu` engine of its own. All that leaves it are the copies that map() and receive() make. Once there
/// are pings, it refuses calls for a single ray.
class RemoteEngine final : public Engine {
 public:
  RemoteEngine() : inner_(make_engine("cpu", workers_)) {}

  static const EngineKind kKind;
  [[nodiscard]] const EngineKind& kind() const override { return kKind; }
  void set_scene(const Scene& scene) override { inner_->set_scene(scene); }
  void leave_out(std::shared_ptr<const LeftOut> left_out) override { inner_->leave_out(std::move(left_out)); }
  void place(const Placement& placement) override { inner_->place(placement); }
  [[nodiscard]] std::unique_ptr<EchoBatch> make_batch() override;
  [[nodiscard]] EngineMemory memory() const override { return inner_->memory(); }

  using Engine::trace;
  void trace(std::span<const RayRun> runs) override {
    std::size_t rays = 0;
    for (const RayRun& run : runs) {
      rays += run.rays.size();
    }
    if (batches > 0 && rays < 2 && !has_walks) {
      throw std::logic_error("a call for one ray");
    }
    ++calls;
    inner_->trace(runs);
  }

  bool has_walks = false;  ///< Whether single rays are accepted: the last of random walks may be alone.
  int calls = 0;           ///< Calls of trace().
  int batches = 0;         ///< Calls of EchoBatch::start().

 private:
  friend class RemoteBatch;

  Workers workers_{1};
  std::unique_ptr<Engine> inner_;
};

/// Holds views in any places together, since a card has a scene's instances once a view.
class RemoteBatch final : public EchoBatch {
 public:
  static constexpr std::size_t kMostViews = 7;

  explicit RemoteBatch(RemoteEngine& engine) : engine_(engine), inner_(engine.inner_->make_batch()) {}

  [[nodiscard]] std::size_t capacity(std::span<const PingView> views) const override {
    return std::min(views.size(), kMostViews);
  }

  using EchoBatch::start;
  void start(std::span<const PingView> views, EchoLists lists) override {
    ++engine_.batches;
    views_ = views;
    lists_ = lists;
    grids_.clear();
    counts_.clear();
    for (const PingView& view : views) {
      inner_->start({&view, 1});
      grids_.push_back(inner_->map(0));
      counts_.push_back(inner_->ray_counts(0));
    }
  }

  void receive(EchoReceiver& receiver) override {
    for (std::size_t view = 0; view < views_.size(); ++view) {
      EchoGrid copy = grids_[view];
      for (const EchoList* list : lists_[view]) {
        std::ranges::for_each(list->spread, [&](const Echo& echo) { deposit(*views_[view].plan, echo, copy); });
        std::ranges::copy(list->discrete, std::back_inserter(copy.discrete_echoes()));
      }
      receiver.receive(view, copy, nullptr, engine_.workers_, 0);
    }
  }

  [[nodiscard]] const EchoGrid& map(std::size_t view) override {
    mapped_ = grids_[view];
    return mapped_;
  }

  [[nodiscard]] RayCounts ray_counts(std::size_t view) const override { return counts_[view]; }

 private:
  RemoteEngine& engine_;
  std::unique_ptr<EchoBatch> inner_;
  std::span<const PingView> views_;
  EchoLists lists_;
  std::vector<EchoGrid> grids_;
  std::vector<RayCounts> counts_;
  EchoGrid mapped_;
};

inline const EngineKind RemoteEngine::kKind = {
    .name = "remote", .draws_primaries = true, .make = [](Workers&, std::string_view) -> std::unique_ptr<Engine> {
      return std::make_unique<RemoteEngine>();
    }};

inline std::unique_ptr<EchoBatch> RemoteEngine::make_batch() {
  return std::make_unique<RemoteBatch>(*this);
}

/// Names of programs that include this file have the engine in their list.
inline const bool kRemoteEngineIsThere = [] {
  add_engine_kind(RemoteEngine::kKind);
  return true;
}();

}  // namespace insonify::testing_scenes
