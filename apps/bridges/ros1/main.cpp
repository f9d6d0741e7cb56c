// main.cpp -- insonify-bridge-ros1: publishes a scenario's pings as ROS 1 topics.

#include <fmt/format.h>
#include <ros/init.h>
#include <ros/param.h>
#include <ros/this_node.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <iterator>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "console/console.h"
#include "console/outcome.h"
#include "console/stop.h"
#include "insonify/messages.h"
#include "insonify/printable.h"
#include "ros1/end_guard.h"
#include "ros1/ros_inputs.h"
#include "ros1/ros_master.h"
#include "ros1/ros_parameters.h"
#include "ros1/ros_pings.h"
#include "ros1/ros_settings.h"
#include "ros1/ros_topics.h"
#include "ros1/ros_transport.h"
#include "ros1/ros_watch.h"
#include "transport/bridge_program.h"

namespace insonify {
namespace {

// Reports errors in the scenario without a roscore. Input that can be read only once, such as a pipe, is read later.
void check_scenario(const BridgeOptions& options) {
  if (std::filesystem::is_regular_file(options.scenario)) {
    (void)scenario_of(options);
  }
}

// --clock, or else the parameter that all nodes follow.
bool is_simulated(const std::string& clock) {
  bool use_sim_time = false;
  ros::param::get("/use_sim_time", use_sim_time);
  return clock.empty() ? use_sim_time : clock == "simulated";
}

// If the vehicle's frame were a sonar's, the node would follow its own transforms.
void check_frame(const std::string& vehicle, const LiveWorld& world) {
  for (const SonarConfig& sonar : world.sonars) {
    const std::string name = message_source(world.scenario, sonar).name;
    if (bare_frame(vehicle) == name || bare_frame(vehicle) == name + "_beams") {
      throw InputError(
          fmt::format("--tf {}: this frame is published by the node itself, as that of sonar {}; name the "
                      "vehicle's, or set the parameter publish_tf to false",
                      printable(vehicle), printable(sonar.name)));
    }
  }
}

// roscpp subscribes to this parameter when a node first logs. If that log message said that another node has taken the
// name, roscore would give the name back to this node and end the other.
void ask_what_logging_asks() {
  bool ignored = false;
  ros::param::getCached("/rosout_disable_topics_generation", ignored);
}

int run(const BridgeRequest& given, int& argc, char** argv) {
  end_when_asked(IgnoredInterrupt::kEnds);
  check_scenario(given.bridge);
  const RosMaster master(ros_master_uri(argc, argv));
  const int pid = master.wait();
  ros::init(argc, argv, "insonify", ros::init_options::NoSigintHandler);
  ros::start();
  ask_what_logging_asks();
  const RosParameters parameters = with_parameters({argv + 1, argv + argc});
  const BridgeRequest& request = parameters.request;
  BridgeOptions options = request.bridge;
  options.messages.raw = options.messages.live = true;
  options.live.on_request = options.lossless = !request.ping_at.empty();
  options.live.driven = options.live.on_request || !request.odometry.empty() || !request.tf.empty();
  options.live.clocked = !options.live.on_request && is_simulated(request.clock);

  RosTransport transport(parameters.transforms, options.lossless);
  Bridge bridge(options, transport, MessageForm::kRos1);
  RosInputs inputs({.odometry = request.odometry,
                    .tf = request.tf,
                    .ping_at = request.ping_at,
                    .world_frame = options.messages.world_frame,
                    .clock = options.live.clocked},
                   bridge.loop());
  bridge.start();
  if (parameters.transforms && !request.tf.empty()) {
    check_frame(request.tf, *bridge.loop().world());
  }
  RosSettings settings(bridge);
  inputs.start();
  note_when_asked(IgnoredInterrupt::kEnds);
  std::atomic<bool> ended = false;
  std::optional<RosPings> pings;
  std::vector<std::string> services = settings.services();
  if (options.live.on_request) {
    pings.emplace(bridge, options.messages.world_frame);
    std::ranges::copy(pings->services(), std::back_inserter(services));
  }
  RosWatch watch(master, pid, services, [&ended] { ended = true; });
  if (!options.quiet) {
    say("node {} of ROS 1, roscore at {}\n", ros::this_node::getName(), master.uri());
    flush_output();
  }
  report_until_stopped(bridge.report(), ended);
  const auto report = [&options, &bridge] {
    if (!options.quiet) {
      say("{}\n", bridge.report().text());
      flush_output();
    }
  };
  EndGuard guard(report);
  bridge.end();
  report();
  guard.said();
  watch.end();
  settings.end();
  pings.reset();
  inputs.end();
  ros::shutdown();
  while (ros::ok()) {  // ROS is ending the node in a thread of its own.
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return kDone;
}

}  // namespace
}  // namespace insonify

int main(int argc, char** argv) {
  return insonify::run_bridge("ros1", argc, argv, insonify::run);
}
