// point_echoes.cpp -- seen, weakened by spreading and absorption, and deposited.

#include "echo/point_echoes.h"

#include <cmath>

#include "echo/deposit.h"
#include "echo/ray_limits.h"

namespace insonify {

PointEchoes::PointEchoes(std::span<const PointTarget> points)
    : points_(points), rays_(points.size()), hits_(points.size()) {}

void PointEchoes::add(const PingPlan& plan, const Pose& world_from_sonar, Engine& engine, EchoGrid& grid) {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Vec3 there = points_[i].position - world_from_sonar.position;
    const double range = there.norm();
    rays_[i] = {world_from_sonar.position, range > 0 ? Vec3(there / range) : Vec3(Vec3::UnitX()), 0,
                range - double{kRayClearance}};
  }
  engine.trace(rays_, hits_);
  const Pose sonar_from_world = world_from_sonar.inverse();
  const double highest = 0.5 * plan.sonar.elevation_aperture;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Vec3 local = sonar_from_world * points_[i].position;
    const double range = local.norm();
    const double elevation = std::atan2(local.z(), std::hypot(local.x(), local.y()));
    const bool hidden = std::isfinite(hits_[i].distance);
    if (range == 0 || hidden || std::abs(elevation - plan.sonar.elevation_center) > highest) {
      continue;
    }
    const double intensity = std::pow(10.0, points_[i].target_strength_db / 10) / std::pow(range, 4) *
                             std::exp(-4 * double{plan.neper_per_metre} * range);
    Echo echo;
    echo.azimuth = static_cast<float>(std::atan2(local.y(), local.x()));
    echo.elevation = static_cast<float>(elevation);
    echo.path_length = static_cast<float>(2 * range);
    echo.power = static_cast<float>(intensity);
    echo.weight = 1;
    deposit(plan, echo, grid);
  }
}

}  // namespace insonify
