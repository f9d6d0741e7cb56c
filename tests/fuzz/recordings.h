// recordings.h -- small recordings for the fuzzers of recordings to damage, and what is read of them.

#pragma once

#include <fstream>
#include <iterator>
#include <memory>

#include "fuzz/fuzzer.h"
#include "insonify/files.h"
#include "insonify/mcap_recording.h"
#include "insonify/mesh.h"
#include "insonify/recorded_pings.h"
#include "insonify/recording_info.h"

namespace insonify::fuzz {

/// A ping of 3 bins x 4 beams of a sonar at a sphere, written by `write(scenario, scene, sonar, ping)`.
template <typename Write>
void record_ping(const Write& write) {
  Scenario scenario;
  scenario.text = "world: nothing.sdf\n";
  SonarConfig sonar;
  sonar.name = "ahead";
  sonar.bin_count = 3;
  sonar.beam_count = 4;
  Scene scene;
  scene.instances.push_back({.name = "wreck::hull", .mesh = std::make_shared<const Mesh>(make_sphere(1))});
  assign_materials(scene, {});
  Ping ping;
  ping.bin_count = 3;
  ping.beam_count = 4;
  ping.intensity.assign(12, 0.25F);
  ping.instance.assign(12, 0);
  ping.material.assign(12, 0);
  ping.elevation.assign(12, 0.5F);
  write(scenario, scene, sonar, ping);
}

/// Reads all that commands read.
inline void read_recording(const std::filesystem::path& path) {
  static_cast<void>(recording_info(path));
  const RecordedPings pings(path);
  static_cast<void>(pings.receiver_config());
  for (std::uint64_t i = 0; i < std::min<std::uint64_t>(pings.ping_count(), 2); ++i) {
    const Ping ping = pings.ping(i);
    expect(ping.intensity.size() == static_cast<std::size_t>(pings.bin_count()) * pings.beam_count());
  }
}

inline std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace insonify::fuzz
