// ros_inputs.h -- reads poses and time from ROS 1.

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
  std::string odometry = {};     ///< Topic; "": none.
  std::string tf = {};           ///< Frame of the vehicle; "": none.
  std::string ping_at = {};      ///< Topic of poses with a ping each; "": none.
  std::string world_frame = {};  ///< Frame in which the vehicle's pose is looked up.
  bool clock = false;            ///< Whether time comes from /clock.
};

/// @param has_clock  Whether time comes from /clock, which may be 0; else a pose without a stamp counts as current.
[[nodiscard]] LiveDrive drive_of(const RosPlace& place, bool has_clock);

/// Passes messages to a LiveLoop, in a thread of its own.
class RosInputs {
 public:
  /// @param loop  Must live until end(); driven if poses are read, clocked if the clock is.
  RosInputs(const RosInputOptions& options, LiveLoop& loop);
  ~RosInputs() { end(); }
  RosInputs(const RosInputs&) = delete;
  RosInputs& operator=(const RosInputs&) = delete;

  void start();
  void end();

 private:
  using Clock = std::chrono::steady_clock;

  // A topic that needs a publisher.
  struct Missed {
    ros::Subscriber subscriber;
    std::string type;
    bool seen = false;      // Whether there was a publisher at any time.
    bool reported = false;  // Whether the missing publisher was reported.
  };

  void take_pose(const RosPlace& place);
  void take_time(double time);
  void drive(const RosPlace& place);
  void look_for_publishers();

  RosInputOptions options_;
  LiveLoop& loop_;
  ros::NodeHandle node_;
  std::vector<Missed> missed_;
  ros::Subscriber asked_;
  std::unique_ptr<RosFrames> frames_;
  ros::WallTimer look_;
  ros::AsyncSpinner spinner_{1};
  Clock::time_point begin_ = Clock::now();

  // Used by the callback thread only.
  bool warned_of_frame_ = false, warned_of_dead_end_ = false;
  std::string refusal_;  // Why the last pose was rejected; "" if it was not.
};

}  // namespace insonify
