// fitting_view.cpp -- compares camera poses around the sonar and chooses the one that shows most of what the sonar
// sees.

#include <algorithm>
#include <cmath>
#include <numeric>

#include "insonify/scene_view.h"
#include "view/camera.h"
#include "view/drawn_sonar.h"
#include "view/view_subject.h"

namespace insonify {
namespace {

// Aspect ratio in which cameras are compared.
constexpr int kWidth = 4, kHeight = 3;
constexpr double kInFrame = 0.95;  // Fraction of the half picture within which a point counts as shown.
constexpr double kMargin =
    0.80;  // Likewise where a camera is placed: smaller, since objects extend beyond the points seen on them.
constexpr double kSonarMargin = 0.74;
constexpr double kMostShown = 0.95;  // Fraction of the points' weight that determines the camera's distance.
constexpr double kClearance = 1e-3;  // Fraction by which lines of sight are shortened.
constexpr double kFieldOfViewDeg = 50;

struct Candidate {
  ViewConfig view;
  double merit = 0;  // Merit of the viewing direction alone.
};

// The kMostShown quantile of (value, weight) pairs, which it sorts.
double most_of(std::vector<std::pair<double, double>>& values) {
  std::sort(values.begin(), values.end());
  double total = 0;
  for (const auto& [value, weight] : values) {
    total += weight;
  }
  double shown = 0;
  for (const auto& [value, weight] : values) {
    shown += weight;
    if (shown >= kMostShown * total) {
      return value;
    }
  }
  return values.back().first;
}

// The nearest camera looking in the direction -towards that has most of the points, and the sonar, in its frame.
//
// In its own axes, x right, y up and z towards it, a point is in the frame when |x - cx| <= a (cz - z), with a half the
// frame's width at distance 1. So a cz must be half the sum of the greatest x + a z and -x + a z, and cx half their
// difference; the same holds for y.
Candidate fit(const ViewSubject& subject, const Vec3& sonar, const Vec3& towards, double field_of_view) {
  const Camera axes({.position = towards, .look_at = Vec3::Zero(), .field_of_view = field_of_view}, kWidth, kHeight);
  const double half_width = axes.width_at_one() / 2;
  struct Fit {
    double middle, distance;
  };
  // Positions are relative to the sonar, for precision far from the world's origin.
  const auto fit_along = [&](const Vec3& axis, double half) {
    const auto bound_of_points = [&](double side) {
      const auto bound_of = [&](const Vec3& point) {
        const Vec3 place = point - sonar;
        return side * place.dot(axis) + kMargin * half * place.dot(towards);
      };
      std::vector<std::pair<double, double>> values;
      for (const SeenPoint& point : subject.points) {
        values.emplace_back(bound_of(point.place), point.weight);
      }
      double bound = most_of(values);
      for (const Vec3& tip : subject.tips) {
        bound = std::max(bound, bound_of(tip));
      }
      return bound;
    };
    const double points_high = bound_of_points(1);
    const double points_low = bound_of_points(-1);
    Fit fit{0, (points_high + points_low) / 2 / (kMargin * half)};
    // The sonar's symbol is drawn with a size proportional to the distance. Iterates until it fits in the frame too.
    for (int pass = 0; pass < 8; ++pass) {
      const double reach = (kMargin - kSonarMargin) * half * std::max(0.0, fit.distance);
      const double high = std::max(points_high, reach);
      const double low = std::max(points_low, reach);
      fit = {(high - low) / 2, (high + low) / 2 / (kMargin * half)};
    }
    return fit;
  };
  const Fit across = fit_along(axes.right(), half_width);
  const Fit along = fit_along(axes.up(), half_width * kHeight / kWidth);
  const Vec3 middle = sonar + across.middle * axes.right() + along.middle * axes.up();
  const double distance = std::max(across.distance, along.distance);
  // Any look_at in front of the camera would do; this one is about as far away as the sonar.
  const ViewConfig view{.position = middle + distance * towards, .look_at = middle, .field_of_view = field_of_view};
  // Prefers views that fill the frame in both directions.
  return {view, 0.22 * std::min(across.distance, along.distance) / distance};
}

// Cameras on both sides of the sonar and behind it, at several heights. The merit prefers the view over the sonar's
// shoulder.
std::vector<Candidate> candidates_around(Engine& engine, const ViewSubject& subject, const Pose& sonar) {
  Vec3 ahead = Vec3::Zero();
  for (const SeenPoint& point : subject.points) {
    ahead += point.weight * (point.place - sonar.position);
  }
  ahead.z() = 0;
  ahead = ahead.norm() > 1e-6 ? ahead.normalized() : Vec3(Vec3::UnitX());

  std::vector<Candidate> candidates;
  std::vector<Ray> rays;
  for (const double turn_deg : {18, -18, 0, 45, -45, 80, -80}) {
    for (const double height_deg : {32, 20, 45, 60}) {
      const double turn = radians_from_degrees(turn_deg);
      const double height = radians_from_degrees(height_deg);
      const Vec3 level = Eigen::AngleAxisd(turn, Vec3::UnitZ()) * -ahead;
      const Vec3 towards = std::cos(height) * level + std::sin(height) * Vec3::UnitZ();
      Candidate candidate = fit(subject, sonar.position, towards, radians_from_degrees(kFieldOfViewDeg));
      const double oblique = std::abs(std::abs(turn_deg) - 18) / 180;
      candidate.merit += -0.5 * oblique - 0.4 * std::abs(height_deg - 32) / 90;
      candidates.push_back(candidate);
      const Vec3 way = candidate.view.position - sonar.position;
      rays.push_back({sonar.position, way.normalized(), 0, 1.1 * way.norm()});
    }
  }
  // A camera behind a wall is moved to the sonar's side of it, with some clearance.
  std::vector<Hit> hits(rays.size());
  engine.trace(rays, hits);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (std::isfinite(hits[i].distance)) {
      candidates[i].view.position = sonar.position + 0.88 * hits[i].distance * rays[i].direction;
    }
  }
  return candidates;
}

bool in_frame(const Camera& camera, const Vec3& place) {
  const Camera::Image image = camera.image_of(place);
  return image.depth > 0 && std::abs(2 * image.x / kWidth - 1) < kInFrame &&
         std::abs(2 * image.y / kHeight - 1) < kInFrame;
}

// Worth of a camera: fraction of the points' weight that it sees from their front, plus half if it sees the sonar. Rays
// of all cameras are traced together.
class Worth {
 public:
  /// Appends the camera's rays to `rays`.
  Worth(const ViewConfig& view, const std::vector<SeenPoint>& points, const Vec3& sonar, std::vector<Ray>& rays)
      : first_ray_(rays.size()) {
    const Camera camera(view, kWidth, kHeight);
    const auto look_at = [&](const Vec3& place, double weight) {
      const Vec3 way = place - view.position;
      rays.push_back({view.position, way.normalized(), 0, way.norm() * (1 - kClearance)});
      weights_.push_back(weight);
    };
    for (const SeenPoint& point : points) {
      total_ += point.weight;
      const bool from_front = point.normal.isZero() || point.normal.dot(view.position - point.place) > 0;
      if (from_front && in_frame(camera, point.place)) {
        look_at(point.place, point.weight);
      }
    }
    if (in_frame(camera, sonar)) {
      look_at(sonar, 0.5 * total_);
    }
  }

