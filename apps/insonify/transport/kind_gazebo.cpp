// kind_gazebo.cpp -- the command line of the bridge to Gazebo.

#include <CLI/CLI.hpp>

#include "console/validators.h"
#include "transport/bridge_kinds.h"

namespace insonify {
namespace {

void add_gazebo_options(CLI::App& command, BridgeRequest& request) {
  command.add_option("--world", request.world, "Name of the Gazebo world [the only one]")
      ->check(not_empty("a world, such as tank"))
      ->type_name("NAME");
  command
      .add_option("--vehicle", request.vehicles,
                  "Model or link that carries the sonars, or one sonar, such as rov or fls=rov::base_link; may be "
                  "repeated [the scenario's trajectory]")
      ->check(not_empty("a model or link, such as rov::base_link"))
      ->type_name("[SONAR=]NAME")
      ->expected(1)
      ->take_all();
  command
      .add_option("--clock", request.clock,
                  "Clock of the pings: wall, or simulated, that of Gazebo's pose messages [simulated]")
      ->check(one_of({"wall", "simulated"}))
      ->type_name("NAME");
}

}  // namespace

BridgeKind gazebo_kind() {
  return {.name = "gazebo",
          .help = "Follow a Gazebo world: its models and their poses; publish pictures on its topics",
          .packages = "libignition-transport-dev libignition-msgs-dev",
          .footer =
              "SCENARIO may be the SDF world itself, with sonars in it. Topics, below the sonar's name:\n"
              "  sonar_image, fan   gz.msgs.Image\n"
              "  points             gz.msgs.PointCloudPacked\n"
              "  pose               gz.msgs.Pose\n"
              "each also as ignition.msgs, for Gazebo Fortress.\n\n"
              "Examples:\n"
              "  insonify bridge gazebo tank.sdf\n"
              "  insonify bridge gazebo dive.yaml --vehicle rov::base_link",
          .ros1_words = false,
          .add_options = add_gazebo_options};
}

}  // namespace insonify
