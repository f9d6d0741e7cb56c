// bottom_track.cpp -- the likeliest continuous track through the scores of all pings, by the Viterbi algorithm.

#include "insonify/survey/bottom_track.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <numeric>

#include "insonify/error.h"
#include "insonify/field.h"
#include "insonify/printable.h"
#include "survey/checks.h"
#include "survey/edge_score.h"

namespace insonify {
namespace {

// A change of range by this share of all cells from one ping to the next costs as much as the best score gains.
constexpr double kCostlyChange = 0.02;

// Pings that a decision waits for: a track is settled by those after it long before.
constexpr std::size_t kDelay = 512;

void check_track_options(const BottomTrackOptions& options) {
  constexpr double kFarthest = 1e5;
  check_field("", {"least_range", "m", from_to(0, kFarthest), ""}, options.least_range);
  check_field("", {"greatest_range", "m", above_to(options.least_range, kFarthest), ""}, options.greatest_range);
  check_field("", {"first_return_angle", "rad", above_to(0, std::numbers::pi / 2), ""}, options.first_return_angle);
}

// Moves `gain` on to the next ping: what each cell gains by the best cell before it, from which cell.
std::vector<std::uint16_t> spread_gains(std::vector<double>& gain, double cost) {
  std::vector<std::uint16_t> from(gain.size());
  std::iota(from.begin(), from.end(), std::uint16_t{0});
  const auto take = [&](std::size_t to, std::size_t source) {
    if (gain[source] - cost > gain[to]) {
      gain[to] = gain[source] - cost;
      from[to] = from[source];
    }
  };
  for (std::size_t cell = 1; cell < gain.size(); ++cell) {
    take(cell, cell - 1);
  }
  for (std::size_t cell = gain.size() - 1; cell > 0; --cell) {
    take(cell - 1, cell);
  }
  return from;
}

// Running medians of five pings, of each side alone: a wrong range of a single ping goes, a slope stays.
std::vector<double> medians_along(const std::vector<double>& ranges, std::size_t sides) {
  constexpr std::size_t kReach = 2;
  std::vector<double> medians(ranges.size()), near;
  const std::size_t pings = ranges.size() / sides;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const std::size_t ping = i / sides, reach = std::min({kReach, ping, pings - 1 - ping});
    near.clear();
    for (std::size_t other = ping - reach; other <= ping + reach; ++other) {
      near.push_back(ranges[other * sides + i % sides]);
    }
    std::ranges::nth_element(near, near.begin() + static_cast<std::ptrdiff_t>(reach));
    medians[i] = near[reach];
  }
  return medians;
}

}  // namespace

struct BottomTracker::State {
  // A ping whose range is not decided yet.
  struct Waiting {
    std::vector<std::vector<float>> levels, scores;  // [beam][cell]
    std::vector<int> leads;                          // [beam] First cell of the water column.
    std::vector<std::uint16_t> from;                 // [cell] The cell of the ping before on the best way here.
    double cosine = 1;                               // plane_cosine() of its pose.
  };

  State(const SonarConfig& given, const BottomTrackOptions& how)
      : sonar(given), options(how), cells(given), gain(static_cast<std::size_t>(cells.count), 0.0) {
    const auto cell_at = [this](double range) {
      return static_cast<int>(std::clamp((range - cells.first) / cells.length, 0.0, cells.count - 1.0));
    };
    lead = cell_at(std::max({options.least_range, sonar.dead_range, sonar.blanking_range}));
    last = cell_at(options.greatest_range);
  }

  // Decides the oldest waiting pings, all but `kept`.
  void decide(std::size_t kept) {
    std::vector<int> path(waiting.size());
    int cell = static_cast<int>(std::ranges::max_element(gain) - gain.begin());
    for (std::size_t ping = waiting.size(); ping-- > 0;) {
      path[ping] = cell;
      cell = waiting[ping].from[cell];
    }
    for (const int decided : std::span(path).first(waiting.size() - kept)) {
      append(waiting.front(), decided);
      waiting.pop_front();
    }
  }

  void append(const Waiting& ping, int cell) {
    double quality = 0;
    for (std::size_t beam = 0; beam < ping.levels.size(); ++beam) {
      track.side_range.push_back(cells.edge(foot_of_edge(ping.levels[beam], cells, ping.leads[beam], cell)));
      quality += double{ping.scores[beam][cell]};
    }
    track.quality.push_back(quality / static_cast<double>(ping.levels.size()));
    cosines.push_back(ping.cosine);
  }

