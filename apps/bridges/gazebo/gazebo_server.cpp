// gazebo_server.cpp -- calls the services of Gazebo Fortress and later.

#include "gazebo/gazebo_server.h"

#include <gz_types.pb.h>
#include <ignition/msgs/boolean.pb.h>
#include <ignition/msgs/empty.pb.h>
#include <ignition/msgs/world_control.pb.h>

#include <algorithm>
#include <set>

#include "gazebo/gazebo_names.h"

namespace insonify {
namespace {

constexpr unsigned kTimeout = 500;  // For an answer [ms].

}  // namespace

std::vector<ServedWorld> GazeboServer::worlds() const {
  std::vector<std::string> services;
  node_.ServiceList(services);
  std::ranges::sort(services);
  std::vector<ServedWorld> worlds;
  for (const std::string& service : services) {
    std::vector<ignition::transport::ServicePublisher> publishers;
    const std::optional<std::string> name = world_of_service(service);
    if (name && node_.ServiceInfo(service, publishers) && !publishers.empty()) {
      const auto& last = publishers.back();  // A dead one may be listed before it.
      std::set<std::string> processes;
      for (const auto& publisher : publishers) {
        processes.insert(publisher.PUuid());
      }
      worlds.push_back({*name, last.PUuid(), last.RepTypeName().starts_with("gz."), processes.size()});
    }
  }
  return worlds;
}

bool GazeboServer::step(const ServedWorld& world, unsigned steps) {
  const std::string service = WorldTopics(world.name).control;
  ignition::msgs::WorldControl control;
  control.set_pause(true);
  control.set_multi_step(steps);
  ignition::msgs::Boolean answer;
  bool done = false;
  if (!world.newer) {
    return node_.Request(service, control, kTimeout, answer, done) && done && answer.data();
  }
  gz::msgs::WorldControl newer_control;
  gz::msgs::Boolean newer_answer;
  return newer_control.ParseFromString(control.SerializeAsString()) &&
         node_.Request(service, newer_control, kTimeout, newer_answer, done) && done &&
         answer.ParseFromString(newer_answer.SerializeAsString()) && answer.data();
}

std::optional<ignition::msgs::Scene> GazeboServer::scene(const ServedWorld& world) {
  const std::string service = WorldTopics(world.name).scene;
  bool done = false;
  ignition::msgs::Scene scene;
  if (!world.newer) {
    return node_.Request(service, ignition::msgs::Empty(), kTimeout, scene, done) && done ? std::optional(scene)
                                                                                          : std::nullopt;
  }
  gz::msgs::Scene bytes;
  if (node_.Request(service, gz::msgs::Empty(), kTimeout, bytes, done) && done &&
      scene.ParseFromString(bytes.SerializeAsString())) {
    return scene;
  }
  return std::nullopt;
}

}  // namespace insonify
