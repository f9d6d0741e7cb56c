// made_recording.h -- recordings of pings whose every value tells its ping and its cell.

#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

#include "insonify/files.h"
#include "support/test_files.h"

namespace insonify {

inline SonarConfig fan_sonar() {
  SonarConfig sonar;
  sonar.name = "bow";
  sonar.model = "Märzen 7";  // Not ASCII.
  sonar.frequency = 455e3;
  sonar.beam_count = 3;
  sonar.azimuth_aperture = std::numbers::pi / 2;
  sonar.bin_count = 4;
  sonar.min_range = 1;
  sonar.max_range = 9;
  sonar.ping_period = 0.2;
  sonar.position = {1, 2, -3};
  sonar.sampling.rows = 77;
  return sonar;
}

inline SonarConfig scanning_sonar() {
  SonarConfig sonar = fan_sonar();
  sonar.type = SonarType::kMechanicallyScanned;
  sonar.beam_count = 1;
  sonar.head.mounting = Mounting::kVertical;
  return sonar;
}

inline SonarConfig swath_sonar() {
  SonarConfig sonar = fan_sonar();
  sonar.type = SonarType::kMultibeam;
  return sonar;
}

// With datasets large enough to be compressed.
inline SonarConfig large_sonar() {
  SonarConfig sonar = fan_sonar();
  sonar.beam_count = 24;
  sonar.bin_count = 60;
  return sonar;
}

inline Scenario scenario() {
  Scenario scenario;
  scenario.model = EchoModel::kPaper;
  scenario.text = "world: wreck.sdf\nmodel: paper\n";
  scenario.engine = "reference";
  scenario.seed = 18'446'744'073'709'551'615U;
  scenario.secondary = SecondaryEchoes::kAll;
  scenario.water.salinity = 7.5;
  scenario.water.sound_speed = 1477;
  scenario.paper.sigmoid = Sigmoid::kAuthors;
  scenario.receiver.noise = false;
  return scenario;
}

inline Scene scene() {
  Scene scene;
  for (const char* name : {"ship::hull", "seabed"}) {
    scene.instances.emplace_back();
    scene.instances.back().name = name;
    scene.instances.back().mesh = std::make_shared<const Mesh>();
  }
  scene.materials.push_back(
      {.name = "steel", .density = 7700, .sound_speed = 5900, .reflectivity = 0.875, .source = ""});
  return scene;
}

// Every value encodes its ping and its cell.
inline Ping make_ping(const SonarConfig& sonar, std::uint64_t number) {
  Ping ping;
  ping.number = number;
  const auto n = static_cast<double>(number);
  ping.time = 0.5 * n;
  ping.world_from_sonar.position = {n, n + 0.25, n + 0.5};
  ping.world_from_sonar.orientation = {0.5, -0.5, 0.5, -0.5};
  ping.head_angle = -0.125 * n;
  ping.bin_count = sonar.bin_count;
  ping.beam_count = sonar.beam_count;
  for (int cell = 0; cell < sonar.bin_count * sonar.beam_count; ++cell) {
    ping.intensity.push_back(static_cast<float>(100 * number) + static_cast<float>(cell));
    ping.instance.push_back(cell % 2 == 0 ? kNoLabel : static_cast<std::uint16_t>(cell + 1));
    ping.material.push_back(static_cast<std::uint16_t>(cell + 2));
    ping.elevation.push_back(cell % 2 == 0 ? std::nanf("") : -0.5F * static_cast<float>(cell));
    for (int rank = 0; rank < kStrongestCount; ++rank) {
      ping.strongest_instance.push_back(static_cast<std::uint16_t>(3 * cell + rank));
      ping.strongest_share.push_back(0.25F * static_cast<float>(cell) / static_cast<float>(1 + rank));
    }
    ping.elevation_spread.push_back(0.125F * static_cast<float>(cell));
    ping.path_order.push_back(static_cast<std::uint8_t>(cell % 4));
    ping.shadow.push_back(1 / static_cast<float>(1 + cell));
    ping.direct_intensity.push_back(static_cast<float>(10 * number) + static_cast<float>(cell));
  }
  for (int beam = 0; sonar.is_multibeam() && beam < sonar.beam_count; ++beam) {
    Sounding sounding;
    sounding.range = static_cast<float>(number) + 0.5F * static_cast<float>(beam);
    sounding.snippet_end = 2 + beam;
    sounding.detection = beam % 2 == 0 ? Detection::kAmplitude : Detection::kPhase;
    ping.soundings.push_back(sounding);
  }
  return ping;
}

inline std::filesystem::path scratch(const std::string& name) {
  return process_folder() / ("recording_test_" + name + ".h5");
}

// Likewise, after removing what an earlier test has left.
inline std::filesystem::path fresh(const std::string& name) {
  const std::filesystem::path path = scratch(name);
  std::filesystem::remove(path);
  return path;
}

inline void record(const std::filesystem::path& path, const SonarConfig& sonar, std::uint64_t pings,
                   GroundTruth ground_truth = GroundTruth::kLabels, const RecordingOptions& options = {}) {
  Scenario recorded = scenario();
  recorded.ground_truth = ground_truth;
  std::filesystem::remove(path);
  Recording recording(path, recorded, scene(), sonar, options);
  for (std::uint64_t number = 0; number < pings; ++number) {
    recording.add(make_ping(sonar, number));
  }
  recording.close();
}

inline std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace insonify
