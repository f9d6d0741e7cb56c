// ros_topics.h -- ROS 1 topics as plain types, since the headers of their messages are not valid C++20.
//
// ros_topics.cpp, ros_frames.cpp and ros_reconfigure.cpp are compiled as C++17, and their headers can be read as both.

#pragma once

#include <ros/node_handle.h>
#include <ros/subscriber.h>

#include <Eigen/Geometry>
#include <functional>
#include <string>

namespace insonify {

/// Pose and velocity of a vehicle.
struct RosPlace {
  std::string frame;  ///< Frame of the pose.
  double stamp = 0;   ///< [s]; 0: none.
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< As received; its norm may differ from 1.
  Eigen::Vector3d linear = Eigen::Vector3d::Zero(),                 ///< Velocity in the vehicle's frame [m/s].
      angular = Eigen::Vector3d::Zero();                            ///< [rad/s]
};

/// Each of these calls a function with the newest message, in a thread of the node's callback queue.
/// @param topic  nav_msgs/Odometry
[[nodiscard]] ros::Subscriber subscribe_odometry(ros::NodeHandle& node, const std::string& topic,
                                                 std::function<void(const RosPlace&)> take);
/// @param topic  geometry_msgs/PoseStamped; each message is passed, unless more than a thousand wait.
[[nodiscard]] ros::Subscriber subscribe_poses(ros::NodeHandle& node, const std::string& topic,
                                              std::function<void(const RosPlace&)> take);
/// @param topic  rosgraph_msgs/Clock; passed in seconds.
[[nodiscard]] ros::Subscriber subscribe_clock(ros::NodeHandle& node, const std::string& topic,
                                              std::function<void(double)> take);
/// @param topic  std_msgs/String
[[nodiscard]] ros::Subscriber subscribe_text(ros::NodeHandle& node, const std::string& topic,
                                             std::function<void(const std::string&)> take);

/// @param topic  std_msgs/String
/// @return       A function that publishes, from any thread.
[[nodiscard]] std::function<void(const std::string&)> advertise_text(ros::NodeHandle& node, const std::string& topic);

/// Early ROS wrote frames with a leading slash.
[[nodiscard]] std::string bare_frame(const std::string& frame);

}  // namespace insonify
