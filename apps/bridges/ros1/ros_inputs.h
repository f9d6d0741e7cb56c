// ros_inputs.h -- what the node reads from ROS 1: poses and time.

#pragma once

#include <ros/node_handle.h>
#include <ros/spinner.h>
#include <ros/subscriber.h>
#include <ros/wall_timer.h>

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "insonify/live_loop.h"
#include "ros1/ros_frames.h"
#include "ros1/ros_topics.h"

namespace insonify {

struct RosInputOptions {
  std::string odometry = {};     ///< Topic; "" for none.
  std::string tf = {};           ///< Frame of the vehicle; "" for none.
  std::string world_frame = {};  ///< Its transform is looked for from this frame on.
  bool clock = false;            ///< Whether /clock tells the time.
};

/// Passes what it reads to a LiveLoop, in a thread of its own.
class RosInputs {
 public:
  /// @param loop  Must live until end(). With poses it must be driven, with the clock clocked.
  RosInputs(const RosInputOptions& options, LiveLoop& loop);
  ~RosInputs() { end(); }
  RosInputs(const RosInputs&) = delete;
  RosInputs& operator=(const RosInputs&) = delete;

  void start();
  void end();

 private:
  using Clock = std::chrono::steady_clock;

  // A topic whose publishers are missed when they are not there.
  struct Missed {
    ros::Subscriber subscriber;
    std::string type;
    bool seen = false;  // Whether there ever were publishers.
    bool told = false;  // Whether the user knows that there are none.
  };

  void take_odometry(const RosPlace& place);
  void take_time(double time);
  void drive(const RosPlace& place);
  void look_for_publishers();

  RosInputOptions options_;
  LiveLoop& loop_;
  ros::NodeHandle node_;
  std::vector<Missed> missed_;
  std::unique_ptr<RosFrames> frames_;
  ros::WallTimer look_;
  ros::AsyncSpinner spinner_{1};
  Clock::time_point begin_ = Clock::now();

  // Used by the thread of the callbacks alone.
  bool told_frame_ = false, told_dead_end_ = false;
  std::string refusal_;  // Why the last pose was no good.
};

}  // namespace insonify
