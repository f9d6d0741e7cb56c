// flight_poses.cpp -- the poses of a vehicle that flies a survey, unsteadily, as few as interpolation needs.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "pattern/random_motion.h"
#include "pattern/survey_flight.h"

namespace insonify {
namespace {

// Position and angles of a pose.
using PoseNumbers = std::array<double, 6>;

constexpr double kPlaceTolerance = 0.5e-3;                       // [m]; as much again is for the sampling.
constexpr double kAngleTolerance = radians_from_degrees(0.005);  // [rad]
constexpr PoseNumbers kTolerances = {kPlaceTolerance, kPlaceTolerance, kPlaceTolerance,
                                     kAngleTolerance, kAngleTolerance, kAngleTolerance};

// Keeps those of a series of poses between which all others lie on straight lines within the tolerances: from the last
// one kept, each later pose bounds the slopes that pass near it.
class PoseThinner {
 public:
  void add(double time, const PoseNumbers& numbers) {
    if (kept_.empty()) {
      keep(time, numbers);
    } else if (!reaches(time, numbers)) {
      keep(last_time_, last_);
    }
    if (time > kept_time_) {
      bound(time, numbers);
    }
    last_time_ = time;
    last_ = numbers;
  }

  std::vector<FlightPose> finish() {
    if (last_time_ > kept_time_) {
      keep(last_time_, last_);
    }
    return std::move(kept_);
  }

 private:
  void keep(double time, const PoseNumbers& numbers) {
    kept_.push_back({time, Vec3(numbers[0], numbers[1], numbers[2]), Vec3(numbers[3], numbers[4], numbers[5])});
    kept_time_ = time;
    from_ = numbers;
    least_.fill(-std::numeric_limits<double>::infinity());
    most_.fill(std::numeric_limits<double>::infinity());
  }

  [[nodiscard]] bool reaches(double time, const PoseNumbers& numbers) const {
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const double slope = (numbers[i] - from_[i]) / (time - kept_time_);
      if (slope < least_[i] || slope > most_[i]) {
        return false;
      }
    }
    return true;
  }

  void bound(double time, const PoseNumbers& numbers) {
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const double change = numbers[i] - from_[i], span = time - kept_time_;
      least_[i] = std::max(least_[i], (change - kTolerances[i]) / span);
      most_[i] = std::min(most_[i], (change + kTolerances[i]) / span);
    }
  }

  std::vector<FlightPose> kept_;
  double kept_time_ = 0, last_time_ = 0;
  PoseNumbers from_{}, last_{}, least_{}, most_{};
};

// Motions in the five directions, [direction][sample]; empty for none.
std::array<std::vector<double>, 5> motions_of(const SurveyPattern& pattern, std::size_t count, double step,
                                              std::uint64_t seed) {
  std::array<std::vector<double>, 5> motions;
  if (const auto& noise = pattern.motion_noise) {
    const double period = noise->period.value_or(usual_period(noise->spectrum));
    const std::uint64_t own = noise->seed ? static_cast<std::uint64_t>(*noise->seed) : seed;
    const std::array<double, 5> rms = {noise->roll, noise->pitch, noise->yaw, noise->sway, noise->heave};
    for (std::uint32_t i = 0; i < rms.size(); ++i) {
      if (rms[i] > 0) {
        motions[i] = RandomMotion(noise->spectrum, period, rms[i], own, i).series(count, step);
      }
    }
  }
  return motions;
}

}  // namespace

std::vector<FlightPose> flight_poses(const SurveyFlight& flight, const SurveyPattern& pattern, std::uint64_t seed) {
  const std::size_t count = flight.heights.size();
  const double time_step = flight.step / flight.speed;
  const auto motions = motions_of(pattern, count, time_step, seed);
  const auto motion = [&](std::size_t direction, std::size_t i) {
    return motions[direction].empty() ? 0 : motions[direction][i];
  };
  PoseThinner poses;
  for (std::size_t i = 0; i < count; ++i) {
    const SurveyPath::Station at = flight.path.at(static_cast<double>(i) * flight.step);
    const std::size_t before = i > 0 ? i - 1 : 0, after = std::min(i + 1, count - 1);
    const double climb = std::atan((flight.heights[after] - flight.heights[before]) /
                                   (static_cast<double>(after - before) * flight.step));
    const double pitch = pattern.lines.pitch == PitchControl::kFollow ? -climb : 0;  // Positive pitch looks down.
    const double sway = motion(3, i);
    poses.add(static_cast<double>(i) * time_step,
              {at.x - sway * std::sin(at.yaw), at.y + sway * std::cos(at.yaw), flight.heights[i] + motion(4, i),
               motion(0, i), pitch + motion(1, i), at.yaw + motion(2, i)});
  }
  return poses.finish();
}

}  // namespace insonify
