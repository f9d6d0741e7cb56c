// beam_task.cpp -- out, straight back, on to a second surface, and back from there.

#include "echo/beam_task.h"

#include <algorithm>
#include <cmath>

#include "echo/paper_echoes.h"
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
  const std::size_t samples = static_cast<std::size_t>(columns) * plan.lattice.rows;
  along_.resize(std::max<std::size_t>(along_.size(), columns));
  for (auto* values : {&range_, &normal_x_, &normal_y_, &normal_z_, &normal_along_, &normal_across_, &normal_up_,
                       &facing_, &reach_, &power_}) {
    values->resize(std::max(values->size(), samples));
  }
  surface_.resize(std::max(surface_.size(), samples));
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
        const int sample = at(column + lane / kTile, row + lane % kTile);
        const RTCHit16& hit = primary_.rays.hit;
        if (!primary_.hit(lane)) {
          range_[sample] = 0;
          normal_x_[sample] = normal_y_[sample] = normal_z_[sample] = 1;
          surface_[sample] = kNoSurface;
          continue;
        }
        const CpuScene::Shading shading =
            scene_.shade(hit.geomID[lane], hit.instID[0][lane], hit.primID[lane], hit.u[lane], hit.v[lane]);
        range_[sample] = primary_.rays.ray.tfar[lane];
        normal_x_[sample] = shading.normal.x();
        normal_y_[sample] = shading.normal.y();
        normal_z_[sample] = shading.normal.z();
        surface_[sample] = shading.surface;
      }
    }
  }
}

// The hits of a column, their normals made unit and turned into the column's own axes.
HitColumn BeamTask::column_hits(int column) {
  const int rows = plan_->lattice.rows;
  const int start = at(column, 0);
  float* const x = &normal_x_[start];
  float* const y = &normal_y_[start];
  float* const z = &normal_z_[start];
  float* const along = &normal_along_[start];
  float* const across = &normal_across_[start];
  float* const up = &normal_up_[start];
  const Vec3f to = along_[column];
  const Vec3f side = up_.cross(to);
  const Vec3f up_axis = up_;
  for (int row = 0; row < rows; ++row) {
    const float scale = 1 / std::sqrt(x[row] * x[row] + y[row] * y[row] + z[row] * z[row] + 1e-20F);
    x[row] *= scale;
    y[row] *= scale;
    z[row] *= scale;
    along[row] = x[row] * to.x() + y[row] * to.y() + z[row] * to.z();
    across[row] = x[row] * side.x() + y[row] * side.y() + z[row] * side.z();
    up[row] = x[row] * up_axis.x() + y[row] * up_axis.y() + z[row] * up_axis.z();
  }
  return {rows, &range_[start], &surface_[start], along, across, up, &facing_[start], &reach_[start], &power_[start]};
}

// Follows the selected hits, in the order of the tiles so that packets stay together.
void BeamTask::send_onward(EchoGrid& grid, Log* log) {
  const Lattice& lattice = plan_->lattice;
  int count = 0;
  for (int column0 = 0; column0 < columns_; column0 += kTile) {
    for (int row0 = 0; row0 < lattice.rows; row0 += kTile) {
      for (int lane = 0; lane < kPacketSize; ++lane) {
        const int column = column0 + lane / kTile;
        const int row = row0 + lane % kTile;
        if (column >= columns_ || row >= lattice.rows) {
          continue;
        }
        const int sample = at(column, row);
        if (surface_[sample] == kNoSurface) {
          continue;
        }
        const int lattice_column = first_column_ + column;
        const float cos_el = lattice.cos_elevations(lattice_column)[row];
        const float sin_el = lattice.sin_elevations(lattice_column)[row];
        const float facing = facing_[sample];
        const float onward = onward_strength(*plan_, std::abs(facing),
                                             scene_.reflectivity()[material_of(surface_[sample])], range_[sample]);
        const float selected = selection_weight(*plan_, lattice_column, row, onward);
        if (selected == 0) {
          continue;
        }
        const Vec3f direction = along_[column] * cos_el + up_ * sin_el;
        const Vec3f normal(normal_x_[sample], normal_y_[sample], normal_z_[sample]);
        onward_.set_origin(count, sonar_ + direction * range_[sample]);
        onward_.set_direction(count, direction - 2 * facing * normal);
        origins_[count] = {lattice_column, row, onward, range_[sample],
                           selected * sample_weight(lattice, lattice_column, row)};
        if (++count == kPacketSize) {
          finish_onward(count, grid, log);
          count = 0;
        }
      }
    }
  }
  if (count > 0) {
    finish_onward(count, grid, log);
  }
}

// Traces a packet of onward rays and the return legs from what they meet, and deposits the echoes that arrive.
void BeamTask::finish_onward(int count, EchoGrid& grid, Log* log) {
  onward_.set_count(count);
  if (log != nullptr) {
    log->onward.push_back(onward_);
  }
  onward_.intersect(scene_.handle(), plan_->true_max_range);
  counts_.secondary += count;

  Echo echoes[kPacketSize];
  int returning = 0;
  for (int lane = 0; lane < count; ++lane) {
    if (!onward_.hit(lane)) {
      continue;
    }
    const Origin& origin = origins_[lane];
    const float across = onward_.rays.ray.tfar[lane];
    const Vec3f point = onward_.origin(lane) + onward_.direction(lane) * across;
    const Vec3f back = sonar_ - point;
    const float distance = back.norm();
    const float path_length = origin.range + across + distance;
    if (0.5F * path_length >= plan_->true_max_range) {
      continue;
    }
    const RTCHit16& hit = onward_.rays.hit;
    const CpuScene::Shading shading =
        scene_.shade(hit.geomID[lane], hit.instID[0][lane], hit.primID[lane], hit.u[lane], hit.v[lane]);
    const float incidence = std::abs(shading.normal.dot(onward_.direction(lane))) / shading.normal.norm();
    back_.set_origin(returning, point);
    back_.set_direction(returning, back / distance);
    back_.rays.ray.tfar[returning] = distance - kRayClearance;
    echoes[returning] = {
        .azimuth = plan_->lattice.azimuth[origin.column],
        .elevation = plan_->lattice.elevations(origin.column)[origin.row],
        .path_length = path_length,
        .power = secondary_power(*plan_, origin.onward, incidence, scene_.reflectivity()[material_of(shading.surface)],
                                 origin.range, path_length),
        .weight = origin.weight,
        .order = 2,
        .surface = shading.surface};
    ++returning;
  }
  if (returning == 0) {
    return;
  }
  counts_.return_legs += returning;
  back_.set_count(returning);
  if (log != nullptr) {
    log->back.push_back(back_);
  }
  back_.occlude(scene_.handle());
  for (int lane = 0; lane < returning; ++lane) {
    if (!back_.blocked(lane)) {
      deposit(*plan_, echoes[lane], grid);
    }
  }
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
    HitColumn hits = column_hits(column);
    measure_column(*plan_, first_column_ + column, hits);
    shade_column(*plan_, scene_.reflectivity(), hits);
    deposit_column(*plan_, first_column_ + column, hits, grid);
  }
  if (plan_->secondary != SecondaryEchoes::kNone) {
    send_onward(grid, log);
  }
}

}  // namespace insonify
