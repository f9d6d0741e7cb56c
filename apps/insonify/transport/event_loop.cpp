// event_loop.cpp -- polls for a request to stop, and prints the report at SIGUSR1.

#include "transport/event_loop.h"

#include <csignal>

#include "console/console.h"
#include "console/stop.h"
#include "insonify/interrupted.h"

namespace insonify {

using boost::system::error_code;

EventLoop::EventLoop(const TransportReport& report) : report_(report) {
  report_signal_.add(SIGUSR1);
}

void EventLoop::run() {
  watch_stop();
  watch_report();
  try {
    context_.run();
  } catch (const Interrupted&) {
    // SIGINT during a ping.
  }
}

void EventLoop::watch_stop() {
  constexpr std::chrono::milliseconds kInterval{50};
  stop_timer_.expires_after(kInterval);
  stop_timer_.async_wait([this](error_code) { stop_asked() ? context_.stop() : watch_stop(); });
}

void EventLoop::watch_report() {
  report_signal_.async_wait([this](error_code failure, int) {
    if (!failure) {
      say("{}\n", report_.text());
      flush_output();
      watch_report();
    }
  });
}

}  // namespace insonify
