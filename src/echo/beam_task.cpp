// beam_task.cpp -- out, straight back, on to a second surface, and back from there.

#include "echo/beam_task.h"

#include <algorithm>
#include <cmath>

#include "base/vector_math.h"
#include "echo/deposit.h"
#include "echo/ray_limits.h"

namespace insonify {
namespace {

constexpr int kColumnsPerTask = 16;

// Where the hits of a packet of onward rays lie, how far it is back from there, and how long the whole way is.
struct Returns {
  float x[kPacketSize], y[kPacketSize], z[kPacketSize];                 // Second surface.
  float back_x[kPacketSize], back_y[kPacketSize], back_z[kPacketSize];  // Unit vector from there to the sonar.
  float distance[kPacketSize];                                          // Of the way back.
  float path_length[kPacketSize];                                       // Out, across and back.
};

INSONIFY_VECTOR_CLONES
void measure_returns(const RTCRay16& rays, const OnwardOrigin* origins, Vec3f sonar, Returns& returns) {
  const float sonar_x = sonar[0], sonar_y = sonar[1], sonar_z = sonar[2];
  for (int lane = 0; lane < kPacketSize; ++lane) {
    const float across = rays.tfar[lane];
    const float x = rays.org_x[lane] + rays.dir_x[lane] * across;
    const float y = rays.org_y[lane] + rays.dir_y[lane] * across;
    const float z = rays.org_z[lane] + rays.dir_z[lane] * across;
    const float dx = sonar_x - x, dy = sonar_y - y, dz = sonar_z - z;
    const float distance = std::sqrt(dx * dx + dy * dy + dz * dz);
    const float scale = 1 / distance;
    returns.x[lane] = x;
    returns.y[lane] = y;
    returns.z[lane] = z;
    returns.back_x[lane] = dx * scale;
    returns.back_y[lane] = dy * scale;
    returns.back_z[lane] = dz * scale;
    returns.distance[lane] = distance;
    returns.path_length[lane] = origins[lane].range + across + distance;
  }
}

}  // namespace

int beams_per_task(const Lattice& lattice) {
  return std::max(1, kColumnsPerTask / lattice.columns_per_beam);
}

void BeamTask::prepare(const PingPlan& plan) {
  plan_ = &plan;
  counts_ = {};
  const std::size_t columns = static_cast<std::size_t>(beams_per_task(plan.lattice)) * plan.lattice.columns_per_beam;
  along_.resize(std::max(along_.size(), columns));
  const auto rows = static_cast<std::size_t>(plan.lattice.rows);
  if (stretches_.position.size() < rows) {
    stretches_.resize(plan.lattice.rows);
    for (HitColumn& hits : hits_) {
      hits.resize(plan.lattice.rows);
    }
  }
  run_.prepare(plan.sonar.bin_count);
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

// Takes what the packet met over into the strip's columns; rows beyond the lattice land in their padding.
void BeamTask::read_tile(int first_column, int first_row) {
  const RTCHit16& hit = primary_.rays.hit;
  for (int i = 0; i < std::min(kTile, columns_ - first_column); ++i) {
    HitColumn& hits = hits_[i];
    for (int j = 0; j < kTile; ++j) {
      const int lane = i * kTile + j;
      const int row = first_row + j;
      if (!primary_.hit(lane)) {
        hits.surface[row] = kNoSurface;
        hits.range[row] = 0;
        hits.reflectivity[row] = 0;
        continue;
      }
      const CpuScene::Shading shading =
          scene_.shade(hit.geomID[lane], hit.instID[0][lane], hit.primID[lane], hit.u[lane], hit.v[lane]);
      hits.surface[row] = shading.surface;
      hits.range[row] = primary_.rays.ray.tfar[lane];
      hits.normal_x[row] = shading.normal.x();
      hits.normal_y[row] = shading.normal.y();
      hits.normal_z[row] = shading.normal.z();
      hits.reflectivity[row] = scene_.reflectivity()[material_of(shading.surface)];
    }
  }
}

void BeamTask::trace_strip(int first_column) {
  for (int row = 0; row < plan_->lattice.rows; row += kTile) {
    counts_.primary += load_tile(first_column, row);
    primary_.intersect(scene_.handle(), plan_->true_max_range);
    read_tile(first_column, row);
  }
}

// Follows the selected hits of a strip, in the order of its tiles so that packets stay together.
void BeamTask::send_onward(int first_column, EchoGrid& grid, Log* log) {
  const Lattice& lattice = plan_->lattice;
  const int columns = std::min(kTile, columns_ - first_column);
  for (int row0 = 0; row0 < lattice.rows; row0 += kTile) {
    const int row_end = std::min(row0 + kTile, lattice.rows);
    Sample samples[kTile * kTile + 1];
    int count = 0;
    for (int column = 0; column < columns; ++column) {
      const float* selected = hits_[column].selected.data();
      for (int row = row0; row < row_end; ++row) {
        samples[count] = {column, row};  // Kept or overwritten: no branch to mispredict.
        count += selected[row] > 0 ? 1 : 0;
      }
    }
    for (int i = 0; i < count; ++i) {
      const auto [column, row] = samples[i];
      const HitColumn& hits = hits_[column];
      const int lattice_column = first_column_ + first_column + column;
      const Vec3f direction = along_[first_column + column] * lattice.cos_elevations(lattice_column)[row] +
                              up_ * lattice.sin_elevations(lattice_column)[row];
      const Vec3f normal(hits.normal_x[row], hits.normal_y[row], hits.normal_z[row]);
      onward_.set_origin(onward_count_, sonar_ + direction * hits.range[row]);
      onward_.set_direction(onward_count_, direction - 2 * hits.facing[row] * normal);
      origins_[onward_count_] = {lattice_column, row, hits.range[row], hits.strength[row], hits.selected[row]};
      if (++onward_count_ == kPacketSize) {
        trace_onward(grid, log);
      }
    }
  }
}

// Traces the onward rays in the mirror directions, and readies the return legs of what they meet.
void BeamTask::trace_onward(EchoGrid& grid, Log* log) {
  const int count = onward_count_;
  onward_count_ = 0;
  onward_.set_count(count);
  if (log != nullptr) {
    log->onward.push_back(onward_);
  }
  onward_.intersect(scene_.handle(), plan_->true_max_range);
  counts_.secondary += count;

  Returns returns;
  measure_returns(onward_.rays.ray, origins_, sonar_, returns);
  for (int lane = 0; lane < count; ++lane) {
    if (!onward_.hit(lane) || 0.5F * returns.path_length[lane] >= plan_->true_max_range) {
      continue;
    }
    const RTCHit16& hit = onward_.rays.hit;
    const CpuScene::Shading shading =
        scene_.shade(hit.geomID[lane], hit.instID[0][lane], hit.primID[lane], hit.u[lane], hit.v[lane]);
    const float incidence = std::abs(shading.normal.dot(onward_.direction(lane))) / shading.normal.norm();
    const OnwardOrigin& origin = origins_[lane];
    const int slot = returning_count_;
    returning_[slot] = secondary_echo(*plan_, origin, returns.path_length[lane], shading.surface);
    returning_strength_[slot] = origin.strength * incidence * scene_.reflectivity()[material_of(shading.surface)];
    returning_rest_[slot] = returns.path_length[lane] - 2 * origin.range;
    back_.set_origin(slot, {returns.x[lane], returns.y[lane], returns.z[lane]});
    back_.set_direction(slot, {returns.back_x[lane], returns.back_y[lane], returns.back_z[lane]});
    back_.rays.ray.tfar[slot] = returns.distance[lane] - kRayClearance;
    if (++returning_count_ == kPacketSize) {
      finish_returns(grid, log);
    }
  }
}

// Deposits those of the returning echoes whose way back is clear.
void BeamTask::finish_returns(EchoGrid& grid, Log* log) {
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

  for (int first_column = 0; first_column < columns_; first_column += kTile) {
    trace_strip(first_column);
    for (int column = first_column; column < std::min(first_column + kTile, columns_); ++column) {
      const Vec3f& along = along_[column];
      HitColumn& hits = hits_[column - first_column];
      evaluate_column(*plan_, first_column_ + column, {along, up_.cross(along), up_}, hits, stretches_);
      deposit_column(*plan_, first_column_ + column, hits, stretches_, run_, grid);
    }
    if (plan_->secondary != SecondaryEchoes::kNone) {
      send_onward(first_column, grid, log);
    }
  }
  if (onward_count_ > 0) {
    trace_onward(grid, log);
  }
  if (returning_count_ > 0) {
    finish_returns(grid, log);
  }
}

}  // namespace insonify
