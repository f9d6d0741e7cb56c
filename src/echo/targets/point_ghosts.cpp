// point_ghosts.cpp -- the legs between sonar and points, and the echoes of all their pairs.

#include "echo/targets/point_ghosts.h"

#include <algorithm>
#include <cmath>

#include "base/philox.h"
#include "echo/model/flat_plan.h"
#include "echo/model/hit.h"
#include "echo/targets/lines_of_sight.h"
#include "echo/targets/point_echoes.h"

namespace insonify {
namespace {

constexpr std::size_t kMostLegs = PointGhosts::kMostFaces + 2;

Ray ray_between(const Vec3& from, const Vec3& to) {
  const Vec3 there = to - from;
  const double length = there.norm();
  const double clearance = double{kRayClearance};
  return {from, length > 0 ? Vec3(there / length) : Vec3(Vec3::UnitX()), clearance, length - clearance};
}

}  // namespace

PointGhosts::PointGhosts(std::span<const PointTarget> points, const std::optional<Surface>& surface,
                         std::shared_ptr<const std::vector<PlaneMirror>> faces, bool phases)
    : points_(points), surface_(surface), faces_(std::move(faces)), glints_(phases && surface_ && surface_->waves) {}

// Adds the leg over a mirror, if both ends are on the same side of it.
void PointGhosts::add_leg_by(const Vec3& sonar, std::size_t point, int mirror, const Vec3& normal, double offset,
                             RayList& rays) {
  const Vec3& place = points_[point].position;
  const double here = normal.dot(sonar) - offset, there = normal.dot(place) - offset;
  if (!(here * there > 0)) {
    return;
  }
  const Vec3 image = place - 2 * there * normal;
  const double share = here / (here + there);
  const Vec3 bounce = sonar + share * (image - sonar);
  if (mirror >= 0) {
    const PlaneMirror& face = (*faces_)[static_cast<std::size_t>(mirror)];
    const auto flush = PlaneMirror::kFlush;
    if ((bounce.array() < face.low.array() - flush).any() || (bounce.array() > face.high.array() + flush).any()) {
      return;
    }
  }
  legs_.push_back({mirror, point, rays.sights.size(), image, (bounce - sonar).norm()});
  rays.sights.push_back(ray_between(sonar, bounce));
  rays.ends.emplace_back();
  if (mirror >= 0) {  // The first ray must hit the face, which may have holes.
    const double cosine = std::max(0.01, std::abs(here) / legs_.back().bounce);
    rays.sights.back().max_distance += 2 * double{kRayClearance} + 2 * PlaneMirror::kFlush / cosine;
    rays.ends[legs_.back().ray] = {legs_.back().bounce - (PlaneMirror::kFlush + double{kRayClearance}) / cosine};
  }
  rays.sights.push_back(ray_between(bounce, place));
  rays.ends.emplace_back();
}

void PointGhosts::add_legs(const Vec3& sonar, std::size_t point, RayList& rays) {
  const std::size_t first = legs_.size();
  legs_.push_back({kStraight, point, rays.sights.size(), points_[point].position, 0});
  rays.sights.push_back(ray_between(sonar, points_[point].position));
  rays.ends.emplace_back();
  if (surface_ && sonar.z() < surface_->level && points_[point].position.z() < surface_->level) {
    add_leg_by(sonar, point, kWater, Vec3::UnitZ(), surface_->level, rays);
  }
  for (std::size_t i = 0; faces_ && i < faces_->size() && legs_.size() - first < kMostLegs; ++i) {
    const PlaneMirror& face = (*faces_)[i];
    add_leg_by(sonar, point, static_cast<int>(i), face.normal, face.offset, rays);
  }
}

std::optional<PointGhosts::Way> PointGhosts::way_of(const PingView& view, const RayAnswers& hits,
                                                    const Leg& leg) const {
  const FlatPlan& plan = *view.plan;
  const Pose& world_from_sonar = view.world_from_sonar;
  const Vec3 there = leg.image - world_from_sonar.position;
  const Vec3f direction = (world_from_sonar.inverse() * leg.image).normalized().cast<float>();
  if (!plan.receives(direction) || !(there.norm() >= LinesOfSight::kNearest)) {
    return {};
  }
  Way way{leg.mirror, plan.arrival_from(direction), there.norm(), 1, 0};
  if (leg.mirror == kStraight) {
    if (!hits.is_clear(leg.ray)) {
      return {};
    }
  } else if (leg.mirror == kWater) {
    if (!hits.is_clear(leg.ray) || !hits.is_clear(leg.ray + 1)) {
      return {};
    }
    way.intensity = plan.scatter.scattering(surface_->label).reflectance(there.z() / way.length);
    way.turns = 0.5;
  } else {
    const PlaneMirror& face = (*faces_)[static_cast<std::size_t>(leg.mirror)];
    const Hit& hit = hits.sights[leg.ray];
    const double cosine = std::abs(face.normal.dot(there)) / way.length;
    // The ray must hit the face itself, with nothing in front of it.
    const bool met = std::isfinite(hit.distance) &&
                     std::abs(hit.distance - leg.bounce) * cosine < PlaneMirror::kFlush + double{kRayClearance};
    if (!met || !hits.is_clear(leg.ray + 1)) {
      return {};
    }
    const SurfaceLabel label = surface_label(hit.instance, hit.material);
    const double zone = 2 / plan.turns_per_metre * leg.bounce * (way.length - leg.bounce) / way.length;
    const double small = std::min(1.0, face.area * cosine / zone);
    way.intensity = coherent_reflectance(plan, label, cosine) * small * small;
  }
  way.intensity *= hits.passed(leg.ray) * (leg.mirror == kStraight ? 1 : hits.passed(leg.ray + 1));
  way.intensity *= double{way.arrival.received} / (way.length * way.length) *
                   std::exp(-2 * double{plan.neper_per_metre} * way.length);
  return way;
}

PointGhosts::Glint PointGhosts::glint(const FlatPlan& plan, std::size_t point, std::uint64_t number) const {
  if (!glints_) {
    return {1, 1, 0};
  }
  const PhiloxCounter counter = {static_cast<std::uint32_t>(point), static_cast<std::uint32_t>(number),
                                 static_cast<std::uint32_t>(number >> 32),
                                 static_cast<std::uint32_t>(RandomPurpose::kWaves)};
  const PhiloxCounter words = philox(counter, philox_key(plan.seed));
  const double intensity = -std::log(double{uniform_open(words[0])});
  return {intensity, intensity * intensity, double{uniform_open(words[1])}};
}

// Adds the echoes of all pairs of legs, except that of the direct leg with itself.
void PointGhosts::add_echoes(const FlatPlan& plan, std::span<const Way> ways, std::size_t point, std::uint64_t number,
                             EchoList& found) const {
  const double strength = std::pow(10.0, points_[point].target_strength_db / 10);
  const double own_turns = own_phase(plan, point);
  const Glint waves = glint(plan, point, number);
  for (std::size_t i = 0; i < ways.size(); ++i) {
    for (std::size_t j = i; j < ways.size(); ++j) {
      const Way &out = ways[i], &back = ways[j];
      const int order = 1 + (out.mirror != kStraight ? 1 : 0) + (back.mirror != kStraight ? 1 : 0);
      if (order == 1 || order > plan.max_surfaces) {
        continue;
      }
      const int over_water = (out.mirror == kWater ? 1 : 0) + (back.mirror == kWater ? 1 : 0);
      const double range = 0.5 * (out.length + back.length);
      const double passed = over_water == 2 ? waves.twice : over_water == 1 ? waves.once : 1.0;
      const double intensity = passed * strength * out.intensity * back.intensity;
      const double turns = plan.turns_per_metre * range + own_turns + out.turns + back.turns + over_water * waves.turns;
      // Received by one leg, sent by the other.
      add_discrete_echo(plan, out.arrival, order, range, intensity * plan.sent_gain(back.arrival, out.arrival), turns,
                        found);
      if (i != j) {
        add_discrete_echo(plan, back.arrival, order, range, intensity * plan.sent_gain(out.arrival, back.arrival),
                          turns, found);
      }
    }
  }
}

void PointGhosts::ask(const PingView& view, Workers&, RayList& rays) {
  legs_.clear();
  if (view.plan->secondary == SecondaryEchoes::kNone || view.plan->max_surfaces < 2) {
    return;
  }
  for (std::size_t point = 0; point < points_.size(); ++point) {
    add_legs(view.world_from_sonar.position, point, rays);
  }
}

void PointGhosts::answer(const PingView& view, const RayAnswers& hits, Workers&, RayList&, EchoList& found) {
  std::array<Way, kMostLegs> ways;
  for (std::size_t first = 0, last = 0; first < legs_.size(); first = last) {
    std::size_t count = 0;
    for (last = first; last < legs_.size() && legs_[last].point == legs_[first].point; ++last) {
      if (const std::optional<Way> way = way_of(view, hits, legs_[last])) {
        ways[count++] = *way;
      }
    }
    add_echoes(*view.plan, std::span(ways).first(count), legs_[first].point, view.number, found);
  }
  legs_.clear();
}

}  // namespace insonify
