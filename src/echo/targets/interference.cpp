// interference.cpp -- arrival times of pulses, and the bins that receive them.

#include "echo/targets/interference.h"

#include <algorithm>
#include <cmath>

#include "base/philox.h"

namespace insonify {
namespace {

constexpr int kNoEcho = 0;  // DiscreteEcho::order of a pulse.

std::vector<Vec3> places_of(std::span<const Interferer> interferers) {
  std::vector<Vec3> places;
  for (const Interferer& interferer : interferers) {
    places.push_back(interferer.position);
  }
  return places;
}

// Phase in one bin. It is independent from bin to bin, because the pulse is not coherent with this sonar.
float phase_of(const FlatPlan& plan, std::uint32_t source, std::int64_t pulse, int bin) {
  const PhiloxCounter counter = {source, static_cast<std::uint32_t>(pulse), static_cast<std::uint32_t>(bin),
                                 static_cast<std::uint32_t>(RandomPurpose::kInterference)};
  return uniform_open(philox(counter, philox_key(plan.seed))[0]);
}

// Intensity on arrival, after a one-way transmission loss of 20 log10 r + alpha r.
double intensity_of(const FlatPlan& plan, const Interferer& other, const LinesOfSight::Sight& sight) {
  return std::pow(10.0, (other.source_level_db - plan.source_level_db) / 10) / (sight.range * sight.range) *
         std::exp(-2 * double{plan.neper_per_metre} * sight.range) * double{sight.arrival.received} * sight.passed;
}

// The bin that receives at a time after transmission [s]; -1 before the range window, bin_count after it.
int bin_after(const FlatPlan& plan, double time, double sound_speed) {
  const double position = (0.5 * sound_speed * time - double{plan.first_bin_at}) * double{plan.bins_per_metre};
  return static_cast<int>(std::floor(std::clamp(position, -1.0, static_cast<double>(plan.bin_count))));
}

double sound_speed_of(const FlatPlan& plan) {
  return 2 * plan.frequency / plan.turns_per_metre;
}

}  // namespace

void add_pulse(const FlatPlan& plan, const ArrivingPulse& pulse, EchoList& echoes) {
  const double sound_speed = sound_speed_of(plan);
  const int first = std::max(0, bin_after(plan, pulse.begins, sound_speed));
  const int last = std::min(bin_after(plan, pulse.begins + pulse.duration, sound_speed), plan.bin_count - 1);
  for (int bin = first; bin <= last; ++bin) {
    echoes.discrete.push_back({.beam = pulse.beam,
                               .bin = bin,
                               .order = kNoEcho,
                               .bearing_sine = pulse.bearing_sine,
                               .intensity = pulse.intensity,
                               .turns = phase_of(plan, pulse.source, pulse.number, bin)});
  }
}

Interference::Interference(std::span<const Interferer> interferers, bool has_array)
    : interferers_(interferers), has_array_(has_array), lines_(places_of(interferers)) {}

void Interference::ask(const PingView& view, Workers&, RayList& rays) {
  lines_.ask(view, rays);
}

void Interference::answer(const PingView& view, const RayAnswers& hits, Workers&, RayList&, EchoList& found) {
  if (hits.sights.empty()) {
    return;
  }
  const auto sights = lines_.listen(view, has_array_, hits);
  for (std::size_t i = 0; i < interferers_.size(); ++i) {
    if (sights[i]) {
      add_pulses(*view.plan, i, *sights[i], view.time, found);
    }
  }
}

// Adds the pulses that overlap the time in which the ping is received.
void Interference::add_pulses(const FlatPlan& plan, std::size_t index, const LinesOfSight::Sight& sight, double time,
                              EchoList& found) {
  const Interferer& other = interferers_[index];
  const double sound_speed = sound_speed_of(plan);
  const double listening = 2 * double{plan.true_max_range} / sound_speed;
  const double first_arrival = other.first_pulse + sight.range / sound_speed - time;  // After transmission.
  const auto intensity = static_cast<float>(intensity_of(plan, other, sight));
  auto pulse = static_cast<std::int64_t>(std::ceil(-(first_arrival + other.duration) / other.period));
  for (;; ++pulse) {
    const double begins = first_arrival + static_cast<double>(pulse) * other.period;
    if (begins >= listening) {
      return;
    }
    add_pulse(plan,
              {.beam = sight.beam,
               .bearing_sine = std::sin(sight.arrival.bearing),
               .intensity = intensity,
               .begins = begins,
               .duration = other.duration,
               .source = static_cast<std::uint32_t>(index),
               .number = pulse},
              found);
  }
}

}  // namespace insonify
