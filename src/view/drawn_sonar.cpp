// drawn_sonar.cpp -- intersection of a ray with a capped cylinder; corners and edges of a sector.

#include "view/drawn_sonar.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "image/canvas.h"

namespace insonify {
namespace {

constexpr double kPieceAngle = radians_from_degrees(1);
constexpr int kPiecesAlong = 64;  // Segments of a straight edge; each is drawn or hidden as a whole.

}  // namespace

Housing::Housing(const SonarConfig& sonar, const Pose& world_from_sonar, double radius) : radius_(radius) {
  const bool scans = sonar.scans();
  world_from_housing_ = world_from_sonar;
  if (!scans) {  // Turns z onto the acoustic axis.
    world_from_housing_.orientation =
        world_from_sonar.orientation * Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitY());
  }
  housing_from_world_ = world_from_housing_.inverse();
  low_ = scans ? -2.4 * radius : -2.8 * radius;
  high_ = scans ? 0.8 * radius : 0;
  band_ = scans ? -0.5 * radius : -0.6 * radius;
}

Housing::Cut Housing::cut(const Ray& ray) const {
  const Vec3 origin = housing_from_world_ * ray.origin;
  const Vec3 along = housing_from_world_.orientation * ray.direction;
  Cut nearest{.distance = std::numeric_limits<double>::infinity()};
  const auto consider = [&](double distance, const Vec3& normal, double z) {
    if (distance > ray.min_distance && distance < nearest.distance) {
      nearest = {distance, world_from_housing_.orientation * normal, z > band_};
    }
  };
  for (const double cap : {low_, high_}) {
    const double distance = (cap - origin.z()) / along.z();
    const Vec3 point = origin + distance * along;
    if (along.z() != 0 && std::hypot(point.x(), point.y()) <= radius_) {
      consider(distance, Vec3(0, 0, cap == high_ ? 1 : -1), cap);
    }
  }
  const double a = along.head<2>().squaredNorm();
  const double b = origin.head<2>().dot(along.head<2>());
  const double c = origin.head<2>().squaredNorm() - radius_ * radius_;
  if (a > 0 && b * b >= a * c) {
    const double distance = (-b - std::sqrt(b * b - a * c)) / a;
    const Vec3 point = origin + distance * along;
    if (point.z() >= low_ && point.z() <= high_) {
      consider(distance, Vec3(point.x(), point.y(), 0) / radius_, point.z());
    }
  }
  return nearest;
}

InsonifiedSector::InsonifiedSector(const SonarConfig& sonar, const Pose& world_from_sonar)
    : world_from_sonar_(world_from_sonar), min_range_(sonar.min_range), max_range_(sonar.max_range) {
  const double half = std::min(sonar.elevation_aperture, sonar.sent_elevation_aperture()) / 2;
  low_elevation_ = sonar.elevation_center - half;
  high_elevation_ = sonar.elevation_center + half;
  for (int i = 0; i < sonar.aperture_count(); ++i) {
    world_from_apertures_.push_back(world_from_sonar * sonar.housing_from_aperture(i));
  }
  const BearingGrid beams = sonar.aperture(0).bearings();
  low_azimuth_ = beams.starboard.back();
  high_azimuth_ = beams.port.front();
  if (sonar.scans()) {
    low_azimuth_ += sonar.head.sector_center - sonar.head.sector_width / 2;
    high_azimuth_ += sonar.head.sector_center + sonar.head.sector_width / 2;
  }
  full_circle_ = high_azimuth_ - low_azimuth_ > kTwoPi - 1e-6;
  if (full_circle_) {
    high_azimuth_ = low_azimuth_ + kTwoPi;
  }
}

Vec3 InsonifiedSector::point_at(double range, double across, double along) const {
  const std::size_t count = world_from_apertures_.size();
  const double place = across * static_cast<double>(count);
  const std::size_t from_starboard = std::min(count - 1, static_cast<std::size_t>(place));
  return point_of(count - 1 - from_starboard, range, place - static_cast<double>(from_starboard), along);
}

Vec3 InsonifiedSector::point_of(std::size_t aperture, double range, double across, double along) const {
  return world_from_apertures_[aperture] *
         point_from_spherical({range, low_azimuth_ + across * (high_azimuth_ - low_azimuth_),
                               low_elevation_ + along * (high_elevation_ - low_elevation_)});
}

double InsonifiedSector::inside_by(const Vec3& point) const {
  double inside = inside_of(0, point);
  for (std::size_t aperture = 1; aperture < world_from_apertures_.size(); ++aperture) {
    inside = std::max(inside, inside_of(aperture, point));
  }
  return inside;
}

double InsonifiedSector::inside_of(std::size_t aperture, const Vec3& point) const {
  const Pose& frame = world_from_apertures_[aperture];
  const Spherical place = spherical_from_point(frame.orientation.conjugate() * (point - frame.position));
  if (place.range < min_range_ || place.range > max_range_) {
    return -1;
  }
  const double in_elevation = std::min(place.elevation - low_elevation_, high_elevation_ - place.elevation);
  if (full_circle_) {
    return in_elevation;
  }
  const double middle = (low_azimuth_ + high_azimuth_) / 2;
  const double off = std::abs(std::remainder(place.azimuth - middle, kTwoPi));
  return std::min(in_elevation, (high_azimuth_ - low_azimuth_) / 2 - off);
}

std::vector<std::pair<Vec3, Vec3>> InsonifiedSector::edges() const {
  std::vector<std::pair<Vec3, Vec3>> pieces;
  // Calls place(share) along a line and joins the points.
  const auto add_line = [&](int count, const auto& place) {
    for (int i = 0; i < count; ++i) {
      pieces.emplace_back(place(i * 1.0 / count), place((i + 1.0) / count));
    }
  };
  const int around = std::max(8, static_cast<int>(std::ceil((high_azimuth_ - low_azimuth_) / kPieceAngle)));
  for (std::size_t aperture = 0; aperture < world_from_apertures_.size(); ++aperture) {
    const auto point = [&](double range, double across, double along) {
      return point_of(aperture, range, across, along);
    };
    for (const double along : {0.0, 1.0}) {
      add_line(around, [&](double share) { return point(max_range_, share, along); });
      if (!full_circle_) {
        add_line(kPiecesAlong, [&](double share) { return point(share * max_range_, 0, along); });
        add_line(kPiecesAlong, [&](double share) { return point(share * max_range_, 1, along); });
      }
    }
    if (!full_circle_) {
      for (const double across : {0.0, 1.0}) {
        add_line(16, [&](double share) { return point(max_range_, across, share); });
      }
    }
  }
  return pieces;
}

}  // namespace insonify