  // Fills in what follows from the ranges of the sides, once those are smooth.
  void complete() {
    const auto sides = static_cast<std::size_t>(sonar.beam_count);
    track.side_range = medians_along(track.side_range, sides);
    for (std::size_t ping = 0; ping < cosines.size(); ++ping) {
      const auto first = track.side_range.begin() + static_cast<std::ptrdiff_t>(ping * sides);
      const double range = std::accumulate(first, first + sonar.beam_count, 0.0) / sonar.beam_count;
      track.range.push_back(range);
      track.altitude.push_back(range * std::sin(options.first_return_angle) * cosines[ping]);
    }
  }

  SonarConfig sonar;
  BottomTrackOptions options;
  RangeCells cells;
  int lead = 0, last = 0;    // First and last cell of the search.
  std::vector<double> gain;  // [cell] Sum of scores of the best track that ends there.
  std::deque<Waiting> waiting;
  std::vector<double> cosines;  // [ping]
  BottomTrack track;
};

BottomTracker::BottomTracker(const SonarConfig& sonar, const BottomTrackOptions& options) {
  check_side_looking(sonar);
  check_track_options(options);
  state_ = std::make_unique<State>(sonar, options);
}
BottomTracker::~BottomTracker() = default;
BottomTracker::BottomTracker(BottomTracker&&) noexcept = default;
BottomTracker& BottomTracker::operator=(BottomTracker&&) noexcept = default;

void BottomTracker::add(const Ping& ping) {
  State& state = *state_;
  check_line_ping(ping, state.sonar);
  State::Waiting now{
      .levels = {}, .scores = {}, .leads = {}, .from = {}, .cosine = plane_cosine(ping.world_from_sonar)};
  now.from = spread_gains(state.gain, 1 / (kCostlyChange * state.cells.count));
  for (int beam = 0; beam < ping.beam_count; ++beam) {
    now.levels.push_back(levels_of(ping, beam, state.cells));
    now.leads.push_back(std::max(state.lead, end_of_blanking(ping, beam, state.cells, now.levels.back())));
    now.scores.push_back(edge_scores(now.levels.back(), state.cells, now.leads.back()));
    std::fill(now.scores.back().begin() + state.last + 1, now.scores.back().end(), 0.0F);
    for (std::size_t cell = 0; cell < state.gain.size(); ++cell) {
      state.gain[cell] += double{now.scores.back()[cell]} / ping.beam_count;
    }
  }
  // Only differences count: the sum over a long line would lose them.
  const double best = *std::ranges::max_element(state.gain);
  std::ranges::for_each(state.gain, [best](double& gain) { gain -= best; });
  state.waiting.push_back(std::move(now));
  if (state.waiting.size() >= 2 * kDelay) {
    state.decide(kDelay);
  }
}

BottomTrack BottomTracker::finish() {
  if (state_->waiting.empty()) {
    throw Error(fmt::format("{}: a track of the bottom must have at least one ping", state_->sonar.name));
  }
  state_->decide(0);
  state_->complete();
  return std::move(state_->track);
}

BottomTrack track_bottom(std::span<const Ping> pings, const SonarConfig& sonar, const BottomTrackOptions& options) {
  BottomTracker tracker(sonar, options);
  std::ranges::for_each(pings, [&](const Ping& ping) { tracker.add(ping); });
  return tracker.finish();
}

std::optional<double> altitude_by_truth(const Ping& ping, const SonarConfig& sonar) {
  check_line_ping(ping, sonar);
  constexpr double kSine = 0.5;  // Sine of 30 degrees.
  std::optional<double> least;
  for (int beam = 0; beam < ping.beam_count && !ping.elevation.empty(); ++beam) {
    for (int bin = 0; bin < ping.bin_count; ++bin) {
      const double range = sonar.bin_range(bin), elevation = double{ping.elevation[ping.index(bin, beam)]};
      const Vec3 way = point_from_spherical({range, sonar.beam_azimuth(beam), elevation});
      const double below = -(ping.world_from_sonar.orientation * way).z();
      if (below > kSine * range) {  // False for NaN.
        least = std::min(below, least.value_or(below));
        break;
      }
    }
  }
  return least;
}

double true_altitude(const Ping& ping, const SonarConfig& sonar) {
  check_line_ping(ping, sonar);
  if (ping.elevation.empty()) {
    throw Error(
        fmt::format("ping {} of {} has no elevations; ground_truth: labels adds them", ping.number, sonar.name));
  }
  const std::optional<double> altitude = altitude_by_truth(ping, sonar);
  if (!altitude) {
    throw Error(fmt::format("ping {} of {}: no echo of it is from below", ping.number, sonar.name));
  }
  return *altitude;
}

}  // namespace insonify
