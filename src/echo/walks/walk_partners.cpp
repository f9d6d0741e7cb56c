// walk_partners.cpp -- returns of walks over the first surfaces of others, which lie in the beam.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "echo/model/flat_plan.h"
#include "echo/walks/random_walks.h"

namespace insonify {

// Finds the first surfaces of the walks that others have as partners.
void RandomWalks::find_partners(const PingView& view, const RayAnswers& hits) {
  const Pose& world_from_sonar = view.world_from_sonar;
  for (std::size_t i = 0; i < walking_; ++i) {
    const Hit& hit = hits.rays[i];
    if (walks_[i].partner < 0 || !std::isfinite(hit.distance)) {
      continue;
    }
    const Vec3& out = hits.asked.rays[i].direction;
    Partner& partner = partners_[static_cast<std::size_t>(walks_[i].partner)];
    partner.hit = hit;
    partner.point = world_from_sonar.position + hit.distance * out;
    partner.range = hit.distance;
    partner.back = -out.cast<float>();
    partner.arrival = view.plan->arrival_from((world_from_sonar.orientation.inverse() * out).cast<float>());
    partner.arrival.received = 1;  // Part of its weight.
  }
}

// Number of partners per area of a surface that is seen from the sonar, relative to the number of all [1/m^2]; 0 where
// there are none. About: the balance heuristic is unbiased as long as both ways of finding a path use the same.
// @param facing  Cosine between the surface's normal and the direction to the sonar.
float RandomWalks::partner_density(double bearing, float facing, double range) const {
  const double per_radian = static_cast<double>(bearings_) / (2 * std::numbers::pi);
  const auto number = static_cast<std::int64_t>(std::floor((bearing + offset_) * per_radian)) - first_partner_;
  if (number < 0 || number >= std::ssize(partners_)) {
    return 0;
  }
  const double solid_angle = static_cast<double>(partners_.size()) / per_radian * height_;
  return static_cast<float>(double{facing} / (solid_angle * range * range));
}

// Adds the leg from a walk's last surface to its partner, and the echo of the path by it, to legs_ and echoes_. All
// walks at one place of their random numbers have the same partner, whatever the sonar's bearing, as long as it has it.
// @param choice  Chooses the partner, 0..1.
void RandomWalks::connect_by_partner(const FlatPlan& plan, const Hit& hit, float choice, const Walk& walk) {
  const std::int64_t count = std::ssize(partners_);
  if (count == 0) {
    return;
  }
  const std::int64_t chosen = std::min(static_cast<std::int64_t>(choice * static_cast<float>(count)), count - 1);
  const Partner& by = partners_[static_cast<std::size_t>(((chosen - first_partner_) % count + count) % count)];
  const Vec3 there = by.point - walk.point;
  const double distance = there.norm(), length = double{walk.length} + distance + by.range;
  if (!(by.range > 0) || !(0.5 * length < double{plan.reach()}) || !(distance > 2 * double{kRayClearance})) {
    return;
  }
  const Vec3f on = (there / distance).cast<float>(), in = walk.direction, normal = hit.normal.cast<float>(),
              last_normal = by.hit.normal.cast<float>();
  const float arriving = -last_normal.dot(on);
  if (!(arriving > 0) || !(normal.dot(on) > 0)) {
    return;
  }
  const SurfaceLaw here = SurfaceLaw::of(plan.scatter.scattering(label_of(hit)), hit.texture, normal.dot(in));
  const SurfaceLaw last = SurfaceLaw::of(plan.scatter.scattering(label_of(by.hit)), by.hit.texture, arriving);
  const float glint = here.mirrored_into(normal, in, on);
  float sent_back = 0;
  for (const bool mirrored : {false, true}) {
    Walk reflected = walk;
    note_bounce(plan, here, hit, mirrored, reflected);
    const float sent = mirrored ? here.coherent * glint : here.diffuse_into(normal, on) + (1 - here.coherent) * glint;
    sent_back += sent > 0 ? sent * per_steradian(plan, last, by.hit, on, by.back, order_ + 1, reflected) : 0;
  }
  const float facing = std::max(last_normal.dot(by.back), kLeastFacing);
  const double drawn = double{here.density(normal, in, on)};
  const double by_partner = double{partner_density(double{by.arrival.bearing}, facing, by.range)} * distance *
                            distance / std::max(double{arriving}, double{kLeastFacing});
  const double power = double{walk.share * sent_back * arriving * by.weight} / (distance * distance * double{facing}) *
                       by_partner / (by_partner + drawn) * std::exp(-2 * double{plan.neper_per_metre} * length);
  if (!(power > 0)) {
    return;
  }
  legs_.push_back(
      {walk.point, on.cast<double>().normalized(), double{kRayClearance}, distance - double{kRayClearance}});
  echoes_.push_back({.azimuth = by.arrival.bearing,
                     .elevation = plan.middle_elevation,
                     .path_length = static_cast<float>(length),
                     .half_length = half_spread(length),
                     .power = plan.arriving_power(walk.column, static_cast<float>(power), by.arrival),
                     .weight = walk.weight,
                     .order = std::min(order_ + 1, kPathOrders),
                     .surface = label_of(by.hit)});
}

}  // namespace insonify
