// main.cpp -- insonify-bridge-gazebo: adds sonars to a running Gazebo and publishes their pictures.

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <string>

#include "console/console.h"
#include "console/outcome.h"
#include "console/stop.h"
#include "gazebo/gazebo_follower.h"
#include "gazebo/gazebo_names.h"
#include "gazebo/gazebo_transport.h"
#include "insonify/files.h"
#include "transport/bridge_program.h"

namespace insonify {
namespace {

// Materials of visuals from the scenario's SDF file: Gazebo does not transmit them.
std::map<std::string, std::string> materials_of(const Scenario& scenario, const Log& log) {
  std::map<std::string, std::string> materials;
  if (scenario.world.empty()) {
    return materials;
  }
  try {
    for (const Instance& instance : load_scene(scenario.world, world_options(scenario)).instances) {
      if (!instance.user_material.empty()) {
        materials[instance.name] = instance.user_material;
      }
    }
  } catch (const Error& error) {
    log(Severity::kWarning, fmt::format("materials are not read from the world's file: {}", error.what()));
  }
  return materials;
}

// Carriers of the sonars: options take precedence over the world's file.
std::map<std::string, Carrier> carriers_of(const BridgeRequest& request, const Scenario& scenario) {
  std::map<std::string, Carrier> carriers;
  for (const SonarCarrier& found : load_sonar_carriers(scenario)) {
    carriers[found.sonar] = {.name = found.carrier, .carrier_from_vehicle = found.carrier_from_vehicle};
  }
  for (const std::string& vehicle : request.vehicles) {
    const std::size_t mark = vehicle.find('=');
    const std::string sonar = mark == std::string::npos ? "" : vehicle.substr(0, mark);
    if (!sonar.empty() && std::ranges::find(scenario.sonars, sonar, &SonarConfig::name) == scenario.sonars.end()) {
      throw InputError(fmt::format("--vehicle {}: there is no sonar {}", vehicle, sonar));
    }
    carriers[sonar] = {.name = vehicle.substr(mark == std::string::npos ? 0 : mark + 1), .carrier_from_vehicle = {}};
  }
  return carriers;
}

int run(const BridgeRequest& request) {
  end_when_asked(IgnoredInterrupt::kEnds);
  copy_gz_environment();
  const bool quiet = request.bridge.quiet;
  const Log log = [quiet](Severity severity, const std::string& text) {
    if (severity == Severity::kWarning) {
      complain(text);
    } else if (!quiet) {
      say("{}\n", text);
      flush_output();
    }
  };
  BridgeOptions options = request.bridge;
  options.live.driven = true;
  options.live.followed = true;
  options.live.clocked = request.clock != "wall";
  options.lossless = request.lock_step;
  GazeboTransport transport;
  Bridge bridge(options, transport, MessageForm::kGazebo);
  note_when_asked(IgnoredInterrupt::kEnds);
  const Scenario scenario = load_scenario(options.scenario, options.settings);
  std::atomic<GazeboFollower*> woken = nullptr;
  bridge.when_idle([&woken] {
    if (GazeboFollower* const follower = woken) {
      follower->wake();
    }
  });
  bridge.start();
  GazeboFollower follower(
      {.world = request.world,
       .carriers = carriers_of(request, scenario),
       .clock = options.live.clocked,
       .lock_step = request.lock_step,
       .materials = materials_of(scenario, log)},
      WorldParts(scenario.world.empty() ? scenario.file : scenario.world, world_options(scenario), log), bridge.loop(),
      log);
  woken = request.lock_step ? &follower : nullptr;
  follower.start();
  report_until_stopped(bridge.report());
  follower.end();
  bridge.end();
  if (!quiet) {
    say("{}\n", bridge.report().text());
  }
  return kDone;
}

}  // namespace
}  // namespace insonify

int main(int argc, char** argv) {
  return insonify::run_bridge("gazebo", argc, argv, [](const insonify::BridgeRequest& request, int&, char**) {
    return insonify::run(request);
  });
}
