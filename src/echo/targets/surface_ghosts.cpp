// surface_ghosts.cpp -- traces three rays per point, and adds up to three echoes.

#include "echo/targets/surface_ghosts.h"

#include <cmath>
#include <optional>

#include "base/philox.h"
#include "echo/model/ray_limits.h"
#include "echo/targets/point_echoes.h"

namespace insonify {
namespace {

Ray ray_between(const Vec3& from, const Vec3& to) {
  const Vec3 there = to - from;
  const double length = there.norm();
  const double clearance = double{kRayClearance};
  return {from, length > 0 ? Vec3(there / length) : Vec3(Vec3::UnitX()), clearance, length - clearance};
}

// How sound from a place in the sonar frame arrives; none if it is not received.
std::optional<PingPlan::Arrival> arrival_of(const PingPlan& plan, const Vec3& place) {
  const Vec3f direction = place.normalized().cast<float>();
  return plan.receives(direction) ? std::optional(plan.arrival_from(direction)) : std::nullopt;
}

}  // namespace

SurfaceGhosts::SurfaceGhosts(std::span<const PointTarget> points, const Surface& surface)
    : points_(points), surface_(surface), rays_(kRaysPerPoint * points.size()), hits_(rays_.size()) {}

void SurfaceGhosts::trace(const Vec3& sonar, Engine& engine) {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Vec3& point = points_[i].position;
    const double depth = surface_.level - sonar.z(), point_depth = surface_.level - point.z();
    const double share = depth + point_depth > 0 ? depth / (depth + point_depth) : 0.5;
    Vec3 bounce = sonar + share * (point - sonar);
    bounce.z() = surface_.level;
    rays_[kRaysPerPoint * i] = ray_between(sonar, point);
    rays_[kRaysPerPoint * i + 1] = ray_between(sonar, bounce);
    rays_[kRaysPerPoint * i + 2] = ray_between(bounce, point);
  }
  engine.trace(rays_, hits_);
}

SurfaceGhosts::Glint SurfaceGhosts::glint(const PingPlan& plan, std::size_t point, int order,
                                          std::uint64_t number) const {
  if (!glints_) {
    return {1, 0};
  }
  const PhiloxCounter counter = {
      static_cast<std::uint32_t>(point), static_cast<std::uint32_t>(number), static_cast<std::uint32_t>(number >> 32),
      static_cast<std::uint32_t>(RandomPurpose::kWaves) + (static_cast<std::uint32_t>(order) << 8)};
  const PhiloxCounter words = philox(counter, philox_key(plan.seed));
  return {-std::log(double{uniform_open(words[0])}), double{uniform_open(words[1])}};
}

void SurfaceGhosts::add(const PingPlan& plan, const Pose& world_from_sonar, std::uint64_t number, bool phases,
                        Engine& engine, EchoGrid& grid) {
  glints_ = surface_.waves && phases;
  if (plan.secondary == SecondaryEchoes::kNone || plan.max_surfaces < 2 || points_.empty() ||
      world_from_sonar.position.z() >= surface_.level) {
    return;
  }
  trace(world_from_sonar.position, engine);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (points_[i].position.z() < surface_.level) {
      add_point(plan, world_from_sonar, i, number, grid);
    }
  }
}

void SurfaceGhosts::add_point(const PingPlan& plan, const Pose& world_from_sonar, std::size_t point,
                              std::uint64_t number, EchoGrid& grid) const {
  const auto clear = [&](std::size_t ray) { return !std::isfinite(hits_[kRaysPerPoint * point + ray].distance); };
  if (!clear(1) || !clear(2)) {
    return;
  }
  const Vec3& place = points_[point].position;
  const Vec3 image(place.x(), place.y(), 2 * surface_.level - place.z());
  const Pose sonar_from_world = world_from_sonar.inverse();
  const Vec3 straight = sonar_from_world * place, mirrored = sonar_from_world * image;
  const std::optional<PingPlan::Arrival> by_surface = arrival_of(plan, mirrored);
  if (!by_surface) {
    return;
  }
  const double near = straight.norm(), far = mirrored.norm();
  const double strength = std::pow(10.0, points_[point].target_strength_db / 10);
  const double rise = surface_.level - world_from_sonar.position.z() + surface_.level - place.z();
  const double reflectance = plan.scatter.scattering(surface_.label).reflectance(rise / far),
               absorption = 2 * double{plan.neper_per_metre};
  const double own_turns = own_phase(plan, point);
  const std::optional<PingPlan::Arrival> direct = arrival_of(plan, straight);
  if (clear(0) && direct) {
    const Glint waves = glint(plan, point, 2, number);
    const double intensity = waves.intensity * strength * reflectance / std::pow(near * far, 2) *
                             std::exp(-absorption * (near + far)) * double{direct->pattern} *
                             double{by_surface->pattern};
    const double range = 0.5 * (near + far);
    const double turns = plan.turns_per_metre * range + own_turns + 0.5 + waves.turns;
    add_discrete_echo(plan, *direct, 2, range, intensity * double{by_surface->transmitted}, turns, grid);
    add_discrete_echo(plan, *by_surface, 2, range, intensity * double{direct->transmitted}, turns, grid);
  }
  if (plan.max_surfaces > 2) {
    const Glint waves = glint(plan, point, 3, number);
    const double intensity = waves.intensity * strength * reflectance * reflectance / std::pow(far, 4) *
                             std::exp(-2 * absorption * far) * std::pow(double{by_surface->pattern}, 2) *
                             double{by_surface->transmitted};
    const double turns = plan.turns_per_metre * far + own_turns + 1 + waves.turns;
    add_discrete_echo(plan, *by_surface, 3, far, intensity, turns, grid);
  }
}

}  // namespace insonify
