// bench_survey.cpp -- pings of side-scan sonars and multibeams over a rough bed, beside the instruments' own rates.

#include <string>

#include "benchmark/bench.h"
#include "benchmark/bench_scene.h"
#include "benchmark/bench_timing.h"
#include "insonify/files.h"
#include "insonify/simulator.h"

namespace insonify {
namespace {

constexpr int kLinePings = 64;

// An instrument on a line over a bed.
struct SurveyCase {
  const char* preset;
  const char* mode;
  double max_range, altitude;  // [m]
  int bins;
  double receiver_gain = 30;  // [dB per decade]
};

constexpr SurveyCase kSurveys[] = {{"edgetech-4125", "400khz", 75, 8, 2000},
                                   {"edgetech-4125", "400khz", 150, 15, 2000},
                                   {"r2sonic-2024", "400khz", 100, 30, 1000},
                                   {"r2sonic-2024", "400khz", 200, 60, 1000},
                                   {"r2sonic-2024", "200khz", 500, 150, 1000}};

Scenario survey_scenario(const SurveyCase& of) {
  SonarConfig sonar = load_preset(of.preset, of.mode).sonar;
  sonar.max_range = of.max_range;
  sonar.bin_count = of.bins;
  sonar.ping_period.reset();  // As often as echoes return.
  Scenario scenario;
  scenario.model = EchoModel::kCalibrated;
  scenario.engine = "cpu";
  scenario.motion_in_ping = sonar.is_side_scan();
  scenario.receiver.pulse = PulseKind::kInstrument;
  scenario.receiver.elevation_pattern = BeamPattern::kInstrument;
  scenario.receiver.time_varied_gain = of.receiver_gain;
  scenario.sonars = {sonar};
  return scenario;
}

// Requests of a line at 2 m/s over the middle of the bed.
std::vector<PingRequest> requests_of(const SurveyCase& of, double period) {
  constexpr double kSpeed = 2;
  std::vector<PingRequest> requests(kLinePings);
  for (int i = 0; i < kLinePings; ++i) {
    PingRequest& request = requests[static_cast<std::size_t>(i)];
    request.number = static_cast<std::uint64_t>(i);
    request.time = i * period;
    request.world_from_vehicle.position = {kSpeed * request.time, 0, of.altitude};
    request.twist.linear = {kSpeed, 0, 0};
  }
  return requests;
}

}  // namespace

int bench_survey(const BenchOptions& options) {
  say("Batches of {} pings along a line, medians of {}; x: times the rate at which the instrument pings there.\n\n"
      "{:>9} {:<14} {:<7} {:>7} {:>6} {:>6} {:>7} | {:>9} {:>9} {:>8}\n",
      kLinePings, options.repetitions, "triangles", "preset", "mode", "range m", "beams", "bins", "threads", "pings/s",
      "own rate", "x");
  BenchRows rows;
  rows.begin(
      "survey", "{:>9} {:<14} {:<7} {:>7} {:>6} {:>6} {:>7} | {:>9.1f} {:>9.1f} {:>8.1f}\n",
      {"triangles", "preset", "mode", "range_m", "beams", "bins", "threads", "pings_per_s", "own_rate", "times"});
  for (const int count : options.triangles) {
    const Scene scene = make_rough_bed(count);
    for (const SurveyCase& of : kSurveys) {
      for (const int threads : options.threads) {
        Simulator simulator(survey_scenario(of), scene, threads);
        const double period = simulator.sonar(0).ping_period.value();
        const std::vector<PingRequest> requests = requests_of(of, period);
        std::vector<Ping> pings(requests.size());
        std::vector<double> times;
        for (int turn = -1; turn < options.repetitions; ++turn) {
          const auto start = std::chrono::steady_clock::now();
          simulator.ping(0, requests, pings);
          if (turn >= 0) {
            times.push_back(milliseconds_since(start));
          }
        }
        const double rate = 1000 * kLinePings / median(times);
        rows.add(scene.triangle_count(), of.preset, of.mode, of.max_range, simulator.sonar(0).beam_count, of.bins,
                 threads, rate, 1 / period, rate * period);
      }
    }
  }
  rows.write(options.json);
  return 0;
}

}  // namespace insonify
