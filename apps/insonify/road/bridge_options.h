// bridge_options.h -- the command line of bridges: `insonify bridge` and the programs that it starts read it alike.

#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "insonify/live_loop.h"
#include "insonify/messages.h"
#include "road/dds_options.h"

namespace CLI {  // NOLINT(readability-identifier-naming)
class App;
}

namespace insonify {

/// What a Bridge is made from.
struct BridgeOptions {
  std::filesystem::path scenario;
  std::vector<std::string> settings = {};  ///< "key=value", in order.
  LiveOptions live = {};
  MessageOptions messages = {};
  bool quiet = false;  ///< Print nothing but warnings and errors.
};

/// The command line of one bridge. Each bridge has some of the options below the first.
struct BridgeRequest {
  BridgeOptions bridge;
  std::string odometry;  ///< Topic of nav_msgs/Odometry that tells poses; "" for none.
  std::string tf;        ///< Frame of the vehicle, whose transform from the world's tells poses; "" for none.
  std::string clock;     ///< wall or simulated; "" for what the bridge has as default.
  DdsOptions dds;        ///< For the bridge to DDS.
  std::string world;     ///< World of Gazebo; "" for the only one.
  std::vector<std::string> vehicles = {};  ///< What carries sonars in Gazebo: "NAME" or "SONAR=NAME".
};

/// A bridge to another framework, the program insonify-bridge-NAME.
struct BridgeKind {
  const char* name;      ///< "ros1"
  const char* help;      ///< One line.
  const char* packages;  ///< Debian packages that it is built with, beside insonify's own.
  const char* footer;    ///< Last lines of its help.
  bool ros1_words;       ///< Whether words as `name:=value` are left to ROS 1.
  void (*add_options)(CLI::App& command, BridgeRequest& request);
};

/// All of them, built or not.
[[nodiscard]] std::span<const BridgeKind> bridge_kinds();

/// @param name  One of bridge_kinds().
[[nodiscard]] const BridgeKind& bridge_kind(std::string_view name);

/// Adds SCENARIO, the options that all bridges have and those of this one. The request must outlive the command.
void add_bridge_options(CLI::App& command, const BridgeKind& kind, BridgeRequest& request);

/// Words of a parsed command line that are for ROS 1.
/// @throws InputError where there are others that are not understood.
void check_other_words(const CLI::App& command, const BridgeKind& kind);

}  // namespace insonify
