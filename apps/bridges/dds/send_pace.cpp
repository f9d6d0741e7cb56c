// send_pace.cpp -- a leaky bucket: bytes drain at a constant rate.

#include "dds/send_pace.h"

#include <algorithm>
#include <thread>

namespace insonify {

void SendPace::wait(std::size_t size) {
  const auto drain = [this] {
    const Clock::time_point now = Clock::now();
    const double passed = std::chrono::duration<double>(now - at_).count();
    pending_ = std::max(0.0, pending_ - passed * rate_);
    at_ = now;
  };
  drain();
  const auto bytes = static_cast<double>(size);
  const double excess = std::min(pending_, pending_ + bytes - kBurst);  // A single fragment may exceed a burst.
  if (excess > 0) {
    std::this_thread::sleep_for(std::chrono::duration<double>(excess / rate_));
    drain();
  }
  pending_ += bytes;
}

}  // namespace insonify
