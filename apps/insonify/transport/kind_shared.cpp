// kind_shared.cpp -- options of several bridges, but not all.

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "console/validators.h"
#include "transport/bridge_kinds.h"

namespace insonify {

void add_odometry_option(CLI::App& command, BridgeRequest& request) {
  command
      .add_option("--odometry", request.odometry,
                  "Topic of nav_msgs/Odometry that sets the vehicle's pose [the trajectory]")
      ->check(not_empty("a topic, such as /odom"))
      ->type_name("TOPIC");
}

void add_tf_option(CLI::App& command, BridgeRequest& request) {
  command.add_option("--tf", request.tf, "Frame of the vehicle, whose pose is looked up in tf [the trajectory]")
      ->check(not_empty("a frame, such as base_link"))
      ->excludes("--odometry")
      ->type_name("FRAME");
}

void add_clock_option(CLI::App& command, BridgeRequest& request, const char* usual) {
  command
      .add_option("--clock", request.clock,
                  fmt::format("Clock of the pings: wall, or simulated, that of the topic /clock [{}]", usual))
      ->check(one_of({"wall", "simulated"}))
      ->type_name("NAME");
}

}  // namespace insonify
