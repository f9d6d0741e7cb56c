// reference_engine.cpp -- computes a ping column by column, then adds the echoes that arrive in other beams.

#include "echo/reference/reference_engine.h"

#include <algorithm>

#include "echo/batch/host_batch.h"
#include "echo/model/normal_turns.h"
#include "echo/model/see_through.h"
#include "echo/reference/reference_column.h"

namespace insonify {
namespace {

// A task has whole groups of columns whose normals are compared.
constexpr int kBeamsTogether = NormalTurns::kColumns;

// Compares the normals of neighbouring columns.
void find_turns(const FlatPlan& plan, int first, std::span<ReferenceColumn> columns) {
  if (plan.model != EchoModel::kCalibrated) {
    return;
  }
  std::vector<HitColumn> hits;
  for (ReferenceColumn& column : columns) {
    hits.push_back(column.hits());
  }
  NormalTurns turns;
  turns.prepare(plan.lattice.rows);
  turns.find(plan, first, hits);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    columns[i].hits().curved = hits[i].curved;
  }
}

// Adds the echoes from behind surfaces that let sound through.
void insonify_behind(const FlatPlan& plan, int first, std::span<ReferenceColumn> columns, const Workers& workers,
                     EchoGrid& grid) {
  for (int passed = 0; passed < kMostPassed && std::ranges::any_of(columns, &ReferenceColumn::passes_on); ++passed) {
    for (ReferenceColumn& column : columns) {
      column.trace_behind(workers);
    }
    find_turns(plan, first, columns);
    for (ReferenceColumn& column : columns) {
      column.deposit_primary_echoes(SecondarySampling::kNone, grid);
    }
  }
}

class ReferenceBatch final : public HostBatch {
 public:
  ReferenceBatch(ReferenceEngine& engine, Workers& workers) : HostBatch(workers), engine_(engine) {}

 protected:
  void insonify(std::span<const PingView> views) override {
    for (std::size_t i = 0; i < views.size(); ++i) {
      counts_[i] = engine_.insonify(views[i], *grids_[i]);
    }
  }

 private:
  ReferenceEngine& engine_;
};

}  // namespace

const EngineKind ReferenceEngine::kKind = {
    .name = "reference", .bends_rays = true, .make = [](Workers& workers, std::string_view) -> std::unique_ptr<Engine> {
      return std::make_unique<ReferenceEngine>(workers);
    }};

void ReferenceEngine::set_scene(const Scene& scene) {
  origin_ = scene.middle();
  scene_.set(scene, origin_);
  boxes_.set(scene, origin_);
  left_out_ = nullptr;
  moved_.clear();
}

void ReferenceEngine::move(int instance, const Pose& world_from_mesh) {
  scene_.move(instance, world_from_mesh);
  boxes_.move(instance, {world_from_mesh.position - origin_, world_from_mesh.orientation});
}

void ReferenceEngine::place(const Placement& placement) {
  for (const int instance : moved_) {
    move(instance, placement.at_home[static_cast<std::size_t>(instance)]);
  }
  moved_.clear();
  for (const Placement::Moved& one : placement.moved) {
    move(one.instance, one.world_from_mesh);
    moved_.push_back(one.instance);
  }
}

std::unique_ptr<EchoBatch> ReferenceEngine::make_batch() {
  return std::make_unique<ReferenceBatch>(*this, workers_);
}

void ReferenceEngine::trace(std::span<const RayRun> runs) {
  for (const RayRun& run : runs) {
    if (run.placement != nullptr) {
      place(*run.placement);
    }
    scene_.bend_by(run.refraction);
    workers_.for_each(static_cast<int>(run.rays.size()), [&](int i, int) {
      const Ray& ray = run.rays[i];
      const RayHit hit = scene_.nearest(ray);
      run.hits[i] = {.distance = hit.distance};
      if (hit.met()) {
        const bool from_behind = hit.normal.dot(ray.direction) > 0;
        run.hits[i] = {hit.distance,     from_behind ? Vec3(-hit.bent) : hit.bent,
                       hit.instance,     hit.material,
                       hit.reflectivity, hit.texture};
      }
    });
  }
}

SecondarySampling ReferenceEngine::choose_sampling(const FlatPlan& plan, const Pose& world_from_sonar) {
  if (scene_.bends()) {
    return probes_.choose_blindly(plan);
  }
  const std::span<const Ray> rays = probes_.aim(plan, world_from_sonar);
  trace(rays, probes_.hits());
  return probes_.choose(plan, origin_, boxes_);
}

RayCounts ReferenceEngine::insonify(const PingView& view, EchoGrid& grid) {
  if (view.placement != nullptr) {
    place(*view.placement);
  }
  scene_.bend_by(view.refraction);
  const FlatPlan& plan = *view.plan;
  const Pose& world_from_sonar = view.world_from_sonar;
  const int beams = plan.beam_count, per_beam = plan.lattice.columns_per_beam;
  const SecondarySampling sampling = choose_sampling(plan, world_from_sonar);
  std::vector<RayCounts> counts(beams);
  std::vector<std::vector<Echo>> arrivals(beams);
  workers_.for_each((beams + kBeamsTogether - 1) / kBeamsTogether, [&](int task, int) {
    const int first_beam = task * kBeamsTogether, last_beam = std::min(first_beam + kBeamsTogether, beams);
    grid.clear(first_beam, last_beam);
    for (int first = first_beam * per_beam; first < last_beam * per_beam; first += NormalTurns::kColumns) {
      std::vector<ReferenceColumn> columns;
      columns.reserve(NormalTurns::kColumns);
      for (int column = first; column < std::min(first + NormalTurns::kColumns, last_beam * per_beam); ++column) {
        columns.emplace_back(scene_, left_out_.get(), plan, sampling, column, world_from_sonar)
            .trace_primary_rays(workers_);
      }
      find_turns(plan, first, columns);
      for (std::size_t i = 0; i < columns.size(); ++i) {
        columns[i].insonify(grid, arrivals[(first + static_cast<int>(i)) / per_beam], workers_);
      }
      insonify_behind(plan, first, columns, workers_, grid);
      for (std::size_t i = 0; i < columns.size(); ++i) {
        counts[(first + static_cast<int>(i)) / per_beam] += columns[i].counts();
      }
    }
  });
  for (const std::vector<Echo>& of_beam : arrivals) {
    for (const Echo& echo : of_beam) {
      deposit(plan, echo, grid);
    }
  }
  RayCounts all{.secondary = probes_.hits().size()};
  for (const RayCounts& of_beam : counts) {
    all += of_beam;
  }
  return all;
}

}  // namespace insonify
