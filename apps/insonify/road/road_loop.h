// road_loop.h -- runs the tasks of what stands for a sonar to other programs, until it is asked to end.

#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>

#include "road/road_report.h"

namespace insonify {

class RoadLoop {
 public:
  /// @param report  Printed at SIGUSR1; must live as long as the loop.
  explicit RoadLoop(const RoadReport& report);

  [[nodiscard]] boost::asio::io_context& context() { return context_; }

  /// Runs until SIGINT or SIGTERM, also while a ping is made.
  void run();

 private:
  void watch_stop();
  void watch_report();

  const RoadReport& report_;
  boost::asio::io_context context_{1};
  boost::asio::steady_timer stop_timer_{context_};
  boost::asio::signal_set report_signal_{context_};
};

}  // namespace insonify
