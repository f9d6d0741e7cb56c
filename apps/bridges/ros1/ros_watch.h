// ros_watch.h -- keeps a node registered with roscore, also after roscore restarts.

#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "ros1/ros_master.h"

namespace insonify {

/// Checks twice a second, in a thread of its own, whether roscore is still the same process and knows this node. A
/// restarted roscore knows none of the node's topics and services, or only the last ones; after `rosnode cleanup` one
/// that runs on may know none. Then all are registered again. Connections to other nodes stay open.
class RosWatch {
 public:
  /// @param pid       Process id of the roscore that ran before the first topic.
  /// @param services  Names of the node's services.
  /// @param on_end    Called when ROS shuts this node down: by `rosnode kill`, or because another node took its name.
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
