// event_loop.h -- the event loop of bridges and emulated instruments.

#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>

#include "transport/transport_report.h"

namespace insonify {

class EventLoop {
 public:
  /// @param report  Printed at SIGUSR1; must live as long as the loop.
  explicit EventLoop(const TransportReport& report);

  [[nodiscard]] boost::asio::io_context& context() { return context_; }

  /// Runs until SIGINT or SIGTERM, also while a ping is made.
  void run();

 private:
  void watch_stop();
  void watch_report();

  const TransportReport& report_;
  boost::asio::io_context context_{1};
  boost::asio::steady_timer stop_timer_{context_};
  boost::asio::signal_set report_signal_{context_};
};

}  // namespace insonify
