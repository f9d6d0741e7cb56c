// bench_device.cpp -- pings of engine gpu, one by one and in batches, beside those of engine cpu, and the device's
// steps.

#include <chrono>
#include <string>

#include "benchmark/bench.h"
#include "benchmark/bench_scene.h"
#include "benchmark/bench_timing.h"
#include "insonify/simulator.h"

namespace insonify {
namespace {

constexpr int kBatches[] = {1, 16, 256};

Scenario device_scenario(EchoModel model, const char* engine, const std::string& device) {
  Scenario scenario;
  scenario.model = model;
  scenario.engine = engine;
  scenario.device = device;
  scenario.sonars = {bench_sonar()};
  return scenario;
}

// Medians of one row, each of a ping [ms].
struct DeviceRow {
  double setup_ms = 0;  // Once.
  double ping_ms = 0;
  double device_ms = 0;  // Of all steps; 0 on the host.
  std::vector<std::pair<std::string, double>> steps;
};

DeviceRow time_row(const Scenario& scenario, const Scene& scene, int batch, int pings) {
  const auto start = std::chrono::steady_clock::now();
  Simulator simulator(scenario, scene, 0);
  DeviceRow row;
  std::vector<PingRequest> requests(static_cast<std::size_t>(batch));
  for (int i = 0; i < batch; ++i) {
    requests[i].number = static_cast<std::uint64_t>(i);
    requests[i].world_from_vehicle.position.x() = 0.02 * i;
  }
  std::vector<Ping> made(requests.size());
  std::vector<double> times;
  std::vector<std::vector<double>> steps;
  for (int done = -kWarmUpPings * batch; done < pings; done += batch) {
    const auto then = std::chrono::steady_clock::now();
    simulator.ping(0, requests, made);
    if (done == -kWarmUpPings * batch) {
      row.setup_ms = milliseconds_since(start);
    }
    if (done < 0) {
      continue;
    }
    times.push_back(milliseconds_since(then) / batch);
    const std::vector<StepTime> on_device = simulator.step_times();
    steps.resize(on_device.size());
    for (std::size_t i = 0; i < on_device.size(); ++i) {
      steps[i].push_back(kMilliseconds * on_device[i].seconds / batch);
    }
    if (done < batch) {
      row.steps.clear();
      for (const StepTime& step : on_device) {
        row.steps.emplace_back(step.step, 0);
      }
    }
  }
  row.ping_ms = median(times);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    row.steps[i].second = median(steps[i]);
    row.device_ms += row.steps[i].second;
  }
  return row;
}

}  // namespace

int bench_device(const BenchOptions& options) {
  say("Devices: {}\n", fmt::format("{}", fmt::join(device_texts(), "; ")));
  say("256 beams x 500 bins, 120 x 20 degrees, 20 m, 4 x 200 samples a beam, selective, labels; whole pings, medians "
      "of {}\n"
      "or more, one by one and in batches. device: all steps on the device; set-up with the first ping.\n\n"
      "{:>9} {:<10} {:<6} {:>5} {:>9} {:>8} {:>9} {:>9}  {}\n",
      options.repetitions, "triangles", "model", "engine", "batch", "setup ms", "ping ms", "pings/s", "device ms",
      "steps [ms]");
  BenchRows rows;
  rows.begin("device", "{:>9} {:<10} {:<6} {:>5} {:>9.1f} {:>8.3f} {:>9.1f} {:>9.3f} {}\n",
             {"triangles", "model", "engine", "batch", "setup_ms", "ping_ms", "pings_per_s", "device_ms", "steps"});
  for (const int count : options.triangles) {
    const Scene scene = make_bench_scene(count);
    for (const auto& [model, model_name] :
         {std::pair{EchoModel::kPaper, "paper"}, std::pair{EchoModel::kCalibrated, "calibrated"}}) {
      for (const char* engine : {"cpu", "gpu"}) {
        for (const int batch : kBatches) {
          const DeviceRow row = time_row(device_scenario(model, engine, options.device), scene, batch,
                                         std::max(options.repetitions, batch));
          std::string steps;
          for (const auto& [name, time] : row.steps) {
            steps += fmt::format(" {} {:.3f}", name, time);
          }
          rows.add(scene.triangle_count(), model_name, engine, batch, row.setup_ms, row.ping_ms,
                   kMilliseconds / row.ping_ms, row.device_ms, steps)["steps_ms"] = row.steps;
        }
      }
    }
  }
  rows.write(options.json);
  return 0;
}

}  // namespace insonify
