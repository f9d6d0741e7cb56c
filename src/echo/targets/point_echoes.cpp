// point_echoes.cpp -- target strength, spreading, absorption and phase of points.

#include "echo/targets/point_echoes.h"

#include <cmath>

#include "base/philox.h"

namespace insonify {
namespace {

std::vector<Vec3> places_of(std::span<const PointTarget> points) {
  std::vector<Vec3> places;
  for (const PointTarget& point : points) {
    places.push_back(point.position);
  }
  return places;
}

}  // namespace

double own_phase(const FlatPlan& plan, std::size_t point) {
  const PhiloxCounter counter = {static_cast<std::uint32_t>(point), 0, 0,
                                 static_cast<std::uint32_t>(RandomPurpose::kPointPhase)};
  return double{uniform_open(philox(counter, philox_key(plan.seed))[0])};
}

void add_discrete_echo(const FlatPlan& plan, const FlatPlan::Arrival& arrival, int order, double range,
                       double intensity, double turns, EchoList& echoes) {
  const int bin = plan.bin_of(static_cast<float>(range));
  if (bin >= 0) {
    echoes.discrete.push_back({.beam = plan.beam_of(arrival.bearing),
                               .bin = bin,
                               .order = order,
                               .bearing_sine = std::sin(arrival.bearing),
                               .intensity = static_cast<float>(intensity),
                               .turns = static_cast<float>(turns - std::floor(turns))});
  }
}

PointEchoes::PointEchoes(std::span<const PointTarget> points) : points_(points), lines_(places_of(points)) {}

void PointEchoes::ask(const PingView& view, Workers&, RayList& rays) {
  lines_.ask(view, rays);
}

void PointEchoes::answer(const PingView& view, const RayAnswers& hits, Workers&, RayList&, EchoList& found) {
  if (hits.sights.empty()) {
    return;
  }
  const FlatPlan& plan = *view.plan;
  const auto sights = lines_.look(view, hits);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (!sights[i]) {
      continue;
    }
    const double range = sights[i]->range;
    const double intensity = std::pow(10.0, points_[i].target_strength_db / 10) / std::pow(range, 4) *
                             std::exp(-4 * double{plan.neper_per_metre} * range) * sights[i]->arrival.both_ways() *
                             sights[i]->passed * sights[i]->passed;
    const double turns = plan.turns_per_metre * range + own_phase(plan, i);
    // A point has no extent: it casts no shadow and labels no cell.
    add_discrete_echo(plan, sights[i]->arrival, 1, range, intensity, turns, found);
  }
}

}  // namespace insonify
