// ros_frames.h -- where tf has a vehicle. As ros_topics.h, for C++17 and C++20.

#pragma once

#include <ros/subscriber.h>

#include <functional>
#include <memory>
#include <string>

#include "ros1/ros_topics.h"

namespace insonify {

/// Reads /tf and /tf_static.
class RosFrames {
 public:
  /// @param take  Called whenever there is a newer time at which all transforms from the world to the vehicle are
  ///              known, in a thread of the node's callback queue.
  RosFrames(ros::NodeHandle& node, const std::string& world, const std::string& vehicle,
            std::function<void(const RosPlace&)> take);
  ~RosFrames();
  RosFrames(const RosFrames&) = delete;
  RosFrames& operator=(const RosFrames&) = delete;

  /// The subscriber to /tf.
  [[nodiscard]] const ros::Subscriber& subscriber() const;

  // The rest must be called from that thread.

  /// Tells the simulated time. Where it is set back, all but the static transforms are forgotten. Transforms that are
  /// later by more than 2 s do not count.
  void take_time(double now);
  /// The highest frame above the vehicle's while they do not lead to the world; "" where there is no such frame, and
  /// where all is well.
  [[nodiscard]] std::string dead_end() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace insonify
