// beam_task.cpp -- out, straight back, on to a second surface, and back from there.

#include "echo/beam_task.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "base/vector_math.h"
#include "echo/deposit.h"
#include "echo/ray_limits.h"

namespace insonify {
namespace {

// Where the hits of a packet of onward rays lie, how far it is back from there, and what is to come of it.
struct Returns {
  float x[kPacketSize], y[kPacketSize], z[kPacketSize];                 // Second surface.
  float back_x[kPacketSize], back_y[kPacketSize], back_z[kPacketSize];  // Unit vector from there to the sonar.
  float distance[kPacketSize];                                          // Of the way back.
  float path_length[kPacketSize];                                       // Out, across and back.
  float strength[kPacketSize];                                          // See secondary_powers().
  float within[kPacketSize];                                            // 1 where the echo is from within the range.
};

// Readies lanes [first, last) of a packet: on from the hits at the given places of a strip, in the mirror direction.
INSONIFY_VECTOR_CLONES
void mirror(const HitColumn& strip, const int* __restrict__ place, int first, int last, Vec3f sonar,
            RTCRay16& __restrict__ rays, BeamTask::Origins& __restrict__ origins) {
  const float* __restrict__ direction_x = strip.direction_x;
  const float* __restrict__ direction_y = strip.direction_y;
  const float* __restrict__ direction_z = strip.direction_z;
  const float* __restrict__ normal_x = strip.normal_x;
  const float* __restrict__ normal_y = strip.normal_y;
  const float* __restrict__ normal_z = strip.normal_z;
  const float* __restrict__ facing = strip.facing;
  const float* __restrict__ strength = strip.strength;
  const float* __restrict__ range = strip.range;
  const float* __restrict__ selected = strip.selected;
  const float sonar_x = sonar[0], sonar_y = sonar[1], sonar_z = sonar[2];
  for (int lane = first; lane < last; ++lane) {
    const int at = place[lane];
    const float x = direction_x[at], y = direction_y[at], z = direction_z[at];
    const float out = range[at], turn = 2 * facing[at];
    rays.org_x[lane] = sonar_x + x * out;
    rays.org_y[lane] = sonar_y + y * out;
    rays.org_z[lane] = sonar_z + z * out;
    rays.dir_x[lane] = x - turn * normal_x[at];
    rays.dir_y[lane] = y - turn * normal_y[at];
    rays.dir_z[lane] = z - turn * normal_z[at];
    origins.range[lane] = out;
    origins.strength[lane] = strength[at];
    origins.selected[lane] = selected[at];
  }
}

INSONIFY_VECTOR_CLONES
void measure_returns(const RTCRay16& __restrict__ rays, const CpuScene::Shading& __restrict__ met,
                     const BeamTask::Origins& __restrict__ origins, Vec3f sonar, float max_range,
                     Returns& __restrict__ returns) {
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
    const float path_length = origins.range[lane] + across + distance;
    returns.path_length[lane] = path_length;
    returns.within[lane] = (met.surface[lane] != kNoSurface) & (0.5F * path_length < max_range) ? 1.0F : 0.0F;
    const float nx = met.normal_x[lane], ny = met.normal_y[lane], nz = met.normal_z[lane];
    const float facing = nx * rays.dir_x[lane] + ny * rays.dir_y[lane] + nz * rays.dir_z[lane];
    const float incidence = std::abs(facing) / std::sqrt(nx * nx + ny * ny + nz * nz);
    returns.strength[lane] = origins.strength[lane] * incidence * met.reflectivity[lane];
  }
}

// Four rows of one column, to or from their four lanes of a packet.
template <typename Value>
void copy_four(const Value* from, Value* to) {
  std::memcpy(to, from, 4 * sizeof(Value));
}

}  // namespace

