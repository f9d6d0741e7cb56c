// kind_shared.cpp -- options that several bridges have, but not all.

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "console/validators.h"
#include "road/bridge_kinds.h"

namespace insonify {

void add_odometry_option(CLI::App& command, BridgeRequest& request) {
  command
      .add_option("--odometry", request.odometry,
                  "Topic of nav_msgs/Odometry: the vehicle is where its newest message says [on the trajectory]")
      ->check(not_empty("a topic, such as /odom"))
      ->type_name("TOPIC");
}

void add_tf_option(CLI::App& command, BridgeRequest& request) {
  command
      .add_option("--tf", request.tf,
                  "Frame of the vehicle: it is where tf has this frame in the world's [on the trajectory]")
      ->check(not_empty("a frame, such as base_link"))
      ->excludes("--odometry")
      ->type_name("FRAME");
}

void add_clock_option(CLI::App& command, BridgeRequest& request, const char* usual) {
  command
      .add_option("--clock", request.clock,
                  fmt::format("Whose time pings keep: wall, or simulated, that of the topic /clock [{}]", usual))
      ->check(one_of({"wall", "simulated"}))
      ->type_name("NAME");
}

}  // namespace insonify
