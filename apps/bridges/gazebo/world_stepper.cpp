// world_stepper.cpp -- measures a world's step, and counts those to the next ping.

#include "gazebo/world_stepper.h"

#include <algorithm>
#include <cmath>

namespace insonify {

// From the stamps before and after a single step.
void WorldStepper::measure(double stamp) {
  constexpr double kSame = 1e-6;  // Of doubles that are Unix times; steps have at least a microsecond [s].
  const double length = stamp - *from_;
  if (last_length_ && std::abs(length - *last_length_) < kSame) {
    length_ = length;
  }
  last_length_ = length;
}

unsigned WorldStepper::steps(double stamp, std::optional<double> awaited, Clock::time_point now) {
  constexpr std::chrono::seconds kPatience{2};  // Until poses are taken for lost.
  constexpr double kMost = 1e6;
  if (!awaited) {
    return 0;
  }
  if (from_ && stamp < *from_) {  // Time was set back.
    from_.reset();
  }
  const bool have_come = !from_ || (length_ ? stamp > until_ - *length_ / 2 : stamp > *from_);
  if (!have_come && now - asked_at_ < kPatience) {
    return 0;
  }
  if (have_come && from_ && !length_) {
    measure(stamp);
  }
  constexpr double kRounding = 1e-3;  // Of quotients of times [steps].
  const double count = length_ ? std::clamp(std::ceil((*awaited - stamp) / *length_ - kRounding), 1.0, kMost) : 1;
  from_ = stamp;
  until_ = stamp + count * length_.value_or(0);
  asked_at_ = now;
  return static_cast<unsigned>(count);
}

}  // namespace insonify