  /// @param hits  Of the rays of all cameras.
  [[nodiscard]] double of(std::span<const Hit> hits) const {
    double seen = 0;
    for (std::size_t i = 0; i < weights_.size(); ++i) {
      seen += std::isfinite(hits[first_ray_ + i].distance) ? 0 : weights_[i];
    }
    return seen / total_;
  }

 private:
  std::size_t first_ray_;
  double total_ = 0;
  std::vector<double> weights_;  // Those of what the rays go to.
};

// Pitches a camera until the points are vertically centred in its frame: perspective gives near points more room below
// than far ones above. Points far outside the frame are ignored.
ViewConfig aimed(ViewConfig view, const ViewSubject& subject, const Vec3& sonar) {
  const Camera camera(view, kWidth, kHeight);
  const double half = camera.width_at_one() / 2;
  // Height above the optical axis at distance 1.
  const auto height_of = [&](const Vec3& place) {
    const Vec3 way = place - view.position;
    return way.dot(camera.up()) / way.dot(camera.forward());
  };
  const auto is_near_frame = [&](const Vec3& place) {
    const Vec3 way = place - view.position;
    return way.dot(camera.forward()) > 0 && std::abs(way.dot(camera.right())) < half * way.dot(camera.forward()) &&
           std::abs(height_of(place)) < half;
  };
  std::vector<std::pair<double, double>> highs;
  std::vector<std::pair<double, double>> lows;
  for (const SeenPoint& point : subject.points) {
    if (is_near_frame(point.place)) {
      highs.emplace_back(height_of(point.place), point.weight);
      lows.emplace_back(-height_of(point.place), point.weight);
    }
  }
  const double sonar_height = height_of(sonar);
  if (highs.empty()) {
    return view;
  }
  double high = std::max(most_of(highs), sonar_height);
  double low = std::max(most_of(lows), -sonar_height);
  for (const Vec3& tip : subject.tips) {
    if (is_near_frame(tip)) {
      high = std::max(high, height_of(tip));
      low = std::max(low, -height_of(tip));
    }
  }
  const double middle = (high - low) / 2;
  view.look_at += (view.look_at - view.position).norm() * middle * camera.up();
  return view;
}

}  // namespace

ViewConfig fitting_view(Engine& engine, const Scene& scene, const SonarConfig& sonar, const Pose& world_from_sonar) {
  const ViewSubject subject = view_subject(engine, scene, InsonifiedSector(sonar, world_from_sonar));
  std::vector<Candidate> candidates = candidates_around(engine, subject, world_from_sonar);
  std::vector<Ray> rays;
  std::vector<Worth> worths;
  for (Candidate& candidate : candidates) {
    candidate.view = aimed(candidate.view, subject, world_from_sonar.position);
    worths.emplace_back(candidate.view, subject.points, world_from_sonar.position, rays);
  }
  std::vector<Hit> hits(rays.size());
  engine.trace(rays, hits);
  ViewConfig best;
  double best_worth = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const double worth = candidates[i].merit + worths[i].of(hits);
    if (worth > best_worth) {
      best = candidates[i].view;
      best_worth = worth;
    }
  }
  return best;
}

}  // namespace insonify
