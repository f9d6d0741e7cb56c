// secondary_task.cpp -- collects, culls and traces reflected rays.

#include "echo/cpu/secondary_task.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/vector_math.h"
#include "echo/model/deposit.h"
#include "echo/model/hit.h"

namespace insonify {
namespace {

// A packet with at least this many of sixteen rays is traced at once.
constexpr int kMany = 12;

// After a packet of which no ray was culled, this many packets of the strip are not tested.
constexpr int kUnculled = 2;

}  // namespace

SecondaryTask::SecondaryTask(const CpuScene& scene) : by_water_(scene), scene_(scene) {
  for (int lane = 0; lane < kPacketSize; ++lane) {
    candidates_.rays.ray.tnear[lane] = reflected_.rays.ray.tnear[lane] = back_.rays.ray.tnear[lane] = kRayClearance;
    candidates_.set_origin(lane, Vec3f::Zero());
    candidates_.set_direction(lane, Vec3f::UnitX());
  }
}

void SecondaryTask::start(const FlatPlan& plan, const PlacedSonar& sonar, EchoGrid& grid, std::vector<Echo>& arrivals,
                          Log* log) {
  plan_ = &plan;
  sonar_ = sonar.position;
  axes_ = sonar.axes;
  refraction_ = sonar.refraction;
  grid_ = &grid;
  arrivals_ = &arrivals;
  log_ = log;
  by_water_.start(plan, sonar_, axes_, refraction_ != nullptr, grid, arrivals, log != nullptr ? &log->back : nullptr);
}

void SecondaryTask::reflect(const HitColumn& strip, int stride, int first_column, int columns) {
  const int rows = strip.rows;
  const float* selected = strip.selected;
  unculled_ = 0;
  for (int row0 = 0; row0 < rows; row0 += kTile) {
    const unsigned in_lattice = (1U << std::min(kTile, rows - row0)) - 1;
    unsigned samples = 0;
    for (int column = 0; column < columns; ++column) {
      samples |= (positive_of_four(&selected[column * stride + row0]) & in_lattice) << (column * kTile);
    }
    for (; samples != 0; samples &= samples - 1) {
      const int sample = std::countr_zero(samples);
      const int column = sample / kTile, row = row0 + sample % kTile;
      const int place = column * stride + row, other = column ^ 1;
      const SurfaceLabel surface = strip.surface[place];
      place_[candidate_count_] = place;
      above_[candidate_count_] = row + 1 < rows && strip.surface[place + 1] == surface ? place + 1
                                 : row > 0 && strip.surface[place - 1] == surface      ? place - 1
                                                                                       : place;
      const int aside = other * stride + row;
      const bool beside = other < columns && plan_->lattice.touches_next(first_column + std::min(column, other));
      aside_[candidate_count_] = beside && strip.surface[aside] == surface ? aside : place;
      candidate_origins_.column[candidate_count_] = first_column + column;
      candidate_origins_.row[candidate_count_] = row;
      if (++candidate_count_ == kPacketSize) {
        cull_and_trace(strip);
      }
    }
  }
  cull_and_trace(strip);
}

// Traces the reflected rays of the candidates, without those that can give no echo:
// 1. Sets up their rays. Those that a facet of a rough mirror reflects into the mirror are dropped.
// 2. With kSelective, drops rays that pass no box of the scene before their echo would be out of range.
// 3. For the rest, computes the changes to neighbouring samples (for the footprint) and the ray tubes.
// 4. Traces the packet if at least kMany rays are left; else adds these to `reflected_`, which is traced when full.
void SecondaryTask::cull_and_trace(const HitColumn& strip) {
  const int count = candidate_count_;
  candidate_count_ = 0;
  Mirrors mirrors;
  EdgeLanes edges = {};
  unsigned lanes = (1U << count) - 1;
  const bool calibrated = plan_->model == EchoModel::kCalibrated;
  aim_reflected(strip, place_, count, sonar_, plan_->reach(), candidates_.rays.ray, candidate_origins_, mirrors);
  if (calibrated) {
    lanes &= turn_to_facets_and_edges(strip, count, mirrors, edges);
  }
  if (plan_->secondary == SecondaryEchoes::kSelective && refraction_ == nullptr && --unculled_ < 0) {
    const unsigned candidates = lanes;
    lanes &= scene_.boxes().may_meet(candidates_.lanes());
    unculled_ = lanes == candidates ? kUnculled : 0;
  }
  if (lanes == 0) {
    return;
  }
  compare_beside(strip, above_, count, candidate_origins_.range, mirrors, candidate_origins_.above);
  compare_beside(strip, aside_, count, candidate_origins_.range, mirrors, candidate_origins_.aside);
  if (calibrated && plan_->max_surfaces > 2) {
    compute_ray_tubes(strip, lanes);
    if (plan_->has_facets() || scene_.any_faces()) {
      project_faces(mirrors, edges, candidates_.rays.ray, candidate_origins_);
    }
  }
  if (std::popcount(lanes) >= kMany) {
    trace(candidates_, candidate_origins_, lanes);
  } else {
    collect(lanes);
  }
}

// `calibrated`: looks up how the candidates reflect, and turns their rays to facets and edges. Returns the lanes of
// rays that leave their mirror.
unsigned SecondaryTask::turn_to_facets_and_edges(const HitColumn& strip, int count, const Mirrors& mirrors,
                                                 EdgeLanes& edges) {
  for (int lane = 0; lane < count; ++lane) {
    const SurfaceLabel surface = strip.surface[place_[lane]];
    const float facing = strip.facing[place_[lane]];
    const float texture = strip.has_relief ? strip.texture[place_[lane]] : 1.0F;
    candidate_origins_.reflectance[lane] = plan_->scatter.mirrored(surface, facing) * texture * texture;
    candidate_origins_.share[lane] = 1;
    candidate_origins_.roughness[lane] = plan_->mirror_roughness(surface);
    candidate_origins_.incidence[lane] = facing;
    candidate_origins_.steepness[lane] = plan_->scatter.steepness(surface);
    candidate_origins_.faces.finite[lane] = 0;
  }
  if (scene_.any_faces()) {
    find_edges(strip, count, edges);
  }
  if (!plan_->has_facets() && !scene_.any_faces()) {
    return ~0U;
  }
  turn_to_facets(strip, place_, count, plan_->reach(), plan_->stagger, mirrors, edges, candidates_.rays.ray,
                 candidate_origins_);
  return positive_of_sixteen(candidate_origins_.share);
}

// Adds candidates to those that are traced together.
void SecondaryTask::collect(unsigned lanes) {
  for (; lanes != 0; lanes &= lanes - 1) {
    const int lane = std::countr_zero(lanes);
    reflected_.set_origin(reflected_count_, candidates_.origin(lane));
    reflected_.set_direction(reflected_count_, candidates_.direction(lane));
    reflected_.rays.ray.tfar[reflected_count_] = candidates_.rays.ray.tfar[lane];
    origins_.copy(reflected_count_, candidate_origins_, lane);
    if (++reflected_count_ == kPacketSize) {
      trace_collected();
    }
  }
}

// Looks up the edges of the faces that the candidates are on.
void SecondaryTask::find_edges(const HitColumn& strip, int count, EdgeLanes& edges) {
  const RTCRay16& rays = candidates_.rays.ray;
  for (int lane = 0; lane < count; ++lane) {
    const int at = place_[lane];
    const FaceEdges face = scene_.face_edges(strip.surface[at], strip.triangle[at],
                                             {rays.org_x[lane], rays.org_y[lane], rays.org_z[lane]});
    set_edges(face, lane, plan_->wavelength(), strip.facing[at], plan_->stagger, edges, candidate_origins_);
  }
}

// Sets the ray tubes of the given candidates.
void SecondaryTask::compute_ray_tubes(const HitColumn& strip, unsigned lanes) {
  for (; lanes != 0; lanes &= lanes - 1) {
    const int lane = std::countr_zero(lanes), at = place_[lane];
    const Vec3f direction(strip.direction_x[at], strip.direction_y[at], strip.direction_z[at]);
    const Vec3f normal(strip.normal_x[at], strip.normal_y[at], strip.normal_z[at]);
    candidate_origins_.tube[lane] =
        scene_.tube(strip.surface[at], strip.triangle[at], direction, normal, strip.range[at]);
  }
}

void SecondaryTask::trace_collected() {
  const unsigned lanes = (1U << reflected_count_) - 1;
  reflected_count_ = 0;
  trace(reflected_, origins_, lanes);
}

// Traces a packet of reflected rays, and sets up the return legs of its hits.
void SecondaryTask::trace(RayPacket& packet, const ReflectedOrigins& origins, unsigned lanes) {
  packet.set_lanes(lanes);
  if (log_ != nullptr) {
    log_->reflected.push_back(packet);
  }
  scene_.intersect(packet, refraction_);
  sent_ += static_cast<std::uint64_t>(std::popcount(lanes));

  scene_.shade(packet.rays.hit, shading_);
  if (scene_.reliefs().any()) {
    scene_.bend_normals(packet.rays, refraction_, shading_);
  }
  if (refraction_ != nullptr) {
    scene_.appear(packet.rays.ray, *refraction_, shading_, nullptr);
  }
  if (plan_->model == EchoModel::kCalibrated) {
    return_mirrored(packet.rays.ray, origins, lanes);
  } else {
    return_shaped(packet.rays.ray, origins, lanes);
  }
}

void SecondaryTask::finish() {
  if (reflected_count_ > 0) {
    trace_collected();
  }
  if (returning_count_ > 0) {
    finish_returns();
  }
  by_water_.finish();
}

}  // namespace insonify
