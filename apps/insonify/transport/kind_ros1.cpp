// kind_ros1.cpp -- the command line of the bridge to ROS 1.

#include <CLI/CLI.hpp>

#include "transport/bridge_kinds.h"

namespace insonify {
namespace {

void add_ros1_options(CLI::App& command, BridgeRequest& request) {
  add_odometry_option(command, request);
  add_tf_option(command, request);
  add_clock_option(command, request, "by the parameter /use_sim_time");
}

}  // namespace

BridgeKind ros1_kind() {
  return {.name = "ros1",
          .help = "A node of ROS 1: sonar images, fans, points and transforms as topics",
          .packages =
              "pkg-config libroscpp-dev libtopic-tools-dev libtf2-ros-dev libnav-msgs-dev libsensor-msgs-dev "
              "libdynamic-reconfigure-config-init-mutex-dev",
          .footer =
              "Topics, below the node's name (/insonify), of several sonars below the sonar's name there:\n"
              "  image       marine_acoustic_msgs/ProjectedSonarImage\n"
              "  fan, raw    sensor_msgs/Image\n"
              "  points      sensor_msgs/PointCloud2\n"
              "  pose        geometry_msgs/PoseStamped\n"
              "  scenario    std_msgs/String, latched\n"
              "and /tf. Range and gain by dynamic_reconfigure, other settings by the topic set. Each option is a\n"
              "parameter too (world_frame), and there are range, gain and publish_tf.\n"
              "Other words, name:=value, are ROS's: __name:=sonar, /tf:=/auv/tf, _range:=15.\n\n"
              "Examples:\n"
              "  insonify bridge ros1 dive.yaml\n"
              "  insonify bridge ros1 dive.yaml --odometry /auv/odom --world-frame odom\n"
              "  insonify bridge ros1 dive.yaml --tf base_link --clock simulated",
          .ros1_words = true,
          .add_options = add_ros1_options};
}

}  // namespace insonify
