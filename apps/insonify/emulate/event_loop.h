// event_loop.h -- the event loop of emulated instruments.

#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>

#include "transport/transport_report.h"

namespace insonify {

class EventLoop {
 public:
  /// @param report  Printed at SIGUSR1; must live as long as the loop.
  explicit EventLoop(const TransportReport& report) : report_(report) {}

  [[nodiscard]] boost::asio::io_context& context() { return context_; }

  /// Runs until SIGINT or SIGTERM, also while a ping is made.
  void run();

 private:
  void watch_signals();

  const TransportReport& report_;
  boost::asio::io_context context_{1};
  boost::asio::steady_timer timer_{context_};
};

}  // namespace insonify
