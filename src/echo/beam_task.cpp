// beam_task.cpp -- out, straight back, on to a second surface, and back from there.

#include "echo/beam_task.h"

#include <algorithm>
#include <cmath>

#include "echo/deposit.h"
#include "echo/ray_limits.h"

namespace insonify {
namespace {

constexpr int kColumnsPerTask = 16;
constexpr int kTile = 4;  // Columns and rows of a packet: the shape in which sixteen neighbours spread least.

}  // namespace

int beams_per_task(const Lattice& lattice) {
  return std::max(1, kColumnsPerTask / lattice.columns_per_beam);
}

void BeamTask::prepare(const PingPlan& plan) {
  plan_ = &plan;
  counts_ = {};
  const int columns = beams_per_task(plan.lattice) * plan.lattice.columns_per_beam;
  if (along_.size() < static_cast<std::size_t>(columns)) {
    along_.resize(columns);
    hits_.resize(columns);
  }
  for (HitColumn& hits : hits_) {
    if (hits.range.size() < static_cast<std::size_t>(plan.lattice.rows)) {
      hits.resize(plan.lattice.rows);
    }
  }
}

void BeamTask::aim(const Pose& world_from_sonar, int first_beam, int last_beam) {
  const Lattice& lattice = plan_->lattice;
  first_column_ = first_beam * lattice.columns_per_beam;
  columns_ = (last_beam - first_beam) * lattice.columns_per_beam;
  sonar_ = (world_from_sonar.position - scene_.origin()).cast<float>();
  const Eigen::Matrix3f axes = world_from_sonar.orientation.toRotationMatrix().cast<float>();
  up_ = axes.col(2);
  for (int column = 0; column < columns_; ++column) {
    along_[column] = axes.col(0) * lattice.cos_azimuth[first_column_ + column] +
                     axes.col(1) * lattice.sin_azimuth[first_column_ + column];
  }
  for (int lane = 0; lane < kPacketSize; ++lane) {
    primary_.set_origin(lane, sonar_);
  }
}

// Points the packet at a tile; lanes beyond the lattice are switched off. Returns how many are on.
int BeamTask::load_tile(int first_column, int first_row) {
  const Lattice& lattice = plan_->lattice;
  int count = 0;
  for (int i = 0; i < kTile; ++i) {
    const int column = std::min(first_column + i, columns_ - 1);
    const float* cos_el = lattice.cos_elevations(first_column_ + column);
    const float* sin_el = lattice.sin_elevations(first_column_ + column);
    for (int j = 0; j < kTile; ++j) {
      const int row = std::min(first_row + j, lattice.rows - 1);
      const int lane = i * kTile + j;
      primary_.set_direction(lane, along_[column] * cos_el[row] + up_ * sin_el[row]);
      const bool on = first_column + i < columns_ && first_row + j < lattice.rows;
      primary_.valid[lane] = on ? -1 : 0;
      count += on ? 1 : 0;
    }
  }
  return count;
}

void BeamTask::trace_primaries() {
  const int rows = plan_->lattice.rows;
  for (int column = 0; column < columns_; column += kTile) {
    for (int row = 0; row < rows; row += kTile) {
      counts_.primary += load_tile(column, row);
      primary_.intersect(scene_.handle(), plan_->true_max_range);
      for (int lane = 0; lane < kPacketSize; ++lane) {
        if (primary_.valid[lane] == 0) {
          continue;
        }
        HitColumn& hits = hits_[column + lane / kTile];
        const int sample = row + lane % kTile;
        if (!primary_.hit(lane)) {
          hits.surface[sample] = kNoSurface;
          hits.range[sample] = 0;
          hits.reflectivity[sample] = 0;
          continue;
        }
        const RTCHit16& hit = primary_.rays.hit;
        const CpuScene::Shading shading =
            scene_.shade(hit.geomID[lane], hit.instID[0][lane], hit.primID[lane], hit.u[lane], hit.v[lane]);
        hits.surface[sample] = shading.surface;
        hits.range[sample] = primary_.rays.ray.tfar[lane];
        hits.normal_x[sample] = shading.normal.x();
        hits.normal_y[sample] = shading.normal.y();
        hits.normal_z[sample] = shading.normal.z();
        hits.reflectivity[sample] = scene_.reflectivity()[material_of(shading.surface)];
      }
    }
  }
}

// Follows the selected hits, in the order of the tiles so that packets stay together.
void BeamTask::send_onward(EchoGrid& grid, Log* log) {
  int waiting = 0;
  for (int column0 = 0; column0 < columns_; column0 += kTile) {
    const int column_end = std::min(column0 + kTile, columns_);
    for (int row0 = 0; row0 < plan_->lattice.rows; row0 += kTile) {
      const int row_end = std::min(row0 + kTile, plan_->lattice.rows);
      for (int column = column0; column < column_end; ++column) {
        const float* selected = hits_[column].selected.data();
        for (int row = row0; row < row_end; ++row) {
          waiting_[waiting] = {column, row};  // Kept or overwritten: no branch to mispredict.
          waiting += selected[row] > 0 ? 1 : 0;
        }
      }
      if (waiting >= kPacketSize) {
        trace_onward(kPacketSize, grid, log);
        std::copy(waiting_ + kPacketSize, waiting_ + waiting, waiting_);
        waiting -= kPacketSize;
      }
    }
  }
  if (waiting > 0) {
    trace_onward(waiting, grid, log);
  }
  finish_returns(grid, log);
}

// Sends the first `count` waiting samples on in their mirror directions, and readies the return legs of what they meet.
void BeamTask::trace_onward(int count, EchoGrid& grid, Log* log) {
  const Lattice& lattice = plan_->lattice;
  OnwardOrigin origins[kPacketSize];
  for (int lane = 0; lane < count; ++lane) {
    const auto [column, row] = waiting_[lane];
    const HitColumn& hits = hits_[column];
    const int lattice_column = first_column_ + column;
    const Vec3f direction = along_[column] * lattice.cos_elevations(lattice_column)[row] +
                            up_ * lattice.sin_elevations(lattice_column)[row];
    const Vec3f normal(hits.normal_x[row], hits.normal_y[row], hits.normal_z[row]);
    onward_.set_origin(lane, sonar_ + direction * hits.range[row]);
    onward_.set_direction(lane, direction - 2 * hits.facing[row] * normal);
    origins[lane] = {lattice_column, row, hits.range[row], hits.strength[row], hits.selected[row]};
  }
  onward_.set_count(count);
  if (log != nullptr) {
    log->onward.push_back(onward_);
  }
  onward_.intersect(scene_.handle(), plan_->true_max_range);
  counts_.secondary += count;

  for (int lane = 0; lane < count; ++lane) {
    if (!onward_.hit(lane)) {
      continue;
    }
    const float across = onward_.rays.ray.tfar[lane];
    const Vec3f point = onward_.origin(lane) + onward_.direction(lane) * across;
    const Vec3f back = sonar_ - point;
    const float distance = back.norm();
    const float path_length = origins[lane].range + across + distance;
    if (0.5F * path_length >= plan_->true_max_range) {
      continue;
    }
    const RTCHit16& hit = onward_.rays.hit;
    const CpuScene::Shading shading =
        scene_.shade(hit.geomID[lane], hit.instID[0][lane], hit.primID[lane], hit.u[lane], hit.v[lane]);
    const float incidence = std::abs(shading.normal.dot(onward_.direction(lane))) / shading.normal.norm();
    returning_[returning_count_] = secondary_echo(*plan_, origins[lane], path_length, shading.surface);
    returning_strength_[returning_count_] =
        origins[lane].strength * incidence * scene_.reflectivity()[material_of(shading.surface)];
    returning_rest_[returning_count_] = path_length - 2 * origins[lane].range;
    back_.set_origin(returning_count_, point);
    back_.set_direction(returning_count_, back / distance);
    back_.rays.ray.tfar[returning_count_] = distance - kRayClearance;
    if (++returning_count_ == kPacketSize) {
      finish_returns(grid, log);
    }
  }
}

// Deposits those of the returning echoes whose way back is clear.
void BeamTask::finish_returns(EchoGrid& grid, Log* log) {
  if (returning_count_ == 0) {
    return;
  }
  back_.set_count(returning_count_);
  if (log != nullptr) {
    log->back.push_back(back_);
  }
  back_.occlude(scene_.handle());
  counts_.return_legs += returning_count_;
  float power[kPacketSize];
  secondary_powers(*plan_, returning_count_, returning_strength_, returning_rest_, power);
  for (int lane = 0; lane < returning_count_; ++lane) {
    if (!back_.blocked(lane)) {
      returning_[lane].power = power[lane];
      deposit(*plan_, returning_[lane], grid);
    }
  }
  returning_count_ = 0;
}

void BeamTask::trace_only(const Pose& world_from_sonar, int first_beam, int last_beam) {
  aim(world_from_sonar, first_beam, last_beam);
  for (int column = 0; column < columns_; column += kTile) {
    for (int row = 0; row < plan_->lattice.rows; row += kTile) {
      load_tile(column, row);
      primary_.intersect(scene_.handle(), plan_->true_max_range);
    }
  }
}

void BeamTask::run(const Pose& world_from_sonar, int first_beam, int last_beam, EchoGrid& grid, Log* log) {
  grid.clear(first_beam, last_beam);
  aim(world_from_sonar, first_beam, last_beam);
  for (int lane = 0; lane < kPacketSize; ++lane) {
    onward_.rays.ray.tnear[lane] = back_.rays.ray.tnear[lane] = kRayClearance;
  }

  trace_primaries();
  for (int column = 0; column < columns_; ++column) {
    const Vec3f& along = along_[column];
    evaluate_column(*plan_, first_column_ + column, {along, up_.cross(along), up_}, hits_[column]);
    deposit_column(*plan_, first_column_ + column, hits_[column], grid);
  }
  if (plan_->secondary != SecondaryEchoes::kNone) {
    send_onward(grid, log);
  }
}

}  // namespace insonify