void BeamTask::prepare(const PingPlan& plan) {
  plan_ = &plan;
  counts_ = {};
  const std::size_t columns = static_cast<std::size_t>(kMostBeamsTogether) * plan.lattice.columns_per_beam;
  axes_.resize(std::max(axes_.size(), columns));
  const auto rows = static_cast<std::size_t>(plan.lattice.rows);
  if (stretches_.position.size() < rows) {
    stretches_.resize(plan.lattice.rows);
    strip_.resize(kTile, plan.lattice.rows);
    for (int column = 0; column < kTile; ++column) {
      hits_[column] = strip_.column(column);
    }
  }
  sums_.prepare(plan.sonar.bin_count);
}

void BeamTask::aim(const Pose& world_from_sonar, int first_beam, int last_beam) {
  const Lattice& lattice = plan_->lattice;
  first_column_ = first_beam * lattice.columns_per_beam;
  columns_ = (last_beam - first_beam) * lattice.columns_per_beam;
  sonar_ = (world_from_sonar.position - scene_.origin()).cast<float>();
  const Eigen::Matrix3f axes = world_from_sonar.orientation.toRotationMatrix().cast<float>();
  for (int column = 0; column < columns_; ++column) {
    const float cos_az = lattice.cos_azimuth[first_column_ + column];
    const float sin_az = lattice.sin_azimuth[first_column_ + column];
    axes_[column] = {axes.col(0) * cos_az + axes.col(1) * sin_az, axes.col(1) * cos_az - axes.col(0) * sin_az,
                     axes.col(2)};
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

// Points the packet at a tile; lanes beyond the lattice are switched off. Returns how many are on.
int BeamTask::load_tile(int first_column, int first_row) {
  const int columns = std::min(kTile, columns_ - first_column);
  const int rows = std::min(kTile, plan_->lattice.rows - first_row);
  for (int i = 0; i < kTile; ++i) {
    const HitColumn& hits = hits_[i];
    copy_four(&hits.direction_x[first_row], &primary_.rays.ray.dir_x[i * kTile]);
    copy_four(&hits.direction_y[first_row], &primary_.rays.ray.dir_y[i * kTile]);
    copy_four(&hits.direction_z[first_row], &primary_.rays.ray.dir_z[i * kTile]);
    for (int j = 0; j < kTile; ++j) {
      primary_.valid[i * kTile + j] = (i < columns) & (j < rows) ? -1 : 0;
    }
  }
  return columns * rows;
}

// Takes what the packet met over into the strip's columns; rows beyond the lattice land in their padding. Returns
// whether it met anything.
bool BeamTask::read_tile(int first_row) {
  if (primary_.nothing_hit()) {
    for (int i = 0; i < kTile; ++i) {
      for (int row = first_row; row < first_row + kTile; ++row) {
        hits_[i].surface[row] = kNoSurface;
        hits_[i].range[row] = hits_[i].reflectivity[row] = 0;
      }
    }
    return false;
  }
  scene_.shade(primary_.rays.hit, shading_);
  float range[kPacketSize];
  for (int lane = 0; lane < kPacketSize; ++lane) {
    range[lane] = shading_.surface[lane] == kNoSurface ? 0.0F : primary_.rays.ray.tfar[lane];
  }
  for (int i = 0; i < kTile; ++i) {
    const HitColumn& hits = hits_[i];
    const int lane = i * kTile;
    copy_four(&shading_.surface[lane], &hits.surface[first_row]);
    copy_four(&range[lane], &hits.range[first_row]);
    copy_four(&shading_.normal_x[lane], &hits.normal_x[first_row]);
    copy_four(&shading_.normal_y[lane], &hits.normal_y[first_row]);
    copy_four(&shading_.normal_z[lane], &hits.normal_z[first_row]);
    copy_four(&shading_.reflectivity[lane], &hits.reflectivity[first_row]);
  }
  return true;
}

void BeamTask::trace_strip(int first_column) {
  aim_strip(first_column);
  int rows_met = 0;
  for (int row = 0; row < plan_->lattice.rows; row += kTile) {
    counts_.primary += load_tile(first_column, row);
    primary_.intersect(scene_.handle(), plan_->true_max_range);
    rows_met = read_tile(row) ? row + kTile : rows_met;
  }
  for (HitColumn& hits : hits_) {
    hits.rows = std::min(rows_met, plan_->lattice.rows);
  }
}

// The same strip from the raster.
void BeamTask::read_strip(int first_column) {
  aim_strip(first_column);
  int rows_met = 0;
  for (int column = first_column; column < std::min(first_column + kTile, columns_); ++column) {
    rows_met = std::max(rows_met, raster_.read(first_column_ + column, hits_[column - first_column]));
  }
  for (HitColumn& hits : hits_) {
    hits.rows = rows_met;
  }
}

// Follows the selected hits of a strip, in the order of its tiles so that packets stay together.
void BeamTask::send_onward(int first_column, EchoGrid& grid, Log* log) {
  const int columns = std::min(kTile, columns_ - first_column);
  const int rows = hits_[0].rows;
  const int stride = strip_.stride();
  const float* selected = hits_[0].selected;
  int loaded = onward_count_;  // Lanes whose rays are in the packet already.
  for (int row0 = 0; row0 < rows; row0 += kTile) {
    const unsigned in_lattice = (1U << std::min(kTile, rows - row0)) - 1;
    unsigned samples = 0;
    for (int column = 0; column < columns; ++column) {
      samples |= (positive_of_four(&selected[column * stride + row0]) & in_lattice) << (column * kTile);
    }
    for (; samples != 0; samples &= samples - 1) {
      const int sample = std::countr_zero(samples);
      const int column = sample / kTile, row = row0 + sample % kTile;
      place_[onward_count_] = column * stride + row;
      origins_.column[onward_count_] = first_column_ + first_column + column;
      origins_.row[onward_count_] = row;
      if (++onward_count_ == kPacketSize) {
        mirror(hits_[0], place_, loaded, kPacketSize, sonar_, onward_.rays.ray, origins_);
        trace_onward(grid, log);
        loaded = 0;
      }
    }
  }
  mirror(hits_[0], place_, loaded, onward_count_, sonar_, onward_.rays.ray, origins_);
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

  scene_.shade(onward_.rays.hit, shading_);
  Returns returns;
  measure_returns(onward_.rays.ray, shading_, origins_, sonar_, plan_->true_max_range, returns);
  for (unsigned lanes = positive_of_packet(returns.within) & ((1U << count) - 1); lanes != 0; lanes &= lanes - 1) {
    const int lane = std::countr_zero(lanes);
    const int slot = returning_count_;
    returning_[slot] = secondary_echo(*plan_, origins_.column[lane], origins_.row[lane], origins_.selected[lane],
                                      returns.path_length[lane], shading_.surface[lane]);
    returning_strength_[slot] = returns.strength[lane];
    returning_rest_[slot] = returns.path_length[lane] - 2 * origins_.range[lane];
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
    aim_strip(column);
    for (int row = 0; row < plan_->lattice.rows; row += kTile) {
      load_tile(column, row);
      primary_.intersect(scene_.handle(), plan_->true_max_range);
    }
  }
}

void BeamTask::run(const Pose& world_from_sonar, int first_beam, int last_beam, const FanView* view, EchoGrid& grid,
                   Log* log) {
  grid.clear(first_beam, last_beam);
  aim(world_from_sonar, first_beam, last_beam);
  if (view != nullptr) {
    raster_.draw(raster_scene_, *view, *plan_, first_column_, first_column_ + columns_);
  }
  for (int lane = 0; lane < kPacketSize; ++lane) {
    onward_.rays.ray.tnear[lane] = back_.rays.ray.tnear[lane] = kRayClearance;
  }

  for (int first_column = 0; first_column < columns_; first_column += kTile) {
    if (view != nullptr) {
      read_strip(first_column);
    } else {
      trace_strip(first_column);
    }
    for (int column = first_column; column < std::min(first_column + kTile, columns_); ++column) {
      const HitColumn& hits = hits_[column - first_column];
      evaluate_column(*plan_, first_column_ + column, axes_[column], hits, stretches_);
      deposit_column(*plan_, first_column_ + column, hits, stretches_, sums_, grid);
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
