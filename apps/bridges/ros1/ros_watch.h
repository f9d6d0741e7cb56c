// ros_watch.h -- keeps a node known to roscore, which may be started again.

#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "ros1/ros_master.h"

namespace insonify {

/// Looks twice a second, in a thread of its own, whether roscore is still the same process and knows this node. A
/// roscore that was started again knows none of the node's topics and services, or the last ones alone: then all are
/// told to it. Connections to other nodes stay as they are.
class RosWatch {
 public:
  /// @param pid       Of the roscore that was there before the first topic.
  /// @param services  Names of services that are served.
  /// @param on_end    Called when ROS ends this node: by `rosnode kill`, or since another one has taken its name.
  RosWatch(RosMaster master, int pid, std::vector<std::string> services, std::function<void()> on_end);
  ~RosWatch() { end(); }
  RosWatch(const RosWatch&) = delete;
  RosWatch& operator=(const RosWatch&) = delete;

  void end();

 private:
  void look();
  void register_again() const;

  RosMaster master_;
  int pid_;
  std::vector<std::string> services_;
  std::string own_uri_, own_services_uri_;
  std::function<void()> on_end_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace insonify
