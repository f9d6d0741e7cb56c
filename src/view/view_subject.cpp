// view_subject.cpp -- traces a few hundred rays through the sector and finds the extreme points of the objects they
// hit.

#include "view/view_subject.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

namespace insonify {
namespace {

constexpr double kLargestWhole =
    1.5;  // Largest size of an object that is shown whole, relative to its distance from the sonar.

// Traces a coarse grid of rays through the sector.
std::vector<SeenPoint> look_around(Engine& engine, const InsonifiedSector& sector) {
  constexpr int kAcross = 48, kAlong = 12;
  const Vec3& sonar = sector.world_from_sonar().position;
  std::vector<Ray> rays;
  for (int i = 0; i < kAcross; ++i) {
    for (int j = 0; j < kAlong; ++j) {
      const Vec3 far = sector.point_at(sector.max_range(), (i + 0.5) / kAcross, (j + 0.5) / kAlong);
      rays.push_back({sonar, (far - sonar).normalized(), 0, sector.max_range()});
    }
  }
  std::vector<Hit> hits(rays.size());
  engine.trace(rays, hits);
  std::vector<SeenPoint> points;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (std::isfinite(hits[i].distance)) {
      points.push_back({sonar + hits[i].distance * rays[i].direction, hits[i].normal, hits[i].instance, 1});
    }
  }
  // In open water, the far end of the sector, visible from any side.
  if (points.empty()) {
    for (std::size_t i = 0; i < rays.size(); i += 7) {
      points.push_back({sonar + sector.max_range() * rays[i].direction, Vec3::Zero(), kNoLabel, 1});
    }
  }
  // Weights small objects more than by their number of rays, so that a wide floor does not dominate.
  std::vector<int> rays_on(1 << 16);
  for (const SeenPoint& point : points) {
    ++rays_on[point.instance];
  }
  for (SeenPoint& point : points) {
    point.weight = 1 / std::pow(rays_on[point.instance], 0.6);
  }
  return points;
}

// Where the rays along the sector's border end.
std::vector<Vec3> border_of(Engine& engine, const InsonifiedSector& sector) {
  constexpr int kAcross = 24, kAlong = 6;
  const Vec3& sonar = sector.world_from_sonar().position;
  std::vector<Ray> rays;
  const auto look_at = [&](double across, double along) {
    const Vec3 far = sector.point_at(sector.max_range(), across, along);
    rays.push_back({sonar, (far - sonar).normalized(), 0, sector.max_range()});
  };
  for (const double side : {0.0, 1.0}) {
    for (int i = 0; i <= kAcross; ++i) {
      look_at(i * 1.0 / kAcross, side);
    }
    for (int i = 1; i < kAlong; ++i) {
      look_at(side, i * 1.0 / kAlong);
    }
  }
  std::vector<Hit> hits(rays.size());
  engine.trace(rays, hits);
  std::vector<Vec3> border;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    border.push_back(sonar + std::min(hits[i].distance, sector.max_range()) * rays[i].direction);
  }
  return border;
}

// Extreme vertices of an instance in many directions, world frame.
std::vector<Vec3> tips_of(const Instance& thing) {
  std::vector<Vec3> tips;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        const Vec3f outwards = (thing.world_from_mesh.orientation.conjugate() * Vec3(x, y, z)).cast<float>();
        const auto tip = std::ranges::max_element(thing.mesh->vertices, {},
                                                  [&](const Vec3f& vertex) { return vertex.dot(outwards); });
        tips.push_back(thing.world_from_mesh * tip->cast<double>());
      }
    }
  }
  return tips;
}

// Diagonal of an instance's bounding box [m].
double size_of(const Instance& thing) {
  Eigen::AlignedBox3f box;
  for (const Vec3f& vertex : thing.mesh->vertices) {
    box.extend(vertex);
  }
  return static_cast<double>(box.diagonal().norm());
}

// Extreme points of all visible objects that are small enough. Moving objects are left out, since the scene does not
// have their current poses.
std::vector<Vec3> tips_of(const Scene& scene, const std::vector<SeenPoint>& points, const Vec3& sonar) {
  std::map<std::uint16_t, Vec3> seen;
  for (const SeenPoint& point : points) {
    if (point.instance < scene.instances.size() && !scene.instances[point.instance].moving) {
      seen.emplace(point.instance, point.place);
    }
  }
  std::vector<Vec3> all;
  for (const auto& [instance, place] : seen) {
    if (size_of(scene.instances[instance]) < kLargestWhole * (place - sonar).norm()) {
      const std::vector<Vec3> tips = tips_of(scene.instances[instance]);
      all.insert(all.end(), tips.begin(), tips.end());
    }
  }
  return all;
}

}  // namespace

ViewSubject view_subject(Engine& engine, const Scene& scene, const InsonifiedSector& sector) {
  ViewSubject subject{look_around(engine, sector), {}};
  subject.tips = tips_of(scene, subject.points, sector.world_from_sonar().position);
  std::ranges::copy(border_of(engine, sector), std::back_inserter(subject.tips));
  return subject;
}

}  // namespace insonify
