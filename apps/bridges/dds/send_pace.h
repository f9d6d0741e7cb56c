// send_pace.h -- spreads large messages over time, so that readers with small socket buffers do not lose fragments.

#pragma once

#include <chrono>
#include <cstddef>

namespace insonify {

/// Limits how fast fragments are sent: kBurst bytes at once, then at kRate. A Linux socket buffers some 200 kB by
/// default (net.core.rmem_default) and drops what arrives while it is full. A best-effort reader loses a whole message
/// with one fragment.
class SendPace {
 public:
  using Clock = std::chrono::steady_clock;

  static constexpr double kBurst = 130'000;  ///< Two fragments [byte].
  static constexpr double kRate = 100e6;     ///< [byte/s], about that of an Ethernet of 1 Gbit/s.

  /// @param rate  [byte/s], > 0.
  explicit SendPace(double rate = kRate) : rate_(rate) {}

  /// Waits until a fragment may be sent, and counts it.
  /// @param size  [byte]
  void wait(std::size_t size);

 private:
  double rate_;
  double pending_ = 0;                   // Bytes that readers may not have read yet ...
  Clock::time_point at_ = Clock::now();  // ... at this time.
};

}  // namespace insonify
