// sonar_node.h -- a component of ROS 2 that publishes the pings of a scenario; docs/how-to/ros2.md. Not built with ROS
// 2 where insonify is made: a test compiles and runs it with stand-ins for rclcpp.

#pragma once

#include <insonify/live_loop.h>
#include <insonify/messages.h>

#include <condition_variable>
#include <cstdint>
#include <geometry_msgs/msg/pose_stamped.hpp>
#include <map>
#include <memory>
#include <mutex>
#include <nav_msgs/msg/odometry.hpp>
#include <rclcpp/rclcpp.hpp>
#include <rosgraph_msgs/msg/clock.hpp>
#include <string>
#include <thread>
#include <vector>

namespace insonify_ros2 {

/// Publishes the topics of `insonify bridge dds`, as a node with parameters.
///
/// Pings are made in the threads of a LiveLoop and published in one of this node's. A ping is published when its last
/// echo could be back, or at once with the parameter `at_once`.
class SonarNode : public rclcpp::Node, private insonify::LiveListener {
 public:
  /// @throws insonify::Error for an invalid scenario or parameter.
  explicit SonarNode(const rclcpp::NodeOptions& options);
  ~SonarNode() override;

 private:
  void on_ping(const std::shared_ptr<const insonify::LivePing>& ping) override;
  void on_world(const std::shared_ptr<const insonify::LiveWorld>& world) override;
  void on_note(const std::string& text) override;
  void on_clock(double time) override;

  void end();
  void declare_constants();
  void declare_settings();
  void subscribe();
  void drive(const geometry_msgs::msg::Pose& pose, const insonify::Twist& twist_in_vehicle, double stamp);
  [[nodiscard]] rcl_interfaces::msg::SetParametersResult change(const std::vector<rclcpp::Parameter>& parameters);
  [[nodiscard]] double now_of_pings() const;
  void publish_until_end();
  void open(const insonify::LiveWorld& world, const std::map<std::string, double>& gains_db);
  [[nodiscard]] rclcpp::GenericPublisher::SharedPtr publisher(const insonify::MessageChannel& channel);
  void publish_latched();
  void publish(const insonify::LivePing& ping);

  insonify::MessageOptions message_options_;
  bool at_once_ = false, clocked_ = false, on_request_ = false;
  std::string last_refusal_;  // Why the last pose was refused, "" if it was not: reported once.
  std::unique_ptr<insonify::LiveLoop> loop_;
  rclcpp::Subscription<nav_msgs::msg::Odometry>::SharedPtr odometry_;
  rclcpp::Subscription<geometry_msgs::msg::PoseStamped>::SharedPtr asked_;
  rclcpp::Subscription<rosgraph_msgs::msg::Clock>::SharedPtr clock_;
  rclcpp::node_interfaces::OnSetParametersCallbackHandle::SharedPtr on_change_;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::multimap<double, std::shared_ptr<const insonify::LivePing>> waiting_;  // By when they are due [s].
  std::map<std::string, double> gains_db_;                                    // By sonar's name in topics.
  std::shared_ptr<const insonify::LiveWorld> next_world_;                     // To be opened.
  double clock_time_ = 0;                                                     // Last time of /clock [s].
  bool opens_ = true;  // Whether channels are to be opened again.
  bool ending_ = false;
  std::thread publishing_;

  // Used by the publishing thread only.
  std::shared_ptr<const insonify::LiveWorld> world_;
  std::vector<insonify::SonarMessages> messages_;  // By sonar.
  std::vector<std::vector<rclcpp::GenericPublisher::SharedPtr>>
      channels_;                                                           // By sonar and channel; null: not published.
  std::map<std::string, rclcpp::GenericPublisher::SharedPtr> publishers_;  // By topic.
  std::string last_problem_;           // Why the last ping was not published: reported once.
  std::map<int, double> received_at_;  // [sonar] LivePing::received_at of its last ping [s].
};

}  // namespace insonify_ros2
