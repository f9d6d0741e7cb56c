// event_loop.cpp -- polls for a request to stop, and for one to print the report.

#include "emulate/event_loop.h"

#include "console/console.h"
#include "console/stop.h"
#include "insonify/interrupted.h"

namespace insonify {

void EventLoop::run() {
  watch_signals();
  try {
    context_.run();
  } catch (const Interrupted&) {
    // SIGINT during a ping.
  }
}

void EventLoop::watch_signals() {
  if (report_asked()) {
    say("{}\n", report_.text());
    flush_output();
  }
  constexpr std::chrono::milliseconds kInterval{50};
  timer_.expires_after(kInterval);
  timer_.async_wait([this](boost::system::error_code) { stop_asked() ? context_.stop() : watch_signals(); });
}

}  // namespace insonify
