// random_walks.cpp -- advances all walks of a ping together, a bounce a round.

#include "echo/walks/random_walks.h"

#include <algorithm>
#include <cmath>

#include "echo/model/flat_plan.h"
#include "echo/model/hit.h"
#include "echo/walks/walk_draws.h"

namespace insonify {
namespace {

// Remaining share of energy below which Russian roulette ends walks. Survivors continue with this share.
constexpr float kLeastShare = 1e-5F;

// Two hits on one surface count as the same mirror if the cosine between their normals is larger than this.
constexpr float kSameMirror = 0.9F;

// Mirrors count as perpendicular if the cosine between their normals is smaller than this.
constexpr float kPerpendicular = 0.01F;

}  // namespace

RandomWalks::RandomWalks(const Settings& settings) : settings_(settings) {}

// Energy per steradian scattered towards the sonar, without the paths that other echoes include (see the class).
float RandomWalks::per_steradian(const FlatPlan& plan, const SurfaceLaw& law, const Hit& hit, const Vec3f& in,
                                 const Vec3f& out, int order, const Walk& walk) const {
  const Vec3f normal = hit.normal.cast<float>();
  if (order == 2) {
    return walk.first_mirrored
               ? 0.0F
               : law.diffuse_into(normal, out) + (1 - law.coherent) * law.mirrored_into(normal, in, out);
  }
  const bool by_one_mirror = order == 3 && walk.first_mirrored && walk.first_surface == label_of(hit) &&
                             walk.first_normal.dot(normal) > kSameMirror;
  const bool in_corner = settings_.elsewhere.corners && order == 3 && walk.coherent > 0 &&
                         std::abs(walk.first_normal.dot(normal)) < kPerpendicular &&
                         std::abs(walk.second_normal.dot(normal)) < kPerpendicular &&
                         std::abs(walk.first_normal.dot(walk.second_normal)) < kPerpendicular;
  const auto coherent = [&] { return static_cast<float>(coherent_share(plan, label_of(hit), double{normal.dot(in)})); };
  float left = by_one_mirror ? 1 - law.coherent : 1.0F;
  if (in_corner) {
    left *= 1 - walk.coherent * coherent();
  }
  const bool water_first = walk.first_surface == water_, water_last = label_of(hit) == water_;
  if (order == 3 && walk.first_mirrored && !walk.second_mirrored && water_first != water_last) {
    left *= 1 - (water_first ? law.coherent * walk.first_coherent : coherent());
  }
  return law.diffuse_into(normal, out) + left * law.mirrored_into(normal, in, out);
}

// Adds the leg from the last bounce of a walk to the sonar, and its echo, to legs_ and echoes_.
void RandomWalks::connect(const FlatPlan& plan, const Pose& world_from_sonar, const Hit& hit, const Walk& walk) {
  const Vec3 back = world_from_sonar.position - walk.point;
  const double distance = back.norm();
  const double length = double{walk.length} + distance;
  if (order_ < 2 || !(0.5 * length < double{plan.reach()}) || !(distance > 2 * double{kRayClearance})) {
    return;
  }
  const Vec3 out = back / distance;
  const Vec3f towards = (world_from_sonar.orientation.inverse() * -out).cast<float>();
  if (!plan.receives(towards)) {
    return;
  }
  const Vec3f& in = walk.direction;
  const Vec3f normal = hit.normal.cast<float>();
  const SurfaceLaw law = SurfaceLaw::of(plan.scatter.scattering(label_of(hit)), hit.texture, normal.dot(in));
  float sent_back = walk.share * per_steradian(plan, law, hit, in, out.cast<float>(), order_, walk);
  if (!(sent_back > 0)) {
    return;
  }
  const FlatPlan::Arrival arrival = plan.arrival_from(towards);
  if (!partners_.empty()) {  // What a connection by partner finds too.
    const float facing = std::max(normal.dot(out.cast<float>()), kLeastFacing);
    const double by_partner = double{partner_density(double{arrival.bearing}, facing, distance)} * hit.distance *
                              hit.distance / std::max(double{-normal.dot(in)}, double{kLeastFacing});
    sent_back *= static_cast<float>(double{walk.density} / (double{walk.density} + by_partner));
  }
  const double lost = std::exp(-2 * double{plan.neper_per_metre} * length) / (distance * distance);
  legs_.push_back({walk.point, out, double{kRayClearance}, distance - double{kRayClearance}});
  echoes_.push_back({.azimuth = arrival.bearing,
                     .elevation = plan.middle_elevation,
                     .path_length = static_cast<float>(length),
                     .half_length = half_spread(length),
                     .power = plan.arriving_power(walk.column, static_cast<float>(double{sent_back} * lost), arrival),
                     .weight = walk.weight,
                     .order = std::min(order_, kPathOrders),
                     .surface = label_of(hit)});
}

// Notes how a surface has reflected a walk.
void RandomWalks::note_bounce(const FlatPlan& plan, const SurfaceLaw& law, const Hit& hit, bool mirrored,
                              Walk& walk) const {
  const Vec3f normal = hit.normal.cast<float>();
  if (order_ == 1) {
    walk.first_mirrored = mirrored;
    walk.first_surface = label_of(hit);
    walk.first_normal = normal;
  }
  if (order_ <= 2) {
    // Coherent share of the mirrored sound; 1 if facets do not act as mirrors.
    const auto of_lobe = static_cast<float>(coherent_share(plan, label_of(hit), double{normal.dot(walk.direction)}));
    const float share = law.coherent > of_lobe ? of_lobe / law.coherent : 1.0F;
    walk.coherent *= mirrored ? share : 0.0F;
    walk.second_mirrored = mirrored;
    walk.first_coherent = order_ == 1 ? share : walk.first_coherent;
    walk.second_normal = normal;
  }
}

// Draws the next direction of a walk; false if the walk ends.
bool RandomWalks::bounce(const FlatPlan& plan, const Hit& hit, const WalkDraws& draws, Walk& walk) {
  const Vec3f normal = hit.normal.cast<float>();
  const SurfaceLaw law =
      SurfaceLaw::of(plan.scatter.scattering(label_of(hit)), hit.texture, normal.dot(walk.direction));
  const SurfaceLaw::Next next = law.draw(normal, walk.direction, draws.a, draws.b, draws.c);
  note_bounce(plan, law, hit, next.mirrored, walk);
  walk.density = partners_.empty() ? 0 : law.density(normal, walk.direction, next.direction);
  walk.share *= next.share;
  walk.direction = next.direction;
  if (walk.share < kLeastShare) {  // Russian roulette.
    if (!(draws.d * kLeastShare < walk.share)) {
      return false;
    }
    walk.share = kLeastShare;
  }
  return true;
}

// Moves each walk to its hit, and draws its next leg. Walks end if they leave the scene or can no longer return within
// the range window.
void RandomWalks::bounce_all(const PingView& view, const RayAnswers& hits, RayList& more) {
  const FlatPlan& plan = *view.plan;
  const Pose& world_from_sonar = view.world_from_sonar;
  legs_.clear();
  echoes_.clear();
  if (order_ == 1) {
    find_partners(view, hits);
  }
  std::size_t going_on = 0;
  for (std::size_t i = 0; i < walking_; ++i) {
    const Hit& hit = hits.rays[i];
    if (!std::isfinite(hit.distance)) {
      continue;
    }
    Walk walk = walks_[i];
    walk.point += hit.distance * hits.asked.rays[i].direction;
    walk.length += static_cast<float>(hit.distance);
    const WalkDraws draws(settings_.seed, label_of(hit) == settings_.waves ? number_ : 0, walk.index, order_);
    connect(plan, world_from_sonar, hit, walk);
    connect_by_partner(plan, hit, draws.d, walk);
    const double home = (world_from_sonar.position - walk.point).norm();
    const double left = 2 * double{plan.reach()} - double{walk.length} - home;
    if (left > 0 && bounce(plan, hit, draws, walk)) {
      walks_[going_on++] = walk;
      more.rays.push_back({walk.point, walk.direction.cast<double>().normalized(), double{kRayClearance}, home + left});
    }
  }
  walking_ = going_on;
  more.rays.insert(more.rays.end(), legs_.begin(), legs_.end());
}

void RandomWalks::add_clear_legs(std::span<const Hit> legs, EchoList& found) const {
  for (std::size_t i = 0; i < legs.size(); ++i) {
    if (!std::isfinite(legs[i].distance)) {
      found.spread.push_back(echoes_[i]);
    }
  }
}

void RandomWalks::answer(const PingView& view, const RayAnswers& hits, Workers&, RayList& more, EchoList& found) {
  if (!hits.rays.empty()) {
    add_clear_legs(hits.rays.subspan(walking_), found);
    bounce_all(view, hits, more);
    ++order_;
  }
}

}  // namespace insonify
