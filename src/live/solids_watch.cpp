// solids_watch.cpp -- compares the objects around a sonar with those of the last check.

#include "live/solids_watch.h"

#include <fmt/format.h>

namespace insonify {

std::vector<std::string> SolidsWatch::entered(Simulator& simulator, int sonar, const PingRequest& request) {
  constexpr std::chrono::seconds kInterval{1};
  const Clock::time_point now = Clock::now();
  const auto known = seen_.find(sonar);
  if (known != seen_.end() && now - known->second.when < kInterval) {
    return {};
  }
  Seen seen{.inside = {}, .when = now};
  std::vector<std::string> texts;
  const Scene scene = simulator.scene_at(request);
  for (const int inside : scene.solids_around(simulator.world_from_head(sonar, request).position)) {
    seen.inside.insert(inside);
    if (known == seen_.end() || !known->second.inside.contains(inside)) {
      texts.push_back(fmt::format("{} is inside of {}, and receives its inner surface", simulator.sonar(sonar).name,
                                  scene.instances[static_cast<std::size_t>(inside)].name));
    }
  }
  seen_[sonar] = std::move(seen);
  return texts;
}

}  // namespace insonify
