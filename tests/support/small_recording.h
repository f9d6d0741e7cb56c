// small_recording.h -- a ping to record, for tests that damage recordings.

#pragma once

#include <memory>

#include "insonify/files.h"
#include "insonify/mesh.h"
#include "insonify/ping.h"

namespace insonify {

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

}  // namespace insonify
