// ros_inputs.cpp -- reads poses from nav_msgs/Odometry or tf, and time from /clock.

#include "ros1/ros_inputs.h"

#include <fmt/format.h>

#include <cmath>

#include "console/console.h"
#include "insonify/error.h"
#include "insonify/printable.h"

namespace insonify {
namespace {

// The norm drifts in programs that store orientations in single precision or accumulate small rotations; such small
// drift is accepted.
Eigen::Quaterniond without_drift(const Eigen::Quaterniond& given) {
  constexpr double kDrift = 0.01;
  return std::abs(given.norm() - 1) < kDrift ? given.normalized() : given;
}

double unix_time() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

}  // namespace

LiveDrive drive_of(const RosPlace& place, bool has_clock) {
  const Pose pose{place.position, without_drift(place.orientation)};
  return {.world_from_vehicle = pose,
          .twist = {pose.orientation * place.linear, pose.orientation * place.angular},
          .stamp = place.stamp != 0 || has_clock ? place.stamp : unix_time()};
}

RosInputs::RosInputs(const RosInputOptions& options, LiveLoop& loop) : options_(options), loop_(loop) {
  options_.world_frame = bare_frame(options_.world_frame);
}

void RosInputs::start() {
  const auto take = [this](const RosPlace& place) { take_pose(place); };
  const auto drive_to = [this](const RosPlace& place) { drive(place); };
  if (!options_.odometry.empty()) {
    missed_.push_back({subscribe_odometry(node_, options_.odometry, take), "nav_msgs/Odometry"});
  }
  if (!options_.ping_at.empty()) {  // Whoever asks may come and go.
    asked_ = subscribe_poses(node_, options_.ping_at, take);
  }
  if (!options_.tf.empty()) {
    frames_ = std::make_unique<RosFrames>(node_, options_.world_frame, options_.tf, drive_to);
    missed_.push_back({frames_->subscriber(), "tf2_msgs/TFMessage"});
  }
  if (options_.clock) {
    missed_.push_back(
        {subscribe_clock(node_, "/clock", [this](double time) { take_time(time); }), "rosgraph_msgs/Clock"});
  }
  look_ = node_.createWallTimer(ros::WallDuration(0.5), [this](const ros::WallTimerEvent&) { look_for_publishers(); });
  begin_ = Clock::now();
  spinner_.start();
}

void RosInputs::end() {
  spinner_.stop();
}

void RosInputs::take_pose(const RosPlace& place) {
  if (!place.frame.empty() && place.frame != options_.world_frame && !warned_of_frame_) {
    complain(
        fmt::format("{}: its poses are in the frame {}; they are taken for poses in the world's, {} "
                    "(--world-frame {} names it so)",
                    options_.odometry + options_.ping_at, printable(place.frame), printable(options_.world_frame),
                    printable(place.frame)));
    warned_of_frame_ = true;
  }
  drive(place);
}

void RosInputs::take_time(double time) {
  if (frames_) {
    frames_->take_time(time);
  }
  loop_.advance(time);
}

void RosInputs::drive(const RosPlace& place) {
  std::string refusal;
  try {
    loop_.drive(drive_of(place, options_.clock));
  } catch (const Error& error) {
    refusal = fmt::format("{}: {}", frames_ ? "/tf" : options_.odometry + options_.ping_at, error.what());
  }
  if (!refusal.empty() && refusal_.empty()) {  // Once, not for every message.
    complain(refusal);
  }
  refusal_ = refusal;
}

// Reports topics without a publisher, once discovery has had time to complete, and publishers that appear later.
void RosInputs::look_for_publishers() {
  const bool patient = Clock::now() - begin_ < std::chrono::seconds(3);
  for (Missed& each : missed_) {
    const bool there = each.subscriber.getNumPublishers() > 0;
    if (!there && !each.reported && (each.seen || !patient)) {
      complain(fmt::format("{}: nobody publishes {} to it{}", each.subscriber.getTopic(), each.type,
                           each.seen ? " any more" : ""));
      each.reported = true;
    } else if (there && each.reported) {
      complain(fmt::format("{}: is published now", each.subscriber.getTopic()));
      each.reported = false;
    }
    each.seen = each.seen || there;
  }
  if (frames_ && !patient && !warned_of_dead_end_ && !frames_->dead_end().empty()) {
    complain(fmt::format("/tf: leads from {} up to {}, not to {}", printable(options_.tf),
                         printable(frames_->dead_end()), printable(options_.world_frame)));
    warned_of_dead_end_ = true;
  }
}

}  // namespace insonify
