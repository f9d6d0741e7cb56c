// launch_walks.cpp -- which bearings of the full circle a ping's walks start at.

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "echo/model/flat_plan.h"
#include "echo/walks/random_walks.h"
#include "echo/walks/walk_draws.h"
#include "sonar/bearing_frame.h"

namespace insonify {
namespace {

// Bounce whose random numbers no walk needs.
constexpr int kBounceOfNone = 0xffff;

constexpr double kFullCircle = 2 * std::numbers::pi;

// Direction at a bearing, in the sonar frame.
// @param column, row  Sample of the lattice that gives the angle along the arc.
Vec3 direction_at(const Lattice& lattice, double bearing, int column, int row) {
  const double cos_a = std::cos(bearing), sin_a = std::sin(bearing);
  const double cos_t = lattice.cosines(column)[row], sin_t = lattice.sines(column)[row];
  const bool cone = lattice.shape == BeamShape::kCone;
  return Vec3(cos_a * cos_t, cone ? sin_a : sin_a * cos_t, cone ? cos_a * sin_t : sin_t).normalized();
}

}  // namespace

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
  first_ = static_cast<std::int64_t>(WalkDraws(settings_.seed, 0, 0, kBounceOfNone).a * static_cast<float>(longest));
  const std::size_t most =
      static_cast<std::size_t>(width / kFullCircle * static_cast<double>(bearings_)) + 2 * launches_.size();
  walks_.reserve(most), legs_.reserve(2 * most), echoes_.reserve(2 * most);
}

// Partners are the walks of the beams that launch all of theirs, as many whatever the sonar's bearing. Those of side
// lobes too would make no less noise: main lobes would have fewer.
void RandomWalks::choose_partners(const FlatPlan& plan) {
  partners_.clear();
  if (!plan.two_way) {
    return;
  }
  const auto takes_all = [](const Launch& from) { return from.step == 1; };
  const auto first = std::ranges::find_if(launches_, takes_all);
  const auto end = std::find_if_not(first, launches_.end(), takes_all);
  const double per_radian = static_cast<double>(bearings_) / kFullCircle;
  const double port = plan.port_edges[first->beam], starboard = plan.starboard_edges[(end - 1)->beam];
  height_ = plan.elevation_aperture;
  first_partner_ = static_cast<std::int64_t>(std::ceil((starboard + offset_) * per_radian));
  partners_.resize(static_cast<std::size_t>(std::max(0.0, std::floor((port - starboard) * per_radian) - 1)));
}

// Launches a beam's walks, in random rows. A walk's weight is its share of the transmitted sound, with the beam
// pattern.
void RandomWalks::launch(const PingView& view, const Launch& from, RayList& rays) {
  const Lattice& lattice = view.plan->lattice;
  const double port = view.plan->port_edges[from.beam], starboard = view.plan->starboard_edges[from.beam];
  const double spacing = kFullCircle / static_cast<double>(bearings_);
  const auto number_at = [&](double bearing) {
    return static_cast<std::int64_t>(std::floor((bearing + offset_) / spacing));
  };
  const std::int64_t past = number_at(starboard) - first_, last = number_at(port);
  for (std::int64_t number = first_ + (past - (past % from.step + from.step) % from.step); number <= last;
       number += from.step) {
    const auto index = static_cast<std::uint32_t>((number % bearings_ + bearings_) % bearings_);
    const WalkDraws draws(settings_.seed, 0, index, 0);
    const double bearing = (static_cast<double>(number) + double{draws.a}) * spacing - offset_;
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
    const std::int64_t partner = number - first_partner_;
    const bool is_one = partner >= 0 && partner < std::ssize(partners_);
    walks_.push_back({.point = view.world_from_sonar.position,
                      .direction = direction.cast<float>(),
                      .weight = static_cast<float>(double{lattice.shares(rows_of)[row]} * lattice.rows * measure *
                                                   spacing * static_cast<double>(from.step)),
                      .index = index,
                      .column = column,
                      .partner = is_one ? static_cast<int>(partner) : -1});
    if (is_one) {
      partners_[static_cast<std::size_t>(partner)].weight =
          walks_.back().weight * lattice.reciprocals(rows_of)[row] * static_cast<float>(partners_.size());
    }
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
  offset_ = BearingFrame(view.world_from_sonar.orientation.toRotationMatrix()).offset;
  choose_steps(plan);
  choose_partners(plan);
  for (const Launch& from : launches_) {
    launch(view, from, rays);
  }
  walking_ = walks_.size();
  order_ = 1;
}

}  // namespace insonify
