// interference.cpp -- when pulses arrive, and which bins are listening then.

#include "echo/interference.h"

#include <cmath>

#include "base/philox.h"
#include "echo/ray_limits.h"

namespace insonify {
namespace {

constexpr int kNoSurfaceMet = 0;  // As a path order.

// A pulse's phase wanders from bin to bin: it is not this sonar's.
float phase_of(const PingPlan& plan, std::size_t interferer, std::int64_t pulse, int bin) {
  const PhiloxCounter counter = {static_cast<std::uint32_t>(interferer), static_cast<std::uint32_t>(pulse),
                                 static_cast<std::uint32_t>(bin),
                                 static_cast<std::uint32_t>(RandomPurpose::kInterference)};
  return uniform_open(philox(counter, philox_key(plan.seed))[0]);
}

}  // namespace

Interference::Interference(std::span<const Interferer> interferers)
    : interferers_(interferers), rays_(interferers.size()), hits_(interferers.size()) {}

void Interference::add(const PingPlan& plan, const Pose& world_from_sonar, double time, Engine& engine,
                       EchoGrid& grid) {
  for (std::size_t i = 0; i < interferers_.size(); ++i) {
    const Vec3 there = interferers_[i].position - world_from_sonar.position;
    const double range = there.norm();
    rays_[i] = {world_from_sonar.position, range > 0 ? Vec3(there / range) : Vec3(Vec3::UnitX()), 0,
                range - double{kRayClearance}};
  }
  engine.trace(rays_, hits_);
  const Pose sonar_from_world = world_from_sonar.inverse();
  const double sound_speed = 2 * plan.sonar.frequency / plan.turns_per_metre;
  const double listening = 2 * double{plan.true_max_range} / sound_speed;
  for (std::size_t i = 0; i < interferers_.size(); ++i) {
    const Interferer& other = interferers_[i];
    const Vec3 local = sonar_from_world * other.position;
    const double range = local.norm();
    const Vec3f direction = (local / range).cast<float>();
    if (range == 0 || std::isfinite(hits_[i].distance) || !plan.hears(direction)) {
      continue;
    }
    const PingPlan::Arrival arrival = plan.arrival_from(direction);
    const double intensity = std::pow(10.0, (other.source_level_db - plan.sonar.source_level_db) / 10) /
                             (range * range) * std::exp(-2 * double{plan.neper_per_metre} * range) *
                             double{arrival.heard};
    const int beam = plan.beam_of(arrival.bearing);
    // Pulses that arrive before the listening is over and end after it has begun.
    const double way = range / sound_speed;
    const auto first =
        static_cast<std::int64_t>(std::ceil((time - way - other.duration - other.first_pulse) / other.period));
    for (std::int64_t pulse = first;
         other.first_pulse + static_cast<double>(pulse) * other.period + way < time + listening; ++pulse) {
      const double begins = other.first_pulse + static_cast<double>(pulse) * other.period + way - time;
      const auto bin_at = [&](double after) {
        const double position = (0.5 * sound_speed * after - double{plan.first_bin_at}) * double{plan.bins_per_metre};
        return static_cast<int>(std::floor(std::clamp(position, -1.0, double(plan.sonar.bin_count))));
      };
      for (int bin = std::max(0, bin_at(begins));
           bin <= std::min(bin_at(begins + other.duration), plan.sonar.bin_count - 1); ++bin) {
        grid.lone_echoes().push_back({.beam = beam,
                                      .bin = bin,
                                      .order = kNoSurfaceMet,
                                      .bearing_sine = std::sin(arrival.bearing),
                                      .intensity = static_cast<float>(intensity),
                                      .turns = phase_of(plan, i, pulse, bin)});
      }
    }
  }
}

}  // namespace insonify
