// simulator_state.cpp -- sets up a simulator, and loads its scene.

#include "simulator/simulator_state.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/log_line.h"
#include "echo/choose_engine.h"
#include "insonify/error.h"
#include "simulator/checks.h"

namespace insonify {

namespace {

PingLoad load_of(const Scene& scene, std::span<const SimulatedSonar> sonars, int threads, std::uint64_t pings) {
  PingLoad load{.triangles = static_cast<double>(scene.triangle_count()), .threads = threads, .pings = pings};
  for (const SimulatedSonar& sonar : sonars) {
    load.beams = std::max(load.beams, sonar.config.beam_count);
    for (const Aperture& aperture : sonar.apertures) {
      load.samples += static_cast<double>(aperture.plan->lattice.columns) * aperture.plan->lattice.rows;
    }
  }
  return load;
}

}  // namespace

Simulator::State::State(Scenario the_scenario, Scene the_scene, int threads, std::span<const MovableObject> movable,
                        const Log& log, std::uint64_t pings)
    : scenario(std::move(the_scenario)), scene(std::move(the_scene)), workers(threads) {
  try {
    objects.add(scenario.motions, scene);
  } catch (const Error& error) {
    throw error.located(scenario.places);
  }
  objects.add(movable, scene, 0, scene.instances.size());
  objects.add_marked(scene, 0, scene.instances.size());
  if (scenario.surface) {
    sea.emplace(scenario, scene);
  }
  if (LayeredWater::is_of(scenario)) {
    layers.emplace(scenario);
    if (scenario.model == EchoModel::kCalibrated) {
      log_line(log, Severity::kWarning,
               "water.profile bends rays: thin parts, edges and glints of plane faces echo as other surfaces do, and "
               "there are no images of points by mirrors, nor paths back over the water's surface");
    }
  }
  for (const SonarConfig& sonar : scenario.sonars) {
    sonars.push_back(simulated(scenario, sonar));
  }
  set_senders();
  start_engine(log, pings);
  load_scene();
}

void Simulator::State::start_engine(const Log& log, std::uint64_t pings) {
  if (scenario.engine == kAutoEngine) {
    PingLoad load = load_of(scene, sonars, workers.count(), pings);
    load.bends_rays = layers.has_value();
    const EngineChoice choice = choose_engine(load, scenario.device);
    engine_choice = choice.text;
    if (choice.kind->find_hardware == nullptr) {
      engine = choice.kind->make(workers, "");
    } else {
      auto on_device = std::make_unique<SpareEngine>(*choice.kind, scenario.device, workers, log);
      spare = on_device.get();
      engine = std::move(on_device);
    }
  } else {
    engine = make_engine(scenario.engine, workers, scenario.device);
  }
  if (scenario.model == EchoModel::kPaper) {
    engine->expect_paper();
  }
  if (layers) {
    if (!engine->kind().bends_rays) {
      throw Error("", "engine",
                  fmt::format(" = {} traces straight rays, and water.profile bends them; use cpu, reference or auto",
                              engine->kind().name),
                  {"water.profile"})
          .located(scenario.places);
    }
    engine->expect_refraction();
  }
}

void Simulator::State::start_runner() {
  runner.emplace(*engine, workers);
  scenario.engine = engine->kind().name;
}

void Simulator::State::set_senders() {
  senders.clear();
  for (std::size_t i = 0; scenario.mutual_interference && i < sonars.size(); ++i) {
    for (const Aperture& aperture : sonars[i].apertures) {
      senders.emplace_back(sonars[i], aperture, scenario.receiver_of(aperture.config));
    }
  }
  forget_sources();  // They refer to the senders.
}

void Simulator::State::forget_sources() {
  for (SimulatedSonar& sonar : sonars) {
    for (Aperture& aperture : sonar.apertures) {
      aperture.sources.clear();
    }
  }
}

SimulatedSonar Simulator::State::simulated(const Scenario& in, const SonarConfig& sonar) const {
  return {in, sonar, materials_at(sonar.frequency, in, scene)};
}

SimulatedSonar& Simulator::State::sonar(int index) {
  return sonars[sonar_index(index, sonars.size())];
}

void Simulator::State::load_scene() {
  if (!scene_changed) {
    return;
  }
  check_profile_covers(scenario, scene);
  engine->set_scene(scene);
  start_runner();
  at_home.clear();
  for (const Instance& instance : scene.instances) {
    at_home.push_back(instance.world_from_mesh);
  }
  if (layers) {
    targets = no_targets();
  } else if (scenario.model == EchoModel::kCalibrated) {
    std::optional<WaterMirror> water;
    if (sea) {
      water = WaterMirror{.level = scenario.surface->level, .surface = sea->label()};
    }
    const bool corners = scenario.secondary != SecondaryEchoes::kNone && scenario.max_surfaces >= 3;
    const WantedTargets wanted{.mirrors = !scenario.points.empty(), .corners = corners};
    targets = find_targets(scene, water, wanted, *engine, workers);
  }
  forget_sources();
  scene_changed = false;
}

}  // namespace insonify
