// solids_met.cpp -- tries poses of a run, with everything where it is at that time.

#include "solids_met.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace insonify {
namespace {

// Moves the scene's objects to where the scenario's motions have them at a time. In the scene they are as at time 0.
void move_objects(const Simulator& simulator, double time, Scene& scene) {
  for (const Motion& motion : simulator.scenario().motions) {
    const Pose world_from_start = motion.trajectory.at(time) * motion.trajectory.at(0).inverse();
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
      const std::string& name = scene.instances[i].name;
      if (name == motion.object || name.starts_with(motion.object + "::")) {
        scene.instances[i].world_from_mesh = world_from_start * simulator.scene().instances[i].world_from_mesh;
      }
    }
  }
}

std::uint64_t triangles_in(const Scene& scene) {
  std::uint64_t triangles = 0;
  for (const Instance& instance : scene.instances) {
    triangles += instance.mesh->triangles.size();
  }
  return triangles;
}

// Numbers of pings from the first to the last.
std::vector<std::uint64_t> spread_pings(std::uint64_t pings, std::uint64_t most) {
  const std::uint64_t count = std::min(pings, most);
  std::vector<std::uint64_t> numbers;
  for (std::uint64_t i = 0; i < count; ++i) {
    const double share = count > 1 ? static_cast<double>(i) / static_cast<double>(count - 1) : 0;
    numbers.push_back(static_cast<std::uint64_t>(share * static_cast<double>(pings - 1)));
  }
  return numbers;
}

}  // namespace

std::vector<std::string> solids_met(const Simulator& simulator, const ScenarioRequests& requests, int sonar) {
  constexpr std::uint64_t kMostPings = 32, kMostTriangles = 2'000'000;  // Together about 0.2 s.
  Scene scene = simulator.scene();
  const std::uint64_t most = std::clamp<std::uint64_t>(kMostTriangles / (triangles_in(scene) + 1), 2, kMostPings);
  std::set<int> met;
  std::vector<std::string> texts;
  for (const std::uint64_t ping : spread_pings(requests.ping_count(sonar), most)) {
    const PingRequest request = requests.at(sonar, ping);
    move_objects(simulator, request.time, scene);
    for (const int inside : scene.solids_around(simulator.world_from_head(sonar, request).position)) {
      if (met.insert(inside).second) {
        texts.push_back(
            fmt::format("{} {} inside of {}, whose surface it hears from within", simulator.sonar(sonar).name,
                        ping == 0 ? "begins" : fmt::format("is at ping {}", ping), scene.instances[inside].name));
      }
    }
  }
  return texts;
}

}  // namespace insonify
