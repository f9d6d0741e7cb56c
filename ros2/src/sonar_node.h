// sonar_node.h -- a component of ROS 2 that publishes the pings of a scenario; docs/how-to/ros2.md. Not built with ROS
// 2 where insonify is made: a test compiles and runs it with stand-ins for rclcpp.

#pragma once

#include <insonify/live_sender.h>

#include <cstdint>
#include <geometry_msgs/msg/pose_stamped.hpp>
#include <map>
#include <memory>
#include <nav_msgs/msg/odometry.hpp>
#include <rclcpp/rclcpp.hpp>
#include <rosgraph_msgs/msg/clock.hpp>
#include <string>
#include <vector>

namespace insonify_ros2 {

/// Publishes the topics of `insonify bridge dds`, as a node with parameters.
///
/// Pings are made and published in the threads of a LiveSender. A ping is published when its last echo could be back,
/// or at once with the parameter `at_once`.
class SonarNode : public rclcpp::Node, private insonify::Transport {
 public:
  /// @throws insonify::Error for an invalid scenario or parameter.
  explicit SonarNode(const rclcpp::NodeOptions& options);
  ~SonarNode() override;

 private:
  void open(std::size_t sonar, const std::vector<insonify::MessageChannel>& channels) override;
  [[nodiscard]] bool is_read(std::size_t sonar, std::size_t channel) const override;
  void send(std::size_t sonar, std::size_t channel, std::uint64_t time_ns,
            const std::vector<std::byte>& message) override;

  void end();
  void warn(const std::string& text);
  [[nodiscard]] insonify::LiveSenderOptions declare_constants();
  void declare_settings();
  void subscribe();
  void drive(const geometry_msgs::msg::Pose& pose, const insonify::Twist& twist_in_vehicle, double stamp);
  [[nodiscard]] rcl_interfaces::msg::SetParametersResult change(const std::vector<rclcpp::Parameter>& parameters);
  [[nodiscard]] rclcpp::GenericPublisher::SharedPtr publisher(const insonify::MessageChannel& channel);

  bool clocked_ = false;
  std::string last_refusal_;  // Why the last pose was refused, "" if it was not: reported once.
  std::unique_ptr<insonify::LiveSender> sender_;
  rclcpp::Subscription<nav_msgs::msg::Odometry>::SharedPtr odometry_;
  rclcpp::Subscription<geometry_msgs::msg::PoseStamped>::SharedPtr asked_;
  rclcpp::Subscription<rosgraph_msgs::msg::Clock>::SharedPtr clock_;
  rclcpp::node_interfaces::OnSetParametersCallbackHandle::SharedPtr on_change_;

  // Used by the sending thread only.
  std::vector<std::vector<rclcpp::GenericPublisher::SharedPtr>>
      channels_;                                                           // By sonar and channel; null: not published.
  std::map<std::string, rclcpp::GenericPublisher::SharedPtr> publishers_;  // By topic.
};

}  // namespace insonify_ros2
