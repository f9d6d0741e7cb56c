// path.cpp -- bends, splines and stations.

#include "kit/path.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kit/curve.h"

namespace {

// The bend at a corner, from where it leaves the first straight to where it meets the second. It takes up no more than
// half of either, so that two bends never overlap.
void append_bend(Path& path, const Vec3& before, const Vec3& corner, const Vec3& after, double radius, int pieces) {
  const Vec3 in = (corner - before).normalized();
  const Vec3 out = (after - corner).normalized();
  const double turn = std::acos(std::clamp(in.dot(out), -1.0, 1.0));
  constexpr double kStraight = 1e-3;  // [rad]
  if (turn < kStraight) {
    path.push_back(corner);
    return;
  }
  const double room = 0.4995 * std::min((corner - before).norm(), (after - corner).norm());
  const double tangent = std::min(radius * std::tan(turn / 2), room);
  radius = tangent / std::tan(turn / 2);
  const Vec3 inwards = (out - in * in.dot(out)).normalized();
  const Vec3 center = corner - tangent * in + radius * inwards;
  for (const double angle : spaced(0, turn, pieces + 1)) {
    path.push_back(center - radius * std::cos(angle) * inwards + radius * std::sin(angle) * in);
  }
}

// Last point at or before a station, never the very last.
std::size_t piece_at(const std::vector<double>& at, double station) {
  const auto after = std::ranges::upper_bound(at, station) - at.begin();
  return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(after - 1, 0, std::ssize(at) - 2));
}

}  // namespace

Path bent(const Path& corners, double radius, int pieces) {
  Path path = {corners.front()};
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    append_bend(path, corners[i - 1], corners[i], corners[i + 1], radius, pieces);
  }
  path.push_back(corners.back());
  return path;
}

Path laid_through(const Path& points, double step) {
  Path path;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Vec3& from = points[i];
    const Vec3& to = points[i + 1];
    const Vec3 before = i > 0 ? points[i - 1] : Vec3(2 * from - to);
    const Vec3 after = i + 2 < points.size() ? points[i + 2] : Vec3(2 * to - from);
    const int count = std::max(1, static_cast<int>(std::lround((to - from).norm() / step)));
    for (int k = 0; k < count; ++k) {
      const double t = static_cast<double>(k) / count;
      const Vec3 bend =
          (2 * before - 5 * from + 4 * to - after) * t * t + (3 * from - before - 3 * to + after) * t * t * t;
      path.emplace_back(from + 0.5 * ((to - before) * t + bend));
    }
  }
  path.push_back(points.back());
  return path;
}

std::vector<double> stations(const Path& path) {
  std::vector<double> at = {0};
  for (std::size_t i = 1; i < path.size(); ++i) {
    at.push_back(at.back() + (path[i] - path[i - 1]).norm());
  }
  return at;
}

Path with_stations(const Path& path, const std::vector<double>& extra) {
  const std::vector<double> own = stations(path);
  std::vector<double> within;
  std::ranges::copy_if(extra, std::back_inserter(within), [&](double s) { return s > 0 && s < own.back(); });
  Path result;
  for (const double station : merged(own, within)) {
    result.push_back(point_at(path, station));
  }
  return result;
}

Vec3 point_at(const Path& path, double station) {
  const std::vector<double> at = stations(path);
  const std::size_t i = piece_at(at, station);
  const double t = std::clamp((station - at[i]) / (at[i + 1] - at[i]), 0.0, 1.0);
  return path[i] + t * (path[i + 1] - path[i]);
}

Pose frame_at(const Path& path, double station) {
  const std::size_t i = piece_at(stations(path), station);
  return towards(point_at(path, station), path[i + 1] - path[i]);
}

Pose towards(const Vec3& position, const Vec3& direction) {
  const Vec3 z = direction.normalized();
  const Vec3 up = std::abs(z.z()) < 0.99 ? Vec3::UnitZ() : Vec3::UnitX();
  const Vec3 x = (up - up.dot(z) * z).normalized();
  Eigen::Matrix3d turn;
  turn << x, z.cross(x), z;
  return {position, Eigen::Quaterniond(turn)};
}

double distance_in_plan(const Path& path, double x, double y) {
  double nearest = std::numeric_limits<double>::infinity();
  const Eigen::Vector2d place(x, y);
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const Eigen::Vector2d from = path[i].head<2>();
    const Eigen::Vector2d piece = path[i + 1].head<2>() - from;
    const double t = std::clamp((place - from).dot(piece) / piece.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (place - from - t * piece).norm());
  }
  return nearest;
}
