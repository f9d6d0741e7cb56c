// thickness_gauge.cpp -- rays through bodies and across them.

#include "echo/thin/thickness_gauge.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "base/parallel_blocks.h"

namespace insonify {
namespace {

constexpr int kAcross =
    8;  // Directions across the normal in which the extent is measured; the least is at most 2 % too large.
constexpr int kOthers = 3;          // Most surfaces of other instances that a ray passes.
constexpr std::size_t kTask = 512;  // Triangles of a task.

Ray probe_ray(const Vec3& from, const Vec3& direction, const ThinWall& wall) {
  return {from, direction, wall.clearance(), wall.reach()};
}

}  // namespace

std::span<const double> ThinProbe::distances(std::vector<Ray>& rays) {
  hits_.resize(rays.size());
  distances_.assign(rays.size(), std::numeric_limits<double>::infinity());
  for (int pass = 0; pass <= kOthers && !rays.empty(); ++pass) {
    engine_.trace(rays, hits_);
    bool any = false;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Hit& hit = hits_[i];
      if (!std::isfinite(hit.distance)) {
        continue;
      }
      if (hit.instance == instance_) {
        distances_[i] = hit.distance;
        rays[i].max_distance = 0;
      } else {
        rays[i].min_distance = hit.distance + ThinWall::kLeastClearance;
        any = true;
      }
    }
    if (!any) {
      break;
    }
  }
  return distances_;
}

ThinBody::ThinBody(const ThinWall& wall, double depth, std::size_t first_ray)
    : wall_(&wall), depth_(depth), first_ray_(first_ray), directions_(ThinWall::is_thin(depth) ? kAcross : 2) {}

void ThinBody::aim(std::vector<Ray>& rays) const {
  const Vec3 inside = wall_->middle - 0.5 * depth_ * wall_->normal;
  const Vec3& along_one = directions_ == 2 ? wall_->around : wall_->edge;
  const Vec3 one = (along_one - wall_->normal.dot(along_one) * wall_->normal).normalized();
  const Vec3 two = wall_->normal.cross(one);
  for (int k = 0; k < directions_; ++k) {
    const double angle = std::numbers::pi * k / directions_;
    const Vec3 direction = std::cos(angle) * one + std::sin(angle) * two;
    Ray* const both = &rays[first_ray_ + 2 * static_cast<std::size_t>(k)];
    both[0] = probe_ray(inside, direction, *wall_);
    both[1] = probe_ray(inside, -direction, *wall_);
  }
}

std::pair<double, Vec3> ThinBody::measure(const std::vector<Ray>& rays, std::span<const double> sides) const {
  const auto width = [&](std::size_t ray) { return sides[ray] + sides[ray + 1]; };
  std::size_t narrowest = first_ray_;
  for (std::size_t ray = first_ray_; ray < last_ray(); ray += 2) {
    narrowest = width(ray) < width(narrowest) ? ray : narrowest;
  }
  const double widest = directions_ == 2 ? std::max(width(first_ray_), width(first_ray_ + 2)) : depth_;
  if (depth_ > widest) {  // At the end of a long body.
    return {widest, wall_->normal};
  }
  return {std::max(depth_, width(narrowest)), wall_->normal.cross(rays[narrowest].direction)};
}

void ThicknessGauge::measure(std::span<const std::uint32_t> triangles, bool last, std::vector<ThinTriangle>& thin) {
  find_walls(triangles);
  std::size_t first = 0;
  while (walls_.size() - first >= kTogether || (last && first < walls_.size())) {
    const std::size_t count = std::min(kTogether, walls_.size() - first);
    measure(std::span<const ThinWall>(walls_).subspan(first, count), thin);
    first += count;
  }
  walls_.erase(walls_.begin(), walls_.begin() + static_cast<std::ptrdiff_t>(first));
}

void ThicknessGauge::find_walls(std::span<const std::uint32_t> triangles) {
  found_.resize(triangles.size());
  for_each_block(workers_, triangles.size(), kTask, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      found_[i] = ThinWall::of(instance_, triangles[i]);
    }
  });
  for (const std::optional<ThinWall>& wall : found_) {
    if (wall) {
      walls_.push_back(*wall);
    }
  }
}

void ThicknessGauge::measure(std::span<const ThinWall> walls, std::vector<ThinTriangle>& thin) {
  rays_.clear();
  for (const ThinWall& wall : walls) {
    rays_.push_back(probe_ray(wall.middle, -wall.normal, wall));
  }
  const std::span<const double> depths = through_.distances(rays_);
  bodies_.clear();
  std::size_t cross_rays = 0;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    if (std::isfinite(depths[i]) && walls[i].may_be_thin(depths[i])) {
      bodies_.emplace_back(walls[i], depths[i], cross_rays);
      cross_rays = bodies_.back().last_ray();
    }
  }
  cross_rays_.resize(cross_rays);
  for_each_block(workers_, bodies_.size(), kTask, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      bodies_[i].aim(cross_rays_);
    }
  });
  const std::span<const double> sides = across_.distances(cross_rays_);
  measured_.resize(bodies_.size());
  for_each_block(workers_, bodies_.size(), kTask, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      measured_[i] = thin_at(bodies_[i], sides);
    }
  });
  for (const std::optional<ThinTriangle>& one : measured_) {
    if (one) {
      thin.push_back(*one);
    }
  }
}

std::optional<ThinTriangle> ThicknessGauge::thin_at(const ThinBody& body, std::span<const double> sides) const {
  const auto [thickness, along] = body.measure(cross_rays_, sides);
  if (!(thickness <= body.wall().reach() && body.wall().may_be_thin(thickness))) {
    return {};
  }
  int coordinate = 0;
  (instance_.world_from_mesh.orientation.conjugate() * along).cwiseAbs().maxCoeff(&coordinate);
  return ThinTriangle{body.wall().triangle, static_cast<float>(thickness), coordinate};
}

}  // namespace insonify
