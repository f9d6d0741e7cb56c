// secondary_returns.cpp -- from the hits of reflected rays to return legs and echoes.

#include <bit>
#include <cmath>

#include "base/vector_math.h"
#include "echo/cpu/secondary_task.h"
#include "echo/mirror/double_passage.h"
#include "echo/model/deposit.h"
#include "echo/model/hit.h"

namespace insonify {
namespace {

static_assert(kPathLanes == kPacketSize);

constexpr float kTiny = 1e-20F;  // Added to divisors that may be zero.

// The hits of a packet of reflected rays, and the straight paths from there to the sonar.
struct Returns {
  float x[kPacketSize], y[kPacketSize], z[kPacketSize];                 // Second surface.
  float back_x[kPacketSize], back_y[kPacketSize], back_z[kPacketSize];  // Unit vector from there to the sonar.
  float distance[kPacketSize];                                          // Length of the straight path [m].
  float there[kPacketSize];                                             // Length out and across [m].
  float once[kPacketSize], twice[kPacketSize];                          // See PathFootprint.

  [[nodiscard]] Vec3f point(int lane) const { return {x[lane], y[lane], z[lane]}; }
  [[nodiscard]] Vec3f back(int lane) const { return {back_x[lane], back_y[lane], back_z[lane]}; }
};

INSONIFY_VECTOR_CLONES
void measure_returns(const RTCRay16& __restrict__ rays, const ReflectedOrigins& __restrict__ origins, Vec3f sonar,
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
    returns.there[lane] = origins.range[lane] + across;
  }
}

INSONIFY_VECTOR_CLONES
void measure_footprints(const RTCRay16& __restrict__ rays, const CpuScene::Shading& __restrict__ met,
                        const ReflectedOrigins& __restrict__ origins, Returns& __restrict__ returns) {
  for (int lane = 0; lane < kPacketSize; ++lane) {
    const Triple normal{met.normal_x[lane], met.normal_y[lane], met.normal_z[lane]};
    const float length = 1 / std::sqrt(dot(normal, normal) + kTiny);
    const PathEnd end{rays.tfar[lane],     {rays.dir_x[lane], rays.dir_y[lane], rays.dir_z[lane]},
                      length * normal,     {-returns.back_x[lane], -returns.back_y[lane], -returns.back_z[lane]},
                      returns.there[lane], returns.distance[lane]};
    const PathFootprint footprint =
        path_footprint(origins.above.at(lane), origins.selected[lane], origins.aside.at(lane), end);
    returns.once[lane] = footprint.once;
    returns.twice[lane] = footprint.twice;
  }
}

// Strengths in the `paper` model, see secondary_powers(); and 1 where the echo is within the range, else 0.
INSONIFY_VECTOR_CLONES
void weigh_returns(const RTCRay16& __restrict__ rays, const CpuScene::Shading& __restrict__ met,
                   const ReflectedOrigins& __restrict__ origins, const Returns& __restrict__ returns, float max_range,
                   float* __restrict__ strength, float* __restrict__ within) {
  for (int lane = 0; lane < kPacketSize; ++lane) {
    const float path_length = returns.there[lane] + returns.distance[lane];
    within[lane] = (met.surface[lane] != kNoSurface) & (0.5F * path_length < max_range) ? 1.0F : 0.0F;
    const float nx = met.normal_x[lane], ny = met.normal_y[lane], nz = met.normal_z[lane];
    const float facing = nx * rays.dir_x[lane] + ny * rays.dir_y[lane] + nz * rays.dir_z[lane];
    const float incidence = std::abs(facing) / std::sqrt(nx * nx + ny * ny + nz * nz);
    strength[lane] = origins.strength[lane] * incidence * met.reflectivity[lane];
  }
}

// Fills in the arguments of fill_mirror_powers().
INSONIFY_VECTOR_CLONES
void fill_paths(const RTCRay16& __restrict__ rays, const CpuScene::Shading& __restrict__ met,
                const ReflectedOrigins& __restrict__ origins, const Returns& __restrict__ returns, float wavelength,
                MirrorPaths& __restrict__ paths) {
  for (int lane = 0; lane < kPacketSize; ++lane) {
    const SecondAngles angles = second_angles({met.normal_x[lane], met.normal_y[lane], met.normal_z[lane]},
                                              {-rays.dir_x[lane], -rays.dir_y[lane], -rays.dir_z[lane]},
                                              {returns.back_x[lane], returns.back_y[lane], returns.back_z[lane]});
    paths.arriving[lane] = angles.arriving;
    paths.leaving[lane] = angles.leaving;
    paths.between[lane] = angles.between;
    paths.facet[lane] = angles.facet;
    paths.reflectance[lane] = origins.reflectance[lane];
    paths.share[lane] = origins.share[lane];
    paths.steepness[lane] = origins.steepness[lane];
    paths.there[lane] = returns.there[lane];
    const float across = rays.tfar[lane];
    paths.spread[lane] = tube_spread(origins.tube[lane], across, returns.there[lane]);
    const float rho = origins.range[lane] * across / returns.there[lane];
    const float returned = face_return(origins.faces.side(0, lane), origins.faces.side(1, lane),
                                       origins.faces.coherence[lane], rho, wavelength);
    paths.returned[lane] = origins.faces.finite[lane] > 0 ? returned : 1.0F;
    paths.glint[lane] = angles.arriving;
    paths.variance[lane] = 0;
    paths.coherence[lane] = 1;
    paths.back[lane] = returns.distance[lane];
    paths.texture[lane] = met.texture[lane];
    paths.surface[lane] = met.surface[lane];
  }
}

// The same where mirrors have facets.
INSONIFY_VECTOR_CLONES
void fill_facet_returns(const RTCRay16& __restrict__ rays, const CpuScene::Shading& __restrict__ met,
                        const ReflectedOrigins& __restrict__ origins, MirrorPaths& __restrict__ paths) {
  for (int lane = 0; lane < kPacketSize; ++lane) {
    const float out = origins.range[lane], across = rays.tfar[lane];
    const float held =
        held_on_face(origins.faces.side(0, lane), origins.faces.side(1, lane), out * across / (out + across));
    const RoughMirror mirror{slope_of(origins.steepness[lane]),
                             origins.faces.coherence[lane],
                             origins.incidence[lane],
                             out,
                             across,
                             origins.faces.finite[lane] > 0 ? held : 1.0F};
    const Triple normal{met.normal_x[lane], met.normal_y[lane], met.normal_z[lane]};
    const FacetReturn back = facet_return(mirror, {rays.dir_x[lane], rays.dir_y[lane], rays.dir_z[lane]},
                                          {origins.smooth_x[lane], origins.smooth_y[lane], origins.smooth_z[lane]},
                                          1 / std::sqrt(dot(normal, normal) + kTiny) * normal);
    paths.glint[lane] = back.glint;
    paths.variance[lane] = back.variance;
    paths.coherence[lane] = back.coherence;
  }
}

}  // namespace

