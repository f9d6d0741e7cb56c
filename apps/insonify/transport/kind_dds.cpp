// kind_dds.cpp -- the command line of the bridge to ROS 2 over DDS.

#include <CLI/CLI.hpp>

#include "console/validators.h"
#include "transport/bridge_kinds.h"

namespace insonify {
namespace {

void add_dds_options(CLI::App& command, BridgeRequest& request) {
  add_odometry_option(command, request);
  add_tf_option(command, request);
  add_clock_option(command, request, "wall");
  DdsOptions& options = request.dds;
  command
      .add_option("--set-topic", options.set_topic,
                  "Topic of std_msgs/String whose messages change settings, as --set does [/insonify/set]")
      ->check(not_empty("a topic, such as /insonify/set"))
      ->type_name("TOPIC");
  const std::string network = "Network";
  command.add_option("--domain", options.domain, "Domain of DDS, 0 to 232 [ROS_DOMAIN_ID, or else 0]")
      ->check(whole_number(0, 232))
      ->type_name("N")
      ->group(network);
  command.add_flag("--local", options.local, "Talk only to programs on this machine; needs no multicast")
      ->group(network);
  command.add_option("--peer", options.peers, "Address of a machine that multicast does not reach; may be repeated")
      ->check(not_empty("an address, such as 192.168.2.3"))
      ->type_name("ADDRESS")
      ->expected(1)
      ->take_all()
      ->group(network);
  command
      .add_flag("--best-effort", options.best_effort, "Do not resend lost messages; reliable subscribers then get none")
      ->group(network);
}

}  // namespace

BridgeKind dds_kind() {
  return {.name = "dds",
          .help = "Topics of ROS 2, over DDS without ROS 2: sonar images, fans, points and transforms",
          .packages = "cyclonedds-dev cyclonedds-tools",
          .footer =
              "Topics of a sonar named fls:\n"
              "  /fls/sonar_image  marine_acoustic_msgs/msg/ProjectedSonarImage\n"
              "  /fls/fan, raw     sensor_msgs/msg/Image\n"
              "  /fls/points       sensor_msgs/msg/PointCloud2\n"
              "  /fls/pose         geometry_msgs/msg/PoseStamped\n"
              "and /tf and /scenario. As nodes of ROS 2 do, it reads ROS_DOMAIN_ID, ROS_LOCALHOST_ONLY,\n"
              "ROS_AUTOMATIC_DISCOVERY_RANGE, ROS_STATIC_PEERS and CYCLONEDDS_URI.\n\n"
              "Examples:\n"
              "  insonify bridge dds dive.yaml\n"
              "  insonify bridge dds dive.yaml --odometry /auv/odom --world-frame odom\n"
              "  insonify bridge dds dive.yaml --tf base_link --clock simulated --domain 7",
          .ros1_words = false,
          .add_options = add_dds_options};
}

}  // namespace insonify
