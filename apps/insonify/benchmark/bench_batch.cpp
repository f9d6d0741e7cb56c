// bench_batch.cpp -- times batches of pings against the same pings one by one.

#include <string>

#include "benchmark/bench.h"
#include "benchmark/bench_scene.h"
#include "benchmark/bench_timing.h"
#include "insonify/simulator.h"

namespace insonify {
namespace {

constexpr int kBatchPings = 64;

// What is crossed with a batch.
struct BatchCase {
  const char* name;
  EchoModel model = EchoModel::kCalibrated;
  int beams = 32, bins = 100;
  bool sea = false;       // A sea surface.
  bool coarsely = false;  // 4 columns a beam x 100 rows.
};

constexpr BatchCase kCases[] = {{"small, paper", EchoModel::kPaper},
                                {"small"},
                                {"small, coarse", EchoModel::kCalibrated, 32, 100, false, true},
                                {"small, sea", EchoModel::kCalibrated, 32, 100, true},
                                {"large", EchoModel::kCalibrated, 256, 500}};

Scenario batch_scenario(const BatchCase& of) {
  Scenario scenario;
  scenario.model = of.model;
  scenario.engine = "cpu";
  SonarConfig sonar = bench_sonar();
  sonar.beam_count = of.beams;
  sonar.bin_count = of.bins;
  if (of.coarsely) {
    sonar.sampling = {.columns_per_beam = 4, .rows = 100};
  }
  scenario.sonars = {sonar};
  if (of.sea) {
    scenario.surface = SeaSurface{.level = 2, .wind_speed = 3};
  }
  return scenario;
}

// One ping every 10 cm and 1 degree.
std::vector<PingRequest> requests_on_a_path() {
  std::vector<PingRequest> requests(kBatchPings);
  for (int i = 0; i < kBatchPings; ++i) {
    requests[i].number = static_cast<std::uint64_t>(i);
    requests[i].world_from_vehicle = {{0.1 * i, 0, 0},
                                      orientation_from_rpy(0, 0, radians_from_degrees(i - 0.5 * kBatchPings))};
  }
  return requests;
}

// Medians of the time of all pings [ms].
struct BatchTimes {
  double alone = 0, together = 0;
};

BatchTimes time_batch(const BatchCase& of, const Scene& scene, int threads, int repetitions) {
  Simulator simulator(batch_scenario(of), scene, threads);
  const std::vector<PingRequest> requests = requests_on_a_path();
  std::vector<Ping> pings(requests.size());
  std::vector<double> alone, together;
  constexpr int kWarmUp = 1;
  for (int turn = -kWarmUp; turn < repetitions; ++turn) {
    const auto start = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < requests.size(); ++i) {
      simulator.ping(0, requests[i], pings[i]);
    }
    const double one_by_one = milliseconds_since(start);
    const auto then = std::chrono::steady_clock::now();
    simulator.ping(0, requests, pings);
    if (turn >= 0) {
      alone.push_back(one_by_one);
      together.push_back(milliseconds_since(then));
    }
  }
  return {median(alone), median(together)};
}

}  // namespace

int bench_batch(const BenchOptions& options) {
  say("{} pings one by one and as a batch, in turn; medians of {} of each.\n\n{:>9} {:<13} {:>7} | {:>9} {:>9} {:>6}\n",
      kBatchPings, options.repetitions, "triangles", "pings", "threads", "alone ms", "batch ms", "ratio");
  BenchRows rows;
  rows.begin("batch", "{:>9} {:<13} {:>7} | {:>9.2f} {:>9.2f} {:>6.2f}\n",
             {"triangles", "pings", "threads", "alone_ms", "batch_ms", "ratio"});
  for (const int count : options.triangles) {
    const Scene scene = make_bench_scene(count);
    for (const BatchCase& of : kCases) {
      for (const int threads : options.threads) {
        const BatchTimes times = time_batch(of, scene, threads, options.repetitions);
        rows.add(scene.triangle_count(), of.name, threads, times.alone, times.together, times.alone / times.together);
      }
    }
  }
  rows.write(options.json);
  return 0;
}

}  // namespace insonify