void SecondaryTask::send_back(const Vec3f& point, const Vec3f& direction, float distance) {
  back_.set_origin(returning_count_, point);
  back_.set_direction(returning_count_, direction);
  back_.rays.ray.tfar[returning_count_] = distance - kRayClearance;
  if (++returning_count_ == kPacketSize) {
    finish_returns();
  }
}

// `paper`: one echo, in the beam of the launched ray.
void SecondaryTask::return_shaped(const RTCRay16& rays, const ReflectedOrigins& origins, unsigned lanes) {
  Returns returns;
  float strength[kPacketSize], within[kPacketSize];
  measure_returns(rays, origins, sonar_, returns);
  measure_footprints(rays, shading_, origins, returns);
  weigh_returns(rays, shading_, origins, returns, plan_->reach(), strength, within);
  for (lanes &= positive_of_sixteen(within); lanes != 0; lanes &= lanes - 1) {
    const int lane = std::countr_zero(lanes);
    const float path_length = returns.there[lane] + returns.distance[lane];
    returning_[returning_count_] = secondary_echo(*plan_, origins.column[lane], origins.row[lane],
                                                  origins.selected[lane], path_length, shading_.surface[lane]);
    returning_[returning_count_].half_length = returns.once[lane];
    returning_strength_[returning_count_] = strength[lane];
    returning_rest_[returning_count_] = path_length - 2 * origins.range[lane];
    send_back(returns.point(lane), returns.back(lane), returns.distance[lane]);
  }
}

// double_passage() of the path of one lane.
float SecondaryTask::interference(const RTCRay16& rays, const ReflectedOrigins& origins, const MirrorPaths& paths,
                                  int lane) const {
  if (!(paths.variance[lane] > 0)) {
    return 1;
  }
  const auto seen = [&](const Vec3f& direction) { return triple_of(axes_.transpose() * direction); };
  const Vec3f mirror(rays.org_x[lane], rays.org_y[lane], rays.org_z[lane]);
  return double_passage(*plan_, origins.column[lane],
                        {.to_mirror = seen((mirror - sonar_).normalized()),
                         .specular = seen({origins.smooth_x[lane], origins.smooth_y[lane], origins.smooth_z[lane]}),
                         .on = seen({rays.dir_x[lane], rays.dir_y[lane], rays.dir_z[lane]}),
                         .range = origins.range[lane],
                         .across = rays.tfar[lane],
                         .over = {paths.glint[lane], paths.variance[lane], paths.coherence[lane]}});
}

