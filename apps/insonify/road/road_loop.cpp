// road_loop.cpp -- looks for requests to end, and prints the report when asked.

#include "road/road_loop.h"

#include <csignal>

#include "console/console.h"
#include "console/stop.h"
#include "insonify/interrupted.h"

namespace insonify {

using boost::system::error_code;

RoadLoop::RoadLoop(const RoadReport& report) : report_(report) {
  report_signal_.add(SIGUSR1);
}

void RoadLoop::run() {
  watch_stop();
  watch_report();
  try {
    context_.run();
  } catch (const Interrupted&) {
    // SIGINT during a ping.
  }
}

void RoadLoop::watch_stop() {
  constexpr std::chrono::milliseconds kInterval{50};
  stop_timer_.expires_after(kInterval);
  stop_timer_.async_wait([this](error_code) { stop_asked() ? context_.stop() : watch_stop(); });
}

void RoadLoop::watch_report() {
  report_signal_.async_wait([this](error_code failure, int) {
    if (!failure) {
      say("{}\n", report_.text());
      flush_output();
      watch_report();
    }
  });
}

}  // namespace insonify
