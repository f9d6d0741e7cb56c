// random_walks.cpp -- advances all walks of a ping together, a bounce a round.

#include "echo/walks/random_walks.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "base/philox.h"
#include "echo/model/flat_plan.h"
#include "echo/model/hit.h"
#include "sonar/bearing_frame.h"

namespace insonify {
namespace {

// Remaining share of energy below which Russian roulette ends walks. Survivors continue with this share.
constexpr float kLeastShare = 1e-5F;

// Half of the range interval that an echo is spread over, relative to its range: as for the widest secondary echo.
constexpr float kHalfSpread = 0.5F * kWidestFootprint;

// Two hits on one surface count as the same mirror if the cosine between their normals is larger than this.
constexpr float kSameMirror = 0.9F;

// Mirrors count as perpendicular if the cosine between their normals is smaller than this.
constexpr float kPerpendicular = 0.01F;

// Bounce whose random numbers no walk needs.
constexpr int kBounceOfNone = 0xffff;

// Four uniform random numbers for one bounce of a walk; bounce 0 is its launch.
struct Draws {
  float a, b, c, d;
  std::uint32_t word;  // From which `a` is made.

  Draws(std::uint64_t seed, std::uint64_t number, std::uint32_t walk, int bounce) {
    const PhiloxCounter counter = {
        walk, static_cast<std::uint32_t>(number), static_cast<std::uint32_t>(number >> 32),
        (static_cast<std::uint32_t>(bounce) << 8) + static_cast<std::uint32_t>(RandomPurpose::kWalks)};
    const PhiloxCounter words = philox(counter, philox_key(seed));
    word = words[0];
    a = uniform_open(words[0]);
    b = uniform_open(words[1]);
    c = uniform_open(words[2]);
    d = uniform_open(words[3]);
  }
};

// Direction at a bearing, in the sonar frame.
// @param column, row  Sample of the lattice that gives the angle along the arc.
Vec3 direction_at(const Lattice& lattice, double bearing, int column, int row) {
  const double cos_a = std::cos(bearing), sin_a = std::sin(bearing);
  const double cos_t = lattice.cosines(column)[row], sin_t = lattice.sines(column)[row];
  const bool cone = lattice.shape == BeamShape::kCone;
  return Vec3(cos_a * cos_t, cone ? sin_a : sin_a * cos_t, cone ? cos_a * sin_t : sin_t).normalized();
}

constexpr double kFullCircle = 2 * std::numbers::pi;

SurfaceLabel label_of(const Hit& hit) {
  return surface_label(hit.instance, hit.material);
}

}  // namespace

RandomWalks::RandomWalks(const Settings& settings) : settings_(settings) {}

// Chooses which of the walks each beam launches, and how many bearings come to settings_.count walks. A beam of a
// two-way array takes all of them down to a gain of -6 dB: each walk's weight, below that, is about the same.
void RandomWalks::choose_steps(const FlatPlan& plan) {
  constexpr float kGainOfAll = 0.25F;
  launches_.clear();
  if (plan.two_way) {
    for (int beam = 0; beam < plan.beam_count; ++beam) {
      const float gain = plan.lattice.transmitted[static_cast<std::size_t>(beam) * plan.lattice.columns_per_beam];
      launches_.push_back({beam, static_cast<std::int64_t>(
                                     std::bit_floor(static_cast<std::uint32_t>(std::max(1.0F, kGainOfAll / gain))))});
    }
  } else {
    for (const int beam : settings_.beams) {
      launches_.push_back({beam, 1});
    }
  }
  double width = 0;
  std::int64_t longest = 1;
  for (const auto& [beam, step] : launches_) {
    width += double{plan.port_edges[beam] - plan.starboard_edges[beam]} / static_cast<double>(step);
    longest = std::max(longest, step);
  }
  constexpr double kMost = 1U << 31;  // So that their numbers have 32 bits.
  const double wanted = std::min(kMost, settings_.count * kFullCircle / width);
  bearings_ = longest * std::max<std::int64_t>(1, std::llround(wanted / static_cast<double>(longest)));
  first_ = Draws(settings_.seed, 0, 0, kBounceOfNone).word % longest;
  const std::size_t most =
      static_cast<std::size_t>(width / kFullCircle * static_cast<double>(bearings_)) + 2 * launches_.size();
  walks_.reserve(most), legs_.reserve(most), echoes_.reserve(most);
}

// Launches a beam's walks, in random rows. A walk's weight is its share of the transmitted sound, with the beam
// pattern.
// @param offset  BearingFrame::offset
void RandomWalks::launch(const PingView& view, const Launch& from, double offset, RayList& rays) {
  const Lattice& lattice = view.plan->lattice;
  const double port = view.plan->port_edges[from.beam], starboard = view.plan->starboard_edges[from.beam];
  const double spacing = kFullCircle / static_cast<double>(bearings_);
  const auto number_at = [&](double bearing) {
    return static_cast<std::int64_t>(std::floor((bearing + offset) / spacing));
  };
  const std::int64_t past = number_at(starboard) - first_, last = number_at(port);
  for (std::int64_t number = first_ + (past - (past % from.step + from.step) % from.step); number <= last;
       number += from.step) {
    const auto index = static_cast<std::uint32_t>((number % bearings_ + bearings_) % bearings_);
    const Draws draws(settings_.seed, 0, index, 0);
    const double bearing = (static_cast<double>(number) + double{draws.a}) * spacing - offset;
    if (bearing > port || bearing <= starboard) {
      continue;
    }
    const int per_beam = lattice.columns_per_beam;
    const int within = std::min(static_cast<int>((port - bearing) / (port - starboard) * per_beam), per_beam - 1);
    const int column = from.beam * per_beam + within;
    // All columns of wedges have the same sets of rows: a walk keeps its own, whatever the column.
    const int rows_of = lattice.shape == BeamShape::kWedge ? static_cast<int>(index % per_beam) : column;
    const int row = std::min(static_cast<int>(double{draws.b} * lattice.rows), lattice.rows - 1);
    const Vec3 direction = view.world_from_sonar.orientation * direction_at(lattice, bearing, rows_of, row);
    const double measure = double{lattice.column_measure[column]} / double{lattice.column_width[column]};
    walks_.push_back({.point = view.world_from_sonar.position,
                      .direction = direction.cast<float>(),
                      .weight = static_cast<float>(double{lattice.shares(rows_of)[row]} * lattice.rows * measure *
                                                   spacing * static_cast<double>(from.step)),
                      .index = index,
                      .column = column});
    rays.rays.push_back({view.world_from_sonar.position, direction, 0, double{view.plan->reach()}});
  }
}

void RandomWalks::ask(const PingView& view, Workers&, RayList& rays) {
  const FlatPlan& plan = *view.plan;
  number_ = view.number;
  water_ = plan.secondary != SecondaryEchoes::kNone && plan.max_surfaces > 2 ? settings_.elsewhere.water : kNoSurface;
  legs_.clear();
  echoes_.clear();
  walks_.clear();
  choose_steps(plan);
  const double offset = BearingFrame(view.world_from_sonar.orientation.toRotationMatrix()).offset;
  for (const Launch& from : launches_) {
    launch(view, from, offset, rays);
  }
  walking_ = walks_.size();
  order_ = 1;
}

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
void RandomWalks::connect(const FlatPlan& plan, const Pose& world_from_sonar, const Hit& hit, const Vec3f& in,
                          int order, const Walk& walk) {
  const Vec3 back = world_from_sonar.position - walk.point;
  const double distance = back.norm();
  const double length = double{walk.length} + distance;
  if (order < 2 || !(0.5 * length < double{plan.reach()}) || !(distance > 2 * double{kRayClearance})) {
    return;
  }
  const Vec3 out = back / distance;
  const Vec3f towards = (world_from_sonar.orientation.inverse() * -out).cast<float>();
  if (!plan.receives(towards)) {
    return;
  }
  const SurfaceLaw law =
      SurfaceLaw::of(plan.scatter.scattering(label_of(hit)), hit.texture, hit.normal.cast<float>().dot(in));
  const float sent_back = walk.share * per_steradian(plan, law, hit, in, out.cast<float>(), order, walk);
  if (!(sent_back > 0)) {
    return;
  }
  const FlatPlan::Arrival arrival = plan.arrival_from(towards);
  const double lost = std::exp(-2 * double{plan.neper_per_metre} * length) / (distance * distance);
  legs_.push_back({walk.point, out, double{kRayClearance}, distance - double{kRayClearance}});
  echoes_.push_back({.azimuth = arrival.bearing,
                     .elevation = arrival.elevation,
                     .path_length = static_cast<float>(length),
                     .half_length = kHalfSpread * static_cast<float>(0.5 * length),
                     .power = plan.arriving_power(walk.column, static_cast<float>(double{sent_back} * lost), arrival),
                     .weight = walk.weight,
                     .order = std::min(order, kPathOrders),
                     .surface = label_of(hit)});
}

// Draws the next direction of a walk; false if the walk ends.
bool RandomWalks::bounce(const FlatPlan& plan, const Hit& hit, int order, Walk& walk) {
  const Draws draws(settings_.seed, label_of(hit) == settings_.waves ? number_ : 0, walk.index, order);
  const Vec3f normal = hit.normal.cast<float>();
  const SurfaceLaw law =
      SurfaceLaw::of(plan.scatter.scattering(label_of(hit)), hit.texture, normal.dot(walk.direction));
  const SurfaceLaw::Next next = law.draw(normal, walk.direction, draws.a, draws.b, draws.c);
  if (order == 1) {
    walk.first_mirrored = next.mirrored;
    walk.first_surface = label_of(hit);
    walk.first_normal = normal;
  }
  if (order <= 2) {
    // Coherent share of the mirrored sound; 1 if facets do not act as mirrors.
    const auto of_lobe = static_cast<float>(coherent_share(plan, label_of(hit), double{normal.dot(walk.direction)}));
    const float share = law.coherent > of_lobe ? of_lobe / law.coherent : 1.0F;
    walk.coherent *= next.mirrored ? share : 0.0F;
    walk.second_mirrored = next.mirrored;
    walk.first_coherent = order == 1 ? share : walk.first_coherent;
    walk.second_normal = normal;
  }
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
  std::size_t going_on = 0;
  for (std::size_t i = 0; i < walking_; ++i) {
    const Hit& hit = hits.rays[i];
    if (!std::isfinite(hit.distance)) {
      continue;
    }
    Walk walk = walks_[i];
    walk.point += hit.distance * hits.asked.rays[i].direction;
    walk.length += static_cast<float>(hit.distance);
    connect(plan, world_from_sonar, hit, walk.direction, order_, walk);
    const double home = (world_from_sonar.position - walk.point).norm();
    const double left = 2 * double{plan.reach()} - double{walk.length} - home;
    if (left > 0 && bounce(plan, hit, order_, walk)) {
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
