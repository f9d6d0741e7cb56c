// bench_models.cpp -- cost of the calibrated model relative to the paper's on the same rays, feature by feature.

#include <algorithm>
#include <chrono>
#include <functional>

#include "benchmark/bench.h"
#include "benchmark/bench_scene.h"
#include "benchmark/bench_timing.h"
#include "insonify/simulator.h"

namespace insonify {
namespace {

// Each stage has all features of the stages before it.
struct Stage {
  const char* name;
  void (*add)(Scenario& scenario);
};
constexpr Stage kStages[] = {
    {"paper", [](Scenario&) {}},
    {"calibrated",
     [](Scenario& scenario) {
       scenario.model = EchoModel::kCalibrated;
       scenario.receiver.noise = scenario.receiver.speckle = false;
       scenario.receiver.azimuth_pattern = BeamPattern::kTopHat;
     }},
    {"+ array", [](Scenario& scenario) { scenario.receiver.azimuth_pattern = BeamPattern::kRectangular; }},
    {"+ pulse",
     [](Scenario& scenario) {
       scenario.receiver.pulse = PulseKind::kLfm;
       scenario.receiver.pulse_duration = 1e-3;
       scenario.receiver.pulse_bandwidth = 50e3;
     }},
    {"+ speckle", [](Scenario& scenario) { scenario.receiver.speckle = true; }},
    {"+ noise", [](Scenario& scenario) { scenario.receiver.noise = true; }},
    {"+ reverberation", [](Scenario& scenario) { scenario.water.volume_backscatter_db = -70; }},
    {"+ full truth", [](Scenario& scenario) { scenario.ground_truth = GroundTruth::kFull; }},
};
constexpr std::size_t kStageCount = std::size(kStages);

// All stages trace the same rays: traced primaries, paths of up to two surfaces.
Scenario scenario_of(std::size_t stage) {
  Scenario scenario;
  scenario.sonars = {bench_sonar()};
  scenario.engine = "cpu";
  scenario.sonars[0].azimuth_resolution = radians_from_degrees(1);
  scenario.primary = PrimaryEchoes::kRays;
  scenario.secondary = SecondaryEchoes::kSelective;
  scenario.max_surfaces = 2;
  scenario.model = EchoModel::kPaper;
  for (std::size_t i = 0; i <= stage; ++i) {
    kStages[i].add(scenario);
  }
  return scenario;
}

// Times of each stage's pings [ms]. Stages alternate, so that varying load of a shared machine affects all alike.
std::vector<std::vector<double>> time_stages(const Scene& scene, int threads, int repetitions) {
  std::vector<Simulator> simulators;
  for (std::size_t stage = 0; stage < kStageCount; ++stage) {
    simulators.emplace_back(scenario_of(stage), scene, threads);
  }
  std::vector<Ping> pings(kStageCount);
  std::vector<std::vector<double>> times(kStageCount);
  constexpr int kWarmUp = 2;
  for (int i = -kWarmUp; i < repetitions; ++i) {
    for (std::size_t stage = 0; stage < kStageCount; ++stage) {
      const auto start = std::chrono::steady_clock::now();
      simulators[stage].ping(0, {.number = static_cast<std::uint64_t>(i + kWarmUp)}, pings[stage]);
      if (i >= 0) {
        times[stage].push_back(milliseconds_since(start));
      }
    }
  }
  return times;
}

// Median over turns of how much longer a stage takes than an earlier one.
double median_difference(const std::vector<double>& later, const std::vector<double>& earlier) {
  std::vector<double> values(later.size());
  std::ranges::transform(later, earlier, values.begin(), std::minus());
  return median(std::move(values));
}

}  // namespace

void bench_models(const BenchOptions& options, BenchRows& rows) {
  say("\nThe calibrated model (2 x 256 samples a beam by its rule) beside the paper's (4 x 200): primaries traced,\n"
      "`selective`, two surfaces. Each line has all that is above it and was timed in turn with the others; x: times\n"
      "the paper model's ping.\n\n"
      "{:>9} {:>7} {:<16} | {:>8} {:>8} {:>6}\n",
      "triangles", "threads", "", "ping ms", "more ms", "x");
  rows.begin("models", "{:>9} {:>7} {:<16} | {:>8.2f} {:>8.2f} {:>6.2f}\n",
             {"triangles", "threads", "stage", "ping_ms", "more_ms", "times_paper"});
  for (const int count : options.triangles) {
    const Scene scene = make_bench_scene(count);
    for (const int threads : options.threads) {
      const std::vector<std::vector<double>> times = time_stages(scene, threads, options.repetitions);
      for (std::size_t stage = 0; stage < kStageCount; ++stage) {
        const double more = stage == 0 ? 0 : median_difference(times[stage], times[stage - 1]);
        rows.add(scene.triangle_count(), threads, kStages[stage].name, median(times[stage]), more,
                 median_ratio(times[stage], times[0]));
      }
    }
  }
}

}  // namespace insonify
