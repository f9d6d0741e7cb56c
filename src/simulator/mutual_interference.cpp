// mutual_interference.cpp -- levels and times of the pulses that sonars on one vehicle receive from each other.

#include "simulator/mutual_interference.h"

#include <algorithm>
#include <cmath>

#include "echo/model/hit.h"
#include "echo/targets/interference.h"
#include "receiver/array/line_array.h"
#include "simulator/simulated_sonar.h"

namespace insonify {
namespace {

constexpr std::uint32_t kFirstSource = 1U << 31U;  // Sources below are the scenario's interferers.

// Bandwidth of what a sonar sends [Hz]: of a chirp its own, of a tone 1 / duration.
double bandwidth_of(const SonarConfig& sonar, const PulseSettings& pulse) {
  switch (pulse.kind) {
    case PulseKind::kLfm:
      return pulse.bandwidth;
    case PulseKind::kCw:
      return 1 / pulse.duration;
    case PulseKind::kNone:
    case PulseKind::kInstrument:  // Replaced by the sonar's own.
      break;
  }
  return sonar.bandwidth;
}

bool is_top_hat_hit(const SonarConfig& sonar, double elevation) {
  return std::abs(elevation - sonar.elevation_center) <= 0.5 * sonar.sent_elevation_aperture();
}

}  // namespace

SendingSonar::SendingSonar(const SimulatedSonar& sonar, const Aperture& aperture, const ReceiverConfig& receiver)
    : sonar_(aperture.config),
      vehicle_from_housing_(sonar.vehicle_from_housing),
      housing_from_aperture_(aperture.housing_from_aperture),
      beams_(sonar_.bearings()),
      sent_axis_(aperture.plan->sent_axis),
      sent_across_(aperture.plan->sent_across),
      transmitter_(sonar_.transmit_width) {
  const PulseSettings pulse = sonar_.transmitted(receiver);
  duration_ = pulse.kind == PulseKind::kNone ? 2 * sonar_.bin_length() / *sonar_.assumed_sound_speed : pulse.duration;
  bandwidth_ = bandwidth_of(sonar_, pulse);
  if (sonar_.is_two_way() && receiver.azimuth_pattern != BeamPattern::kTopHat) {
    array_.emplace(receiving_array(receiver, sonar_));
    array_length_ = array_->length(1, beam_width(sonar_));
  }
}

double SendingSonar::share_within(const SendingSonar& other) const {
  const double low = std::max(sonar_.frequency - 0.5 * bandwidth_, other.sonar_.frequency - 0.5 * other.bandwidth_);
  const double high = std::min(sonar_.frequency + 0.5 * bandwidth_, other.sonar_.frequency + 0.5 * other.bandwidth_);
  return std::max(0.0, high - low) / bandwidth_;
}

double SendingSonar::gain(std::uint64_t ping, const Vec3& direction) const {
  const Pose vehicle_from_head =
      vehicle_from_housing_ * housing_from_head(sonar_.head_angle(ping)) * housing_from_aperture_;
  const Vec3 local = vehicle_from_head.orientation.inverse() * direction;
  const double elevation = std::atan2(local.z(), std::hypot(local.x(), local.y()));
  const bool has_pattern = !sent_across_.empty();
  if (!has_pattern && !is_top_hat_hit(sonar_, elevation)) {
    return 0;
  }
  const double across = has_pattern ? sent_axis_.look_up(sent_across_, elevation) : 1;
  const double azimuth = std::atan2(local.y(), local.x());
  const bool is_behind = !(local.x() > 0);
  if (array_) {
    const double off = std::sin(azimuth) - std::sin(sonar_.beam_azimuth(0));
    return is_behind ? 0 : across * array_->intensity(array_length_ * off);
  }
  if (!transmitter_.is_flat()) {
    return is_behind ? 0 : across * transmitter_.intensity(std::sin(azimuth));
  }
  const int beam = beams_.last_before(azimuth, 0);
  return azimuth <= beams_.port[beam] && azimuth >= beams_.starboard[beam] ? across : 0;
}

MutualInterference::MutualInterference(std::span<const SendingSonar> senders, std::string_view receiving,
                                       bool has_array)
    : senders_(senders),
      own_(static_cast<std::size_t>(std::ranges::find(senders, receiving, &SendingSonar::name) - senders.begin())),
      has_array_(has_array) {}

void MutualInterference::ask(const PingView& view, Workers&, RayList& rays) {
  near_.clear();
  const Vec3& sonar = view.world_from_sonar.position;
  for (std::size_t i = 0; i < senders_.size(); ++i) {
    if (senders_[i].name() == senders_[own_].name() || !(senders_[i].share_within(senders_[own_]) > 0)) {
      continue;
    }
    const Vec3 there = view.world_from_vehicle * senders_[i].place() - sonar;
    const double range = there.norm();
    const Vec3f direction = (view.world_from_sonar.orientation.inverse() * there / range).cast<float>();
    if (const std::optional<int> beam = beam_hearing(*view.plan, direction, has_array_)) {
      near_.push_back({i, *beam, range, direction});
      rays.sights.push_back({sonar, there / range, 0, range - double{kRayClearance}});
    }
  }
}

void MutualInterference::answer(const PingView& view, const RayAnswers& hits, Workers&, RayList&, EchoList& found) {
  const FlatPlan& plan = *view.plan;
  const double sound_speed = 2 * plan.frequency / plan.turns_per_metre;
  const double listening = 2 * double{plan.true_max_range} / sound_speed;
  for (std::size_t i = 0; i < hits.sights.size(); ++i) {
    if (!hits.is_clear(i)) {
      continue;
    }
    const auto& [index, beam, range, direction] = near_[i];
    const SendingSonar& sender = senders_[index];
    const Vec3 there = view.world_from_vehicle * sender.place() - view.world_from_sonar.position;
    const FlatPlan::Arrival arrival = plan.arrival_from(direction);
    const Vec3 towards = view.world_from_vehicle.orientation.inverse() * -there / range;
    const double arriving = std::pow(10.0, (sender.source_level_db() - plan.source_level_db) / 10) *
                            sender.share_within(senders_[own_]) * double{arrival.received} / (range * range) *
                            std::exp(-2 * double{plan.neper_per_metre} * range) * hits.passed(i);
    const double delay = range / sound_speed - view.time;  // When a pulse sent at time 0 arrives [s].
    const double earliest = std::ceil(-(delay + sender.duration()) / sender.period());
    for (auto ping = static_cast<std::uint64_t>(std::max(0.0, earliest));; ++ping) {
      const double begins = delay + static_cast<double>(ping) * sender.period();
      if (begins >= listening) {
        break;
      }
      const double intensity = arriving * sender.gain(ping, towards);
      add_pulse(plan,
                {.beam = beam,
                 .bearing_sine = std::sin(arrival.bearing),
                 .intensity = static_cast<float>(intensity),
                 .begins = begins,
                 .duration = sender.duration(),
                 .source = kFirstSource + static_cast<std::uint32_t>(index),
                 .number = static_cast<std::int64_t>(ping)},
                found);
    }
  }
}

}  // namespace insonify
