// beam_task.cpp -- traces or rasterises primary rays strip by strip, deposits their echoes and starts the secondary
// ones.

#include "echo/cpu/beam_task.h"

#include <algorithm>
#include <cstring>

#include "echo/model/deposit.h"
#include "echo/model/hit.h"
#include "echo/model/see_through.h"

namespace insonify {
namespace {

// Copies four rows of a column to four lanes of a packet, or back.
template <typename Value>
void copy_four(const Value* from, Value* to) {
  std::memcpy(to, from, 4 * sizeof(Value));
}

// Copies relief from a number of lanes to rows.
void set_relief(const ReliefLanes& reliefs, int lane, int count, const HitColumn& hits, int row) {
  std::copy_n(&reliefs.gradient_x[lane], count, &hits.gradient_x[row]);
  std::copy_n(&reliefs.gradient_y[lane], count, &hits.gradient_y[row]);
  std::copy_n(&reliefs.gradient_z[lane], count, &hits.gradient_z[row]);
  std::copy_n(&reliefs.reflectivity[lane], count, &hits.texture[row]);
}

}  // namespace

void BeamTask::prepare(const FlatPlan& plan, SecondarySampling sampling, const Refraction* refraction,
                       const LeftOut* left_out) {
  plan_ = &plan;
  refraction_ = refraction;
  left_out_ = left_out;
  sampling_ = sampling;
  primary_count_ = 0;
  secondary_.reset_counts();
  const std::size_t columns = static_cast<std::size_t>(kMostBeamsTogether) * plan.lattice.columns_per_beam;
  axes_.resize(std::max(axes_.size(), columns));
  const auto rows = static_cast<std::size_t>(plan.lattice.rows);
  if (segments_.position.size() < rows) {
    segments_.resize(plan.lattice.rows);
    strip_.resize(kTile, plan.lattice.rows);
    for (int column = 0; column < kTile; ++column) {
      hits_[column] = strip_.column(column);
    }
  }
  sums_.prepare(plan.bin_count);
  turns_.prepare(plan.lattice.rows);
}

void BeamTask::aim(const Pose& world_from_sonar, int first_beam, int last_beam) {
  const Lattice& lattice = plan_->lattice;
  first_column_ = first_beam * lattice.columns_per_beam;
  columns_ = (last_beam - first_beam) * lattice.columns_per_beam;
  sonar_ = (world_from_sonar.position - scene_.origin()).cast<float>();
  sonar_axes_ = world_from_sonar.orientation.toRotationMatrix().cast<float>();
  for (int column = 0; column < columns_; ++column) {
    axes_[column] = column_axes(lattice, first_column_ + column, sonar_axes_);
  }
  for (int lane = 0; lane < kPacketSize; ++lane) {
    primary_.set_origin(lane, sonar_);
  }
}

void BeamTask::aim_strip(int first_column) {
  for (int column = first_column; column < std::min(first_column + kTile, columns_); ++column) {
    aim_column(plan_->lattice, first_column_ + column, axes_[column], hits_[column - first_column]);
  }
}

// Loads the directions of a tile into the packet and disables lanes outside the lattice. Returns the number of rays.
int BeamTask::load_tile(int first_column, int first_row) {
  const int columns = std::min(kTile, columns_ - first_column);
  const int rows = std::min(kTile, plan_->lattice.rows - first_row);
  for (int i = 0; i < kTile; ++i) {
    const HitColumn& hits = hits_[i];
    const int lane = i * kTile;
    copy_four(&hits.direction_x[first_row], &primary_.rays.ray.dir_x[lane]);
    copy_four(&hits.direction_y[first_row], &primary_.rays.ray.dir_y[lane]);
    copy_four(&hits.direction_z[first_row], &primary_.rays.ray.dir_z[lane]);
    for (int j = 0; j < kTile; ++j) {
      primary_.valid[lane + j] = (i < columns) & (j < rows) ? -1 : 0;
    }
  }
  return columns * rows;
}

// Copies the packet's hits to the columns of the strip; rows beyond the lattice go to their padding. Returns whether
// there are any hits.
bool BeamTask::read_tile(int first_row) {
  if (primary_.nothing_hit()) {
    reliefs_.flatten();
    for (const HitColumn& hits : hits_) {
      for (int row = first_row; row < first_row + kTile; ++row) {
        hits.surface[row] = kNoSurface;
        hits.range[row] = hits.reflectivity[row] = 0;
      }
      set_relief(reliefs_, 0, kTile, hits, first_row);
    }
    return false;
  }
  scene_.shade(primary_.rays.hit, shading_);
  if (scene_.reliefs().any()) {
    scene_.add_relief(primary_.rays, refraction_, shading_, reliefs_);
  }
  if (refraction_ != nullptr) {
    scene_.appear(primary_.rays.ray, *refraction_, shading_, scene_.reliefs().any() ? &reliefs_ : nullptr);
  }
  for (int i = 0; i < kTile && scene_.reliefs().any(); ++i) {
    set_relief(reliefs_, i * kTile, kTile, hits_[i], first_row);
  }
  float range[kPacketSize];
  for (int lane = 0; lane < kPacketSize; ++lane) {
    range[lane] = shading_.surface[lane] == kNoSurface ? 0.0F : primary_.rays.ray.tfar[lane];
  }
  for (int i = 0; i < kTile; ++i) {
    const HitColumn& hits = hits_[i];
    const int lane = i * kTile;
    copy_four(&shading_.surface[lane], &hits.surface[first_row]);
    copy_four(&primary_.rays.hit.primID[lane], &hits.triangle[first_row]);
    copy_four(&range[lane], &hits.range[first_row]);
    copy_four(&shading_.normal_x[lane], &hits.normal_x[first_row]);
    copy_four(&shading_.normal_y[lane], &hits.normal_y[first_row]);
    copy_four(&shading_.normal_z[lane], &hits.normal_z[first_row]);
    copy_four(&shading_.reflectivity[lane], &hits.reflectivity[first_row]);
  }
  return true;
}

// Fills the strip with what lies behind the surfaces hit, along the same rays. Returns false, and leaves the strip as
// it is, where no surface lets sound through.
bool BeamTask::trace_behind(int columns) {
  bool any = false;
  for (int i = 0; i < columns; ++i) {
    any = any || (hits_[i].passing && any_passes_on(*plan_, hits_[i]));
  }
  if (!any) {
    return false;
  }
  int rows_met = 0;
  const int rows = hits_[0].rows;
  for (int first_row = 0; first_row < rows; first_row += kTile) {
    rows_met = read_tile_behind(columns, first_row, rows) ? first_row + kTile : rows_met;
  }
  for (int lane = 0; lane < kPacketSize; ++lane) {
    primary_.rays.ray.tnear[lane] = 0;
  }
  for (HitColumn& hits : hits_) {
    hits.rows = std::min(rows_met, rows);
    hits.passing = true;
  }
  return true;
}

// The same for one tile. Returns whether anything was hit.
bool BeamTask::read_tile_behind(int columns, int first_row, int rows) {
  for (int lane = 0; lane < kPacketSize; ++lane) {
    const HitColumn& hits = hits_[lane / kTile];
    const int row = first_row + lane % kTile;
    const bool hit = lane / kTile < columns && row < rows && hits.passing && hits.surface[row] != kNoSurface;
    const float passed = hit ? hits.passed[row] : 0.0F;
    hits.reached[row] = passed;
    primary_.valid[lane] = passed > 0 ? -1 : 0;
    primary_.rays.ray.tnear[lane] = passed > 0 ? hits.range[row] + kRayClearance : 0.0F;
    primary_.rays.ray.dir_x[lane] = hits.direction_x[row];
    primary_.rays.ray.dir_y[lane] = hits.direction_y[row];
    primary_.rays.ray.dir_z[lane] = hits.direction_z[row];
    primary_count_ += passed > 0 ? 1 : 0;
  }
  primary_.set_reach(plan_->true_max_range);
  scene_.intersect(primary_, refraction_);
  return read_tile(first_row);
}

void BeamTask::trace_strip(int first_column) {
  aim_strip(first_column);
  int rows_met = 0;
  for (int row = 0; row < plan_->lattice.rows; row += kTile) {
    primary_count_ += load_tile(first_column, row);
    primary_.set_reach(plan_->true_max_range);
    scene_.intersect(primary_, refraction_);
    rows_met = read_tile(row) ? row + kTile : rows_met;
  }
  for (HitColumn& hits : hits_) {
    hits.rows = std::min(rows_met, plan_->lattice.rows);
    hits.has_relief = scene_.reliefs().any();
    hits.passing = false;
  }
}

// Fills the strip from the raster instead.
void BeamTask::read_strip(int first_column) {
  aim_strip(first_column);
  int rows_met = 0;
  for (int column = first_column; column < std::min(first_column + kTile, columns_); ++column) {
    rows_met = std::max(rows_met, raster_.read(first_column_ + column, hits_[column - first_column]));
  }
  for (HitColumn& hits : hits_) {
    hits.rows = rows_met;
    hits.has_relief = scene_.reliefs().any();
    hits.passing = false;
  }
  if (scene_.reliefs().any()) {
    for (int column = first_column; column < std::min(first_column + kTile, columns_); ++column) {
      add_relief(hits_[column - first_column]);
    }
  }
}

// Adds relief to a column that was read from the raster. Writes up to HitStrip::kPadding rows more.
void BeamTask::add_relief(const HitColumn& hits) {
  const int rows = std::min(hits.rows + 1, plan_->lattice.rows);
  for (int first = 0; first < rows; first += ReliefHits::kLanes) {
    ReliefHits points;
    for (int lane = 0; lane < ReliefHits::kLanes; ++lane) {
      const int row = first + lane;
      const bool hit = row < rows && hits.surface[row] != kNoSurface;
      points.instance[lane] = hit ? instance_of(hits.surface[row]) : ReliefHits::kNone;
      points.triangle[lane] = hits.triangle[row];
      points.x[lane] = sonar_.x() + hits.range[row] * hits.direction_x[row];
      points.y[lane] = sonar_.y() + hits.range[row] * hits.direction_y[row];
      points.z[lane] = sonar_.z() + hits.range[row] * hits.direction_z[row];
      points.normal_x[lane] = hits.normal_x[row];
      points.normal_y[lane] = hits.normal_y[row];
      points.normal_z[lane] = hits.normal_z[row];
    }
    scene_.reliefs().find(points, reliefs_);
    set_relief(reliefs_, 0, ReliefHits::kLanes, hits, first);
    for (int lane = 0; lane < ReliefHits::kLanes; ++lane) {
      hits.reflectivity[first + lane] *= reliefs_.reflectivity[lane];
    }
  }
}

// Adds the echoes of the strip's hits to the grid.
void BeamTask::deposit_strip(int first_column, int columns, SecondarySampling sampling, EchoGrid& grid) {
  for (int i = 0; i < columns; ++i) {
    make_normals_unit(*plan_, hits_[i]);
  }
  if (plan_->model == EchoModel::kCalibrated) {
    turns_.find(*plan_, first_column_ + first_column, {hits_, static_cast<std::size_t>(columns)});
  }
  for (int column = first_column; column < first_column + columns; ++column) {
    HitColumn& hits = hits_[column - first_column];
    evaluate_column(*plan_, sampling, first_column_ + column, axes_[column], left_out_, hits, segments_);
    deposit_column(*plan_, first_column_ + column, hits, segments_, sums_, grid);
  }
}

void BeamTask::trace_only(const Pose& world_from_sonar, int first_beam, int last_beam) {
  aim(world_from_sonar, first_beam, last_beam);
  for (int column = 0; column < columns_; column += kTile) {
    aim_strip(column);
    for (int row = 0; row < plan_->lattice.rows; row += kTile) {
      load_tile(column, row);
      primary_.set_reach(plan_->true_max_range);
      scene_.intersect(primary_, refraction_);
    }
  }
}

void BeamTask::run(const Pose& world_from_sonar, int first_beam, int last_beam, const FanView* view, EchoGrid& grid,
                   std::vector<Echo>& arrivals, SecondaryTask::Log* log) {
  grid.clear(first_beam, last_beam);
  aim(world_from_sonar, first_beam, last_beam);
  if (view != nullptr) {
    raster_.draw(raster_scene_, *view, *plan_, first_column_, first_column_ + columns_);
  }
  arrivals.clear();
  secondary_.start(*plan_, {sonar_, sonar_axes_, refraction_}, grid, arrivals, log);

  // Rounding errors of sums depend on the order of their terms, and secondary echoes are added when a packet is full.
  // So that a ping does not depend on how beams are divided into tasks, packets end where the smallest tasks would end.
  const int columns_together = kLeastBeamsTogether * plan_->lattice.columns_per_beam;
  for (int first_column = 0; first_column < columns_; first_column += kTile) {
    workers_.check_stop();
    if (first_column % columns_together == 0) {
      secondary_.finish();
    }
    if (view != nullptr) {
      read_strip(first_column);
    } else {
      trace_strip(first_column);
    }
    const int columns = std::min(kTile, columns_ - first_column);
    deposit_strip(first_column, columns, sampling_, grid);
    if (sampling_ != SecondarySampling::kNone) {
      secondary_.reflect(hits_[0], strip_.stride(), first_column_ + first_column, columns);
    }
    for (int passed = 0; passed < kMostPassed && trace_behind(columns); ++passed) {
      deposit_strip(first_column, columns, SecondarySampling::kNone, grid);
    }
  }
  secondary_.finish();
}

}  // namespace insonify
