// bridge_options.cpp -- the command lines of the bridges: options common to all, and those of each.

#include "transport/bridge_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "console/outcome.h"
#include "console/validators.h"

namespace insonify {
namespace {

// Where poses and time come from, in ROS 1 and 2.
// @param clock  The usual clock, for the help.
void add_ros_inputs(const Command& command, BridgeRequest& request, const char* clock) {
  command.option("--odometry", "TOPIC", &request.odometry,
                 "Topic of nav_msgs/Odometry that sets the vehicle's pose [the trajectory]",
                 not_empty("a topic, such as /odom"));
  command.option("--tf", "FRAME", &request.tf, "Frame of the vehicle, whose pose is looked up in tf [the trajectory]",
                 not_empty("a frame, such as base_link"));
  command.exclude("--tf", {"--odometry"});
  command.option("--vehicle-frame", "FRAME", &request.bridge.messages.vehicle_frame,
                 "Frame of the vehicle in tf: sonars' mountings on it go to /tf_static, rather than their places in "
                 "the world to /tf",
                 not_empty("a frame, such as base_link"));
  command.option("--clock", "NAME", &request.clock,
                 fmt::format("Clock of the pings: wall, or simulated, that of the topic /clock [{}]", clock),
                 one_of({"wall", "simulated"}));
  command.option("--ping-at", "TOPIC", &request.ping_at,
                 "Topic of geometry_msgs/PoseStamped: a ping for each message, from its pose, and no others",
                 not_empty("a topic, such as /insonify/ping"));
  command.exclude("--ping-at", {"--odometry", "--tf", "--clock"});
}

void add_ros1_options(const Command& command, BridgeRequest& request) {
  add_ros_inputs(command, request, "by the parameter /use_sim_time");
}

void add_dds_options(const Command& command, BridgeRequest& request) {
  add_ros_inputs(command, request, "wall");
  DdsOptions& options = request.dds;
  command.option("--set-topic", "TOPIC", &options.set_topic,
                 "Topic of std_msgs/String whose messages change settings, as --set does [/insonify/set]",
                 not_empty("a topic, such as /insonify/set"));
  const Command network = command.under("Network");
  network.option("--domain", "N", &options.domain, "Domain of DDS, 0 to 232 [ROS_DOMAIN_ID, or else 0]",
                 whole_number(0, 232));
  network.flag("--local", &options.local, "Talk only to programs on this machine; needs no multicast");
  network.option("--peer", "ADDRESS", &options.peers,
                 "Address of a machine that multicast does not reach; may be repeated",
                 not_empty("an address, such as 192.168.2.3"));
  network.flag("--best-effort", &options.best_effort,
               "Do not resend lost messages; reliable subscribers then get none");
}

void add_gazebo_options(const Command& command, BridgeRequest& request) {
  command.option("--world", "NAME", &request.world, "Name of the Gazebo world [the only one]",
                 not_empty("a world, such as tank"));
  command.option("--vehicle", "[SONAR=]NAME", &request.vehicles,
                 "Model or link that carries the sonars, or one sonar, such as rov or fls=rov::base_link; may be "
                 "repeated [the scenario's trajectory]",
                 not_empty("a model or link, such as rov::base_link"));
  command.option("--clock", "NAME", &request.clock,
                 "Clock of the pings: wall, or simulated, that of Gazebo's pose messages [simulated]",
                 one_of({"wall", "simulated"}));
  command.flag("--lock-step", &request.lock_step,
               "Pause the world and step it from ping to ping, so that none is late or lost");
  command.exclude("--lock-step", {"--clock"});
}

constexpr BridgeKind kKinds[] = {
    {.name = "ros1",
     .help = "A node of ROS 1: sonar images, fans, points and transforms as topics",
     .packages = "pkg-config libroscpp-dev libtopic-tools-dev libtf2-ros-dev libnav-msgs-dev libsensor-msgs-dev "
                 "libdynamic-reconfigure-config-init-mutex-dev",
     .footer = "Topics, below the node's name (/insonify), of several sonars below the sonar's name there:\n"
               "  image       marine_acoustic_msgs/ProjectedSonarImage\n"
               "  fan, raw    sensor_msgs/Image\n"
               "  points, true_points  sensor_msgs/PointCloud2\n"
               "  pose        geometry_msgs/PoseStamped\n"
               "  labels      sensor_msgs/Image\n"
               "  scan        sensor_msgs/LaserScan, of scanning sonars\n"
               "  detections  marine_acoustic_msgs/SonarDetections, of multibeams\n"
               "  soundings   sensor_msgs/PointCloud2, of multibeams\n"
               "  description std_msgs/String\n"
               "  scenario    std_msgs/String, latched\n"
               "and /tf. Range and gain by dynamic_reconfigure, other settings by the topic set. Each option is a\n"
               "parameter too (world_frame), and there are range, gain and publish_tf.\n"
               "Other words, name:=value, are ROS's: __name:=sonar, /tf:=/auv/tf, _range:=15.\n\n"
               "Examples:\n"
               "  insonify bridge ros1 dive.yaml\n"
               "  insonify bridge ros1 dive.yaml --odometry /auv/odom --world-frame odom\n"
               "  insonify bridge ros1 dive.yaml --tf base_link --clock simulated",
     .ros1_words = true,
     .add_options = add_ros1_options},
    {.name = "dds",
     .help = "Topics of ROS 2, over DDS without ROS 2: sonar images, fans, points and transforms",
     .packages = "cyclonedds-dev cyclonedds-tools",
     .footer =
         "Topics of a sonar named fls:\n"
         "  /fls/sonar_image  marine_acoustic_msgs/msg/ProjectedSonarImage\n"
         "  /fls/fan, raw     sensor_msgs/msg/Image\n"
         "  /fls/points, true_points  sensor_msgs/msg/PointCloud2\n"
         "  /fls/pose         geometry_msgs/msg/PoseStamped\n"
         "  /fls/labels       sensor_msgs/msg/Image\n"
         "  /fls/scan         sensor_msgs/msg/LaserScan, of scanning sonars\n"
         "  /fls/detections   marine_acoustic_msgs/msg/SonarDetections, of multibeams\n"
         "  /fls/soundings    sensor_msgs/msg/PointCloud2, of multibeams\n"
         "  /fls/description  std_msgs/msg/String\n"
         "and /tf, or /tf_static, and /scenario. As nodes of ROS 2 do, it reads ROS_DOMAIN_ID, ROS_LOCALHOST_ONLY,\n"
         "ROS_AUTOMATIC_DISCOVERY_RANGE, ROS_STATIC_PEERS and CYCLONEDDS_URI.\n\n"
         "Examples:\n"
         "  insonify bridge dds dive.yaml\n"
         "  insonify bridge dds dive.yaml --odometry /auv/odom --world-frame odom\n"
         "  insonify bridge dds dive.yaml --tf base_link --clock simulated --domain 7\n"
         "  insonify bridge dds dive.yaml --ping-at /insonify/ping --at-once",
     .ros1_words = false,
     .add_options = add_dds_options},
    {.name = "gazebo",
     .help = "Follow a Gazebo world: its models and their poses; publish pictures on its topics",
     .packages = "libignition-transport-dev libignition-msgs-dev",
     .footer = "SCENARIO may be the SDF world itself, with sonars in it. Topics, below the sonar's name:\n"
               "  sonar_image, fan   gz.msgs.Image\n"
               "  points, true_points  gz.msgs.PointCloudPacked\n"
               "  soundings          gz.msgs.PointCloudPacked, of multibeams\n"
               "  pose               gz.msgs.Pose\n"
               "each also as ignition.msgs, for Gazebo Fortress.\n\n"
               "Examples:\n"
               "  insonify bridge gazebo tank.sdf\n"
               "  insonify bridge gazebo dive.yaml --vehicle rov::base_link",
     .ros1_words = false,
     .add_options = add_gazebo_options}};

}  // namespace

std::span<const BridgeKind> bridge_kinds() {
  return kKinds;
}

const BridgeKind& bridge_kind(std::string_view name) {
  return *std::ranges::find(kKinds, name, [](const BridgeKind& kind) { return std::string_view(kind.name); });
}

void add_bridge_options(const Command& command, const BridgeKind& kind, BridgeRequest& request) {
  BridgeOptions& options = request.bridge;
  command.argument("SCENARIO", &options.scenario, "Scenario file (YAML, or Stonefish's .scn)");
  command.option("--set", "KEY=VALUE", &options.settings,
                 "Change a key of the scenario, such as max_range=20; may be repeated");
  command.one_at_a_time("--set");  // Arguments for ROS may follow.
  command.option("--rate", "HZ", &options.live.rate_limit,
                 "Limit of pings per second of each sonar [the sonar's own rate]", number_within(above_to(0, 1000)));
  command.option("--threads", "N", &options.live.threads, "Worker threads; 0: one per processor [0]",
                 whole_number(0, 1024));
  command.flag("--at-once", &options.at_once,
               "Send pings as soon as they are computed, not when their last echo could be back");
  command.flag("-q,--quiet", &options.quiet, "Print only warnings and errors");

  const Command messages = command.under("Messages");
  messages.option("--bits", "N", &options.messages.bits, "Bits of the values of sonar images, 8 or 16 [8]",
                  one_of({"8", "16"}));
  const auto set_levels = [&options](const std::string& text) {
    const auto given = parsed_levels(text);
    options.messages.low_db = given->first;
    options.messages.high_db = given->second;
  };
  messages.option("--levels", "LOW:HIGH", set_levels,
                  "Levels of the darkest and the brightest value [dB], such as -90:-40 [-100:-40, or the receiver's]",
                  levels());
  messages.option("--fan-height", "N", &options.messages.fan_height,
                  "Height of fan pictures in pixels, 240 to 8192 [480]", whole_number(240, 8192));
  messages.option("--world-frame", "FRAME", &options.messages.world_frame, "Name of the world's frame [world]",
                  not_empty("a frame, such as odom"));

  kind.add_options(command, request);
  command.footer(std::string(kind.footer) + "\n\nCtrl-C ends it; SIGUSR1 prints rate and latency.");
  if (kind.ros1_words) {
    command.allow_extras();
  }
}

void check_other_words(const Command& command, const BridgeKind& kind) {
  std::vector<std::string> words = command.remaining();
  std::erase_if(words, [](const std::string& word) { return word.find(":=") != std::string::npos; });
  if (!words.empty()) {
    throw InputError(fmt::format("not understood: {} (insonify bridge {} --help)", fmt::join(words, " "), kind.name));
  }
}

}  // namespace insonify
