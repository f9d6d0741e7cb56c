// ros_frames.cpp -- collects transforms and composes them at the newest time common to all.

#include "ros1/ros_frames.h"

#include <ros/message_event.h>
#include <ros/this_node.h>
#include <ros/transport_hints.h>
#include <tf2/buffer_core.h>
#include <tf2_msgs/TFMessage.h>

#include <optional>
#include <utility>

namespace insonify {
namespace {

constexpr double kMostAhead = 2;  // Largest lead of a transform over simulated time [s].

}  // namespace

struct RosFrames::State {
  using Event = ros::MessageEvent<const tf2_msgs::TFMessage>;

  void receive(const Event& event, bool is_static);

  std::string world, vehicle;
  std::function<void(const RosPlace&)> take;
  tf2::BufferCore frames;
  std::optional<RosPlace> newest;
  std::optional<double> now;  // Simulated time, once it is known [s].
  ros::Subscriber transforms, static_transforms;
};

void RosFrames::State::receive(const Event& event, bool is_static) {
  const std::string& publisher = event.getPublisherName();
  if (publisher == ros::this_node::getName()) {
    return;
  }
  for (const geometry_msgs::TransformStamped& each : event.getConstMessage()->transforms) {
    if (!is_static && now && each.header.stamp.toSec() > *now + kMostAhead) {
      continue;  // From before a time reset: tf would reject all later ones as too old.
    }
    frames.setTransform(each, publisher, is_static);  // Logs invalid ones itself.
  }
  if (!frames.canTransform(world, vehicle, ros::Time(0))) {
    return;
  }
  const geometry_msgs::TransformStamped found = frames.lookupTransform(world, vehicle, ros::Time(0));
  const auto& position = found.transform.translation;
  const auto& orientation = found.transform.rotation;
  RosPlace place;
  place.frame = world;
  place.stamp = found.header.stamp.toSec();  // 0 if all are static.
  place.position = {position.x, position.y, position.z};
  place.orientation = {orientation.w, orientation.x, orientation.y, orientation.z};
  if (!newest || newest->stamp != place.stamp || newest->position != place.position ||
      newest->orientation.coeffs() != place.orientation.coeffs()) {
    newest = place;
    take(place);
  }
}

RosFrames::RosFrames(ros::NodeHandle& node, const std::string& world, const std::string& vehicle,
                     std::function<void(const RosPlace&)> take)
    : state_(std::make_unique<State>()) {
  constexpr int kMany = 100;  // Queue length.
  state_->world = bare_frame(world);
  state_->vehicle = bare_frame(vehicle);
  state_->take = std::move(take);
  const auto subscribe = [&](const char* topic, bool is_static) {
    const boost::function<void(const State::Event&)> receive =
        [state = state_.get(), is_static](const State::Event& event) { state->receive(event, is_static); };
    return node.subscribe<tf2_msgs::TFMessage>(topic, kMany, receive, {}, ros::TransportHints().tcpNoDelay());
  };
  state_->transforms = subscribe("/tf", false);
  state_->static_transforms = subscribe("/tf_static", true);
}

RosFrames::~RosFrames() = default;

const ros::Subscriber& RosFrames::subscriber() const {
  return state_->transforms;
}

void RosFrames::take_time(double now) {
  if (state_->now && now < *state_->now) {  // A simulation or a bag restarted.
    state_->frames.clear();
    state_->newest.reset();
  }
  state_->now = now;
}

std::string RosFrames::dead_end() const {
  constexpr int kMostSteps = 1000;
  if (state_->newest || !state_->frames._frameExists(state_->vehicle)) {
    return "";
  }
  std::string frame = state_->vehicle;
  for (int step = 0; step < kMostSteps && state_->frames._getParent(frame, ros::Time(0), frame); ++step) {
  }
  return frame;
}

}  // namespace insonify
