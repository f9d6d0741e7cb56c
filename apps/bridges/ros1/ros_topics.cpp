// ros_topics.cpp -- converts ROS 1 messages to plain types and back.

#include "ros1/ros_topics.h"

#include <geometry_msgs/PoseStamped.h>
#include <nav_msgs/Odometry.h>
#include <ros/transport_hints.h>
#include <rosgraph_msgs/Clock.h>
#include <std_msgs/String.h>

#include <utility>

#include "ros1/ros_place.h"

namespace insonify {
namespace {

constexpr int kNewest = 1, kSome = 10, kAll = 1000;  // Queue lengths.

Eigen::Vector3d vector(const geometry_msgs::Vector3& from) {
  return {from.x, from.y, from.z};
}

}  // namespace

ros::Subscriber subscribe_odometry(ros::NodeHandle& node, const std::string& topic,
                                   std::function<void(const RosPlace&)> take) {
  const auto translate = [take = std::move(take)](const nav_msgs::Odometry::ConstPtr& message) {
    RosPlace place = place_of(message->header, message->pose.pose);
    place.linear = vector(message->twist.twist.linear);
    place.angular = vector(message->twist.twist.angular);
    take(place);
  };
  return node.subscribe<nav_msgs::Odometry>(topic, kNewest, translate, {}, ros::TransportHints().tcpNoDelay());
}

ros::Subscriber subscribe_poses(ros::NodeHandle& node, const std::string& topic,
                                std::function<void(const RosPlace&)> take) {
  const auto translate = [take = std::move(take)](const geometry_msgs::PoseStamped::ConstPtr& message) {
    take(place_of(message->header, message->pose));
  };
  return node.subscribe<geometry_msgs::PoseStamped>(topic, kAll, translate, {}, ros::TransportHints().tcpNoDelay());
}

ros::Subscriber subscribe_clock(ros::NodeHandle& node, const std::string& topic, std::function<void(double)> take) {
  const auto translate = [take = std::move(take)](const rosgraph_msgs::Clock::ConstPtr& message) {
    take(message->clock.toSec());
  };
  return node.subscribe<rosgraph_msgs::Clock>(topic, kNewest, translate, {}, ros::TransportHints().tcpNoDelay());
}

ros::Subscriber subscribe_text(ros::NodeHandle& node, const std::string& topic,
                               std::function<void(const std::string&)> take) {
  const auto translate = [take = std::move(take)](const std_msgs::String::ConstPtr& message) { take(message->data); };
  return node.subscribe<std_msgs::String>(topic, kSome, translate);
}

std::function<void(const std::string&)> advertise_text(ros::NodeHandle& node, const std::string& topic) {
  return [publisher = node.advertise<std_msgs::String>(topic, kSome)](const std::string& text) {
    std_msgs::String message;
    message.data = text;
    publisher.publish(message);
  };
}

std::string bare_frame(const std::string& frame) {
  return !frame.empty() && frame.front() == '/' ? frame.substr(1) : frame;
}

}  // namespace insonify
