// test_engine.h -- an engine with threads of its own, and batches of one ping.

#pragma once

#include <algorithm>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "echo/batch/echo_source.h"
#include "echo/engine.h"
#include "echo/model/deposit.h"

namespace insonify {

/// An engine as tests use it: they look at the grid of one ping.
class TestEngine {
 public:
  /// @param threads  As for Workers.
  explicit TestEngine(std::string_view name, int threads)
      : workers_(threads), engine_(make_engine(name, workers_)), batch_(engine_->make_batch()) {}

  [[nodiscard]] const EngineKind& kind() const { return engine_->kind(); }

  void set_scene(const Scene& scene) {
    engine_->set_scene(scene);
    at_home_.clear();
    std::ranges::transform(scene.instances, std::back_inserter(at_home_), &Instance::world_from_mesh);
    placement_ = {at_home_, {}};
  }
  void set_scene(const Scene&& scene) = delete;

  void leave_out(std::shared_ptr<const LeftOut> left_out) { engine_->leave_out(std::move(left_out)); }

  /// Moves an instance whose `moving` is set, from the next call on.
  void move_instance(int instance, const Pose& world_from_mesh) {
    std::erase_if(placement_.moved, [&](const Placement::Moved& moved) { return moved.instance == instance; });
    placement_.moved.push_back({instance, world_from_mesh});
    std::ranges::sort(placement_.moved, {}, &Placement::Moved::instance);
  }

  /// Fills the grid, which has the plan's beams and bins, with the echoes of the samples of one ping.
  void insonify(const FlatPlan& plan, const Pose& world_from_sonar, EchoGrid& grid) {
    const PingView view = view_of(plan, world_from_sonar, grid);
    batch_->start({&view, 1});
    grid = batch_->map(0);
  }

  /// The same for several pings in batches.
  void insonify_all(const FlatPlan& plan, std::span<const Pose> poses, std::span<EchoGrid> grids) {
    std::vector<PingView> views;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      views.push_back(view_of(plan, poses[i], grids[i]));
    }
    for (std::size_t first = 0, count = 0; first < views.size(); first += count) {
      const std::span<const PingView> left = std::span(views).subspan(first);
      count = batch_->capacity(left);
      batch_->start(left.first(count));
      for (std::size_t i = 0; i < count; ++i) {
        grids[first + i] = batch_->map(i);
      }
    }
  }

  void trace(std::span<const Ray> rays, std::span<Hit> hits) {
    const RayRun run{&placement_, rays, hits};
    engine_->trace({&run, 1});
  }

  /// Adds the echoes of one source to the cells of the grid. Its rays must not be lines of sight.
  void add(EchoSource& source, const FlatPlan& plan, const Pose& world_from_sonar, std::uint64_t number,
           EchoGrid& grid) {
    PingView view = view_of(plan, world_from_sonar, grid);
    view.number = number;
    RayList asked, more;
    EchoList found;
    std::vector<Hit> hits;
    source.ask(view, workers_, asked);
    while (!asked.empty()) {
      hits.resize(asked.rays.size());
      trace(asked.rays, hits);
      source.answer(view, {asked, hits, {}, {}}, workers_, more, found);
      std::swap(asked, more);
      more.clear();
    }
    for (const Echo& echo : found.spread) {
      deposit(plan, echo, grid);
    }
  }

  [[nodiscard]] RayCounts ray_counts() const { return batch_->ray_counts(0); }

  [[nodiscard]] std::vector<double> time_traversal(const FlatPlan& plan, const Pose& world_from_sonar,
                                                   int repetitions) {
    return engine_->time_traversal({.plan = &plan, .world_from_sonar = world_from_sonar}, repetitions);
  }

  [[nodiscard]] Engine& engine() {
    engine_->place(placement_);
    return *engine_;
  }
  [[nodiscard]] Workers& workers() { return workers_; }
  [[nodiscard]] const Placement& placement() const { return placement_; }

 private:
  [[nodiscard]] PingView view_of(const FlatPlan& plan, const Pose& world_from_sonar, const EchoGrid& grid) const {
    return {.plan = &plan,
            .world_from_sonar = world_from_sonar,
            .placement = &placement_,
            .layers = {grid.order_count(), grid.ground_truth(), grid.labelled()}};
  }

  Workers workers_;
  std::unique_ptr<Engine> engine_;
  std::unique_ptr<EchoBatch> batch_;
  std::vector<Pose> at_home_;
  Placement placement_;
};

[[nodiscard]] inline std::unique_ptr<TestEngine> test_engine(std::string_view name, int threads = 2) {
  return std::make_unique<TestEngine>(name, threads);
}

}  // namespace insonify
