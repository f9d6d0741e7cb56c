// ros_frames.h -- the pose of a vehicle in tf. For C++17 and C++20, as ros_topics.h.

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
  /// @param take  Called for each newer time at which all transforms from world to vehicle are known, in a thread of
  /// the node's callback queue.
  RosFrames(ros::NodeHandle& node, const std::string& world, const std::string& vehicle,
            std::function<void(const RosPlace&)> take);
  ~RosFrames();
  RosFrames(const RosFrames&) = delete;
  RosFrames& operator=(const RosFrames&) = delete;

  /// The subscriber to /tf.
  [[nodiscard]] const ros::Subscriber& subscriber() const;

  // The functions below must be called from that thread.

  /// Sets the simulated time. Going back discards all but the static transforms. Transforms more than 2 s ahead are
  /// ignored.
  void take_time(double now);
  /// The topmost frame above the vehicle's if it is not connected to the world; "" if there is none, or if it is
  /// connected.
  [[nodiscard]] std::string dead_end() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace insonify
