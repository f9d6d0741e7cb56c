// transport_report.cpp -- sums up rate and latency in one line.

#include "transport/transport_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "console/console.h"

namespace insonify {
namespace {

double seconds(WallClock::duration time) {
  return std::chrono::duration<double>(time).count();
}

}  // namespace

void TransportReport::note(WallClock::time_point transmitted, double computing) {
  const std::lock_guard lock(mutex_);
  last_ = WallClock::now();
  if (pings_++ == 0) {
    first_ = last_;
  }
  const double latency = seconds(last_ - transmitted);
  latency_ += latency;
  longest_ = std::max(longest_, latency);
  computing_ += computing;
}

void TransportReport::note_refusal() {
  const std::lock_guard lock(mutex_);
  ++refusals_;
}

void TransportReport::note_drop() {
  const std::lock_guard lock(mutex_);
  ++drops_;
}

std::string TransportReport::text() const {
  const std::lock_guard lock(mutex_);
  constexpr double kMilli = 1e3;
  std::string text = fmt::format("{} pings in {:.1f} s", pings_, seconds(WallClock::now() - start_));
  if (pings_ > 1) {
    text += fmt::format(" ({:.1f} Hz)", static_cast<double>(pings_ - 1) / std::max(1e-9, seconds(last_ - first_)));
  }
  if (pings_ > 0) {
    const auto count = static_cast<double>(pings_);
    text += fmt::format("; {:.1f} ms from transmission to message ({:.1f} at most), {:.1f} of them computing",
                        kMilli * latency_ / count, kMilli * longest_, kMilli * computing_ / count);
  }
  if (refusals_ > 0) {
    text += fmt::format("; {} packets refused", refusals_);
  }
  if (drops_ > 0) {
    text += fmt::format("; {} pings dropped, for they were not sent in time", drops_);
  }
  return text;
}

void report_until_stopped(const TransportReport& report, const std::atomic<bool>& ended) {
  constexpr std::chrono::milliseconds kInterval{50};
  while (!stop_asked() && !ended) {
    std::this_thread::sleep_for(kInterval);
    if (report_asked()) {
      say("{}\n", report.text());
      flush_output();
    }
  }
}

}  // namespace insonify
