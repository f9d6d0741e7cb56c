// live_loop_fixture.h -- a small world, two sonars in it, and the pings of loops that steer them.

#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "insonify/files.h"
#include "insonify/live_loop.h"
#include "insonify/scenario_requests.h"
#include "insonify/simulator.h"
#include "live/live_pings.h"
#include "support/same_pings.h"
#include "support/working_folder.h"

namespace insonify {

inline constexpr const char* kWorld = R"(<?xml version="1.0"?>
<sdf version="1.9"><world name="pool">
  <model name="floor"><static>true</static><pose>0 0 -3 0 0 0</pose><link name="link"><visual name="sand">
    <geometry><box><size>60 60 0.2</size></box></geometry></visual></link></model>
  <model name="ball"><static>true</static><pose>7 1 -1.2 0 0 0</pose><link name="link"><visual name="ball">
    <geometry><sphere><radius>0.6</radius></sphere></geometry></visual></link></model>
</world></sdf>)";

// Two sonars whose pings meet at some times only.
inline std::string scenario_text(const std::string& more = "") {
  return R"(world: pool.sdf
seed: 11
ground_truth: labels
sonars:
  - {name: fls, beam_count: 24, bin_count: 90, azimuth_aperture_deg: 70, elevation_aperture_deg: 25, max_range: 12,
     ping_period: 0.03, position: [0.4, 0, -0.1], orientation_deg: [0, 11, 0], sampling: {columns_per_beam: 2, rows: 40}}
  - {name: head, type: msis, beam_count: 1, bin_count: 70, azimuth_aperture_deg: 4, elevation_aperture_deg: 30,
     max_range: 14, step_deg: 7, ping_period: 0.07, orientation_deg: [0, 5, 0], sampling: {columns_per_beam: 4, rows: 60}}
)" + more;
}

inline constexpr const char* kTrack = R"(trajectory:
  - {time: 0, position: [-1, 0.3, 0.2], orientation_deg: [0, 0, 3]}
  - {time: 7, position: [2, -0.4, 0.1], orientation_deg: [1, -2, 17]}
)";

// Velocities off every axis.
inline const LiveVelocity kAhead{{0.8, 0.1, -0.05}, {0.02, -0.03, 0.3}};
inline const LiveVelocity kAround{{-0.5, 0.6, 0.1}, {0, 0.1, -0.7}};

/// A pool with a floor and a ball, and loops in it.
class LiveLoopFixture : public testing::Test {
 protected:
  LiveLoopFixture() { folder_.write("pool.sdf", kWorld); }

  std::unique_ptr<LiveLoop> started(const std::string& text, const LiveOptions& options = {.threads = 2},
                                    const std::vector<std::string>& settings = {}) {
    folder_.write("live.yaml", text);
    auto loop = std::make_unique<LiveLoop>("live.yaml", settings, options);
    loop->start(keeper_);
    return loop;
  }

  // Every ping that a saved scenario asks for is the one that was made live.
  static void expect_repeats(const std::string& yaml, const std::vector<LivePing>& live) {
    const Scenario scenario = parse_scenario(yaml);
    const ScenarioRequests requests(scenario);
    Simulator simulator(scenario, load_scene(scenario), 2);
    std::vector<std::uint64_t> numbers(scenario.sonars.size(), 0);
    int uncounted = 0;  // Of two that are due together, the first has come when the loop ends within the second.
    for (const LivePing& ping : live) {
      if (ping.ping.number == requests.ping_count(ping.sonar) && ++uncounted == 1) {
        continue;
      }
      const std::uint64_t number = numbers[static_cast<std::size_t>(ping.sonar)]++;
      EXPECT_EQ(ping.ping.number, number);
      expect_same(ping.ping, simulator.make_ping(ping.sonar, number));
    }
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      EXPECT_EQ(requests.ping_count(static_cast<int>(i)), numbers[i]) << scenario.sonars[i].name;
    }
  }

  // Those of the last world that the loop has had.
  [[nodiscard]] std::vector<LivePing> pings_of(const LiveLoop& loop) const {
    std::vector<LivePing> pings = keeper_.pings();
    std::erase_if(pings, [&](const LivePing& ping) { return ping.world != loop.world(); });
    return pings;
  }

  WorkingFolder folder_;
  LiveKeeper keeper_;
};

}  // namespace insonify
