// ros_topics.h -- topics of messages whose headers are no C++20, told in plain types.
//
// ros_topics.cpp, ros_frames.cpp and ros_reconfigure.cpp are compiled as C++17, and their headers can be read as both.

#pragma once

#include <ros/node_handle.h>
#include <ros/subscriber.h>

#include <Eigen/Geometry>
#include <functional>
#include <string>

namespace insonify {

/// Where a vehicle is.
struct RosPlace {
  std::string frame;  ///< That the position is in.
  double stamp = 0;   ///< [s], 0 for none.
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< As it came: perhaps not of length 1.
  Eigen::Vector3d linear = Eigen::Vector3d::Zero(),                 ///< Velocity along the axes of the vehicle [m/s].
      angular = Eigen::Vector3d::Zero();                            ///< [rad/s]
};

/// Each calls a function with the newest message, in a thread of the node's callback queue.
/// @param topic  nav_msgs/Odometry
[[nodiscard]] ros::Subscriber subscribe_odometry(ros::NodeHandle& node, const std::string& topic,
                                                 std::function<void(const RosPlace&)> take);
/// @param topic  rosgraph_msgs/Clock, told in seconds.
[[nodiscard]] ros::Subscriber subscribe_clock(ros::NodeHandle& node, const std::string& topic,
                                              std::function<void(double)> take);
/// @param topic  std_msgs/String
[[nodiscard]] ros::Subscriber subscribe_text(ros::NodeHandle& node, const std::string& topic,
                                             std::function<void(const std::string&)> take);

/// @param topic  std_msgs/String
/// @return       Publishes, from any thread.
[[nodiscard]] std::function<void(const std::string&)> advertise_text(ros::NodeHandle& node, const std::string& topic);

/// Frames were written with a slash in front in the first years of ROS.
[[nodiscard]] std::string bare_frame(const std::string& frame);

}  // namespace insonify
