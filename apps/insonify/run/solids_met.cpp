// solids_met.cpp -- tests poses of a run, with all objects placed as at that time.

#include "run/solids_met.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace insonify {
namespace {

// Numbers of pings from the first to the last.
std::vector<std::uint64_t> spread_pings(std::uint64_t pings, std::uint64_t most) {
  const std::uint64_t count = std::min(pings, most);
  std::vector<std::uint64_t> numbers;
  for (std::uint64_t i = 0; i < count; ++i) {
    numbers.push_back(count > 1 ? i * (pings - 1) / (count - 1) : 0);
  }
  return numbers;
}

}  // namespace

std::vector<std::string> solids_met(Simulator& simulator, const ScenarioRequests& requests, int sonar) {
  constexpr std::uint64_t kMostPings = 32, kMostTriangles = 2'000'000;  // Together about 0.2 s.
  const std::uint64_t most =
      std::clamp<std::uint64_t>(kMostTriangles / (simulator.scene().triangle_count() + 1), 2, kMostPings);
  std::set<int> met;
  std::vector<std::string> texts;
  for (const std::uint64_t ping : spread_pings(requests.ping_count(sonar), most)) {
    const PingRequest request = requests.at(sonar, ping);
    const Scene scene = simulator.scene_at(request);
    for (const int inside : scene.solids_around(simulator.world_from_head(sonar, request).position)) {
      if (met.insert(inside).second) {
        texts.push_back(fmt::format("{} {} inside of {}, and receives its inner surface", simulator.sonar(sonar).name,
                                    ping == 0 ? "begins" : fmt::format("is at ping {}", ping),
                                    scene.instances[inside].name));
      }
    }
  }
  return texts;
}

}  // namespace insonify