// `calibrated`: deposits the echo by the mirror both ways at once. The two reciprocal echoes by the mirror one way wait
// until finish_returns() knows that the straight path back is unobstructed.
void SecondaryTask::return_mirrored(const RTCRay16& rays, const ReflectedOrigins& origins, unsigned lanes) {
  Returns returns;
  MirrorPaths paths;
  MirrorPowers powers;
  measure_returns(rays, origins, sonar_, returns);
  measure_footprints(rays, shading_, origins, returns);
  fill_paths(rays, shading_, origins, returns, plan_->wavelength(), paths);
  if (plan_->has_facets() && plan_->max_surfaces > 2) {
    fill_facet_returns(rays, shading_, origins, paths);
  }
  fill_mirror_powers(plan_->scatter, plan_->neper_per_metre, paths, powers);
  for (; lanes != 0; lanes &= lanes - 1) {
    const int lane = std::countr_zero(lanes);
    if (paths.surface[lane] == kNoSurface) {
      continue;
    }
    const float there = paths.there[lane], back = paths.back[lane];
    Echo echo = secondary_echo(*plan_, origins.column[lane], origins.row[lane], origins.selected[lane], there + back,
                               paths.surface[lane]);
    if (plan_->max_surfaces > 2 && there < plan_->reach()) {
      Echo twice = echo;
      twice.order = 3;
      twice.path_length = 2 * there;
      twice.half_length = returns.twice[lane];
      twice.power = powers.twice[lane] * interference(rays, origins, paths, lane) *
                    plan_->lattice.pattern_in(origins.column[lane])[origins.row[lane]];
      deposit(*plan_, twice, *grid_);
    }
    if (by_water_.any()) {
      return_by_water(rays, origins, lane, echo);
    }
    const Vec3f arrival_direction = -(axes_.transpose() * returns.back(lane));
    if (powers.once[lane] > 0 && 0.5F * (there + back) < plan_->reach() && plan_->receives(arrival_direction)) {
      echo.half_length = returns.once[lane];
      const ReciprocalEchoes echoes = reciprocal_echoes(*plan_, origins.column[lane], origins.row[lane], echo,
                                                        powers.once[lane], plan_->arrival_from(arrival_direction));
      returning_[returning_count_] = echoes.launched;
      arriving_[returning_count_] = echoes.arriving;
      send_back(returns.point(lane), returns.back(lane), back);
    }
  }
}

// `calibrated`: out by the mirror and back by the water's surface, and the reciprocal path.
void SecondaryTask::return_by_water(const RTCRay16& rays, const ReflectedOrigins& origins, int lane, const Echo& echo) {
  const Vec3f mirror(rays.org_x[lane], rays.org_y[lane], rays.org_z[lane]),
      direction(rays.dir_x[lane], rays.dir_y[lane], rays.dir_z[lane]);
  by_water_.connect({.mirror = mirror,
                     .point = mirror + rays.tfar[lane] * direction,
                     .normal = shading_.normal(lane),
                     .direction = direction,
                     .surface = shading_.surface[lane],
                     .texture = shading_.texture[lane],
                     .reflected = origins.share[lane] * origins.reflectance[lane],
                     .range = origins.range[lane],
                     .above = origins.above.at(lane),
                     .aside = origins.aside.at(lane),
                     .selected = origins.selected[lane]},
                    origins.column[lane], origins.row[lane], echo);
}

// Traces the return legs and deposits the echoes of those that are unobstructed.
void SecondaryTask::finish_returns() {
  back_.set_count(returning_count_);
  if (log_ != nullptr) {
    log_->back.push_back(back_);
  }
  scene_.occlude(back_, refraction_);
  returned_ += returning_count_;
  const bool calibrated = plan_->model == EchoModel::kCalibrated;
  float power[kPacketSize];
  if (!calibrated) {
    secondary_powers(*plan_, returning_count_, returning_strength_, returning_rest_, power);
  }
  for (int lane = 0; lane < returning_count_; ++lane) {
    if (back_.blocked(lane)) {
      continue;
    }
    if (calibrated) {
      arrivals_->push_back(arriving_[lane]);
    } else {
      returning_[lane].power = power[lane];
    }
    deposit(*plan_, returning_[lane], *grid_);
  }
  returning_count_ = 0;
}

}  // namespace insonify
