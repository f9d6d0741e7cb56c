// kind_gazebo.cpp -- the command line of the bridge to Gazebo.

#include <CLI/CLI.hpp>

#include "console/validators.h"
#include "road/bridge_kinds.h"

namespace insonify {
namespace {

void add_gazebo_options(CLI::App& command, BridgeRequest& request) {
  command.add_option("--world", request.world, "Name of Gazebo's world [the only one there is]")
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
                  "Whose time pings keep: wall, or simulated, that of Gazebo's messages about poses [simulated]")
      ->check(one_of({"wall", "simulated"}))
      ->type_name("NAME");
}

}  // namespace

BridgeKind gazebo_kind() {
  return {.name = "gazebo",
          .help = "Follow a world of Gazebo's: its models and their poses, pictures back on its topics",
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
