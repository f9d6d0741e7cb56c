// bridge_options.h -- the bridges' command line, shared by `insonify bridge` and the programs that it starts.

#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "console/command.h"
#include "insonify/live_loop.h"
#include "insonify/messages.h"

namespace insonify {

/// Options of a Bridge.
struct BridgeOptions {
  std::filesystem::path scenario;
  std::vector<std::string> settings = {};  ///< "key=value", in order.
  LiveOptions live = {};
  MessageOptions messages = {.bits = 8};  ///< Few programs that make points of sonar images take 16 bits.
  bool at_once = false;   ///< Whether pings are sent as soon as they are computed, before their sound could be back.
  bool lossless = false;  ///< Whether no ping is dropped: the next is made when there is room for it.
  bool quiet = false;     ///< Print nothing but warnings and errors.
};

/// Options for a bridge's participation in DDS.
struct DdsOptions {
  std::optional<int> domain = {};           ///< 0..232; absent: ROS_DOMAIN_ID, or else 0.
  bool local = false;                       ///< Whether to use only this machine.
  std::vector<std::string> peers = {};      ///< Addresses of machines not reached by multicast.
  bool best_effort = false;                 ///< Do not resend lost messages.
  std::string set_topic = "/insonify/set";  ///< Topic of settings.
};

/// The command line of one bridge. Each bridge uses some of the options after `bridge`.
struct BridgeRequest {
  BridgeOptions bridge;
  std::string odometry;                    ///< Topic of nav_msgs/Odometry for poses; "": none.
  std::string tf;                          ///< Frame of the vehicle, looked up in the world's frame; "": none.
  std::string ping_at;                     ///< Topic of geometry_msgs/PoseStamped, a ping for each; "": none.
  std::string clock;                       ///< wall or simulated; "": the bridge's default.
  DdsOptions dds;                          ///< For the bridge to DDS.
  std::string world;                       ///< Gazebo world; "": the only one.
  bool lock_step = false;                  ///< Whether the bridge steps Gazebo's world.
  std::vector<std::string> vehicles = {};  ///< Carriers of sonars in Gazebo: "NAME" or "SONAR=NAME".
};

/// A bridge to another framework, the program insonify-bridge-NAME.
struct BridgeKind {
  const char* name;      ///< "ros1"
  const char* help;      ///< One line.
  const char* packages;  ///< Debian packages needed to build it, beyond insonify's own.
  const char* footer;    ///< Last lines of its help.
  bool ros1_words;       ///< Whether arguments such as `name:=value` are passed to ROS 1.
  void (*add_options)(const Command& command, BridgeRequest& request);
};

/// All bridges, built or not.
[[nodiscard]] std::span<const BridgeKind> bridge_kinds();

/// @param name  One of bridge_kinds().
[[nodiscard]] const BridgeKind& bridge_kind(std::string_view name);

/// Adds SCENARIO, the common options and those of this bridge. The request must outlive the command.
void add_bridge_options(const Command& command, const BridgeKind& kind, BridgeRequest& request);

/// Checks the remaining arguments of a command line: only those for ROS 1 may be there.
/// @throws InputError for any other.
void check_other_words(const Command& command, const BridgeKind& kind);

}  // namespace insonify
