// bench_sampling.cpp -- sampling error of pings against converged ones, beside their computing times.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <memory>
#include <span>

#include "benchmark/bench.h"
#include "benchmark/bench_scene.h"
#include "benchmark/bench_timing.h"
#include "insonify/error.h"
#include "insonify/files.h"
#include "insonify/scenario_requests.h"
#include "insonify/simulator.h"

namespace insonify {
namespace {

// Sampling error of one or more images, without noise and speckle. Levels are compared where either image is within
// `range_db` of the loudest cell of the converged one; what is lower reads as that level, as in a picture that ends
// there.
class SamplingError {
 public:
  // @param range_db  [dB], > 0.
  explicit SamplingError(double range_db) : range_db_(range_db) {}

  // Adds one image. Nothing is added where the converged one is zero everywhere.
  // @param full_scale  The level that `range_db` is counted from; as a rule the largest value of the converged ping.
  void add(std::span<const float> image, std::span<const float> converged, float full_scale) {
    constexpr double kSpot = 6;  // [dB]
    if (!(full_scale > 0)) {
      return;
    }
    const double floor = double{full_scale} * std::pow(10, -range_db_ / 10);
    for (std::size_t i = 0; i < image.size(); ++i) {
      const double here = image[i], there = converged[i];
      sum_ += here;
      converged_sum_ += there;
      if (std::max(here, there) < floor) {
        continue;
      }
      const double difference = 10 * std::log10(std::max(here, floor) / std::max(there, floor));
      squares_ += difference * difference;
      ++cells_;
      spots_ += difference > kSpot ? 1 : 0;
      holes_ += difference < -kSpot ? 1 : 0;
    }
  }

  // Root of the mean squared difference of levels [dB]; 0 without cells.
  [[nodiscard]] double rms_db() const { return cells_ > 0 ? std::sqrt(squares_ / static_cast<double>(cells_)) : 0; }

  // Share of the cells that are more than 6 dB too loud.
  [[nodiscard]] double spots() const {
    return cells_ > 0 ? static_cast<double>(spots_) / static_cast<double>(cells_) : 0;
  }

  // Share of the cells that are more than 6 dB too faint.
  [[nodiscard]] double holes() const {
    return cells_ > 0 ? static_cast<double>(holes_) / static_cast<double>(cells_) : 0;
  }

  // Sum of the images re the sum of the converged ones [dB]; 0 without cells.
  [[nodiscard]] double level_db() const {
    return sum_ > 0 && converged_sum_ > 0 ? 10 * std::log10(sum_ / converged_sum_) : 0;
  }

 private:
  double range_db_;
  double squares_ = 0, sum_ = 0, converged_sum_ = 0;
  long long cells_ = 0, spots_ = 0, holes_ = 0;
};

constexpr double kPictureRange = 60;  // Range of levels that is compared [dB].

// A scenario whose first sonar is examined, in the calibrated model.
struct Case {
  std::string name;
  Scenario scenario;
  Scene scene;
};

Case generated_case(int triangles) {
  Case made;
  made.scene = make_bench_scene(triangles);
  made.name = fmt::format("{} triangles", made.scene.triangle_count());
  made.scenario.engine = "cpu";
  made.scenario.sonars = {bench_sonar()};
  made.scenario.trajectory.waypoints = {{.time = 0}, {.time = 60, .position = {3, 0.7, 0.2}}};
  return made;
}

Case case_of(const std::filesystem::path& file) {
  Case made;
  made.name = file.stem().string();
  made.scenario = load_scenario(file);
  if (made.scenario.model != EchoModel::kCalibrated) {
    throw Error(
        fmt::format("{}: has model: paper; bench sampling takes scenarios of the calibrated model", file.string()));
  }
  made.scene = load_scene(made.scenario);
  made.scenario = flown(std::move(made.scenario), made.scene);
  return made;
}

// Mean images: all echoes, and those of paths with more than one surface alone.
struct Images {
  std::vector<float> all, secondary;
  RayCounts rays;
};

// The pings that are compared, spread over those of the scenario.
std::vector<PingRequest> requests_of(const Scenario& scenario, int count) {
  const ScenarioRequests requests(scenario);
  const std::uint64_t pings = std::max<std::uint64_t>(requests.ping_count(0), 1);
  std::vector<PingRequest> chosen;
  chosen.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    chosen.push_back(requests.at(0, pings * static_cast<std::uint64_t>(i) / static_cast<std::uint64_t>(count)));
  }
  return chosen;
}

// With neither noise nor speckle nor gain, a cell's intensity is its expectation.
std::vector<Images> mean_images(const Case& of, const Sampling& sampling, std::span<const PingRequest> requests,
                                int threads) {
  Scenario scenario = of.scenario;
  scenario.ground_truth = GroundTruth::kFull;
  SonarConfig& sonar = scenario.sonars[0];
  sonar.sampling = sampling;
  ReceiverConfig receiver = scenario.receiver_of(sonar);
  receiver.noise = receiver.speckle = receiver.field = receiver.counts = false;
  receiver.saturation_db.reset();
  receiver.time_varied_gain.reset();
  receiver.gain_ranges.clear();
  receiver.gains_db.clear();
  sonar.receiver = receiver;
  Simulator simulator(scenario, of.scene, threads);
  std::vector<Images> images;
  Ping ping;
  for (const PingRequest& request : requests) {
    simulator.ping(0, request, ping);
    Images& image = images.emplace_back();
    image.rays = simulator.ray_counts();
    image.all = ping.intensity;
    for (std::size_t i = 0; i < image.all.size(); ++i) {
      image.secondary.push_back(std::max(0.0F, ping.intensity[i] - ping.direct_intensity[i]));
    }
  }
  return images;
}

// One sampling of a case: its error, and a simulator with all effects of the scenario to be timed.
struct Candidate {
  std::string name;
  Sampling sampling;
  SamplingError all{kPictureRange}, secondary{kPictureRange};
  RayCounts rays;
  std::unique_ptr<Simulator> simulator;
  std::vector<double> milliseconds = {}, processor = {};  // Elapsed, and of all threads.
};

void compare(std::span<const Images> images, std::span<const Images> converged, Candidate& candidate) {
  for (std::size_t i = 0; i < images.size(); ++i) {
    const float loudest = *std::ranges::max_element(converged[i].all);
    candidate.all.add(images[i].all, converged[i].all, loudest);
    candidate.secondary.add(images[i].secondary, converged[i].secondary, loudest);
    candidate.rays += images[i].rays;
  }
}

std::vector<Candidate> candidates_of(const Case& of, const SamplingBenchOptions& options) {
  std::vector<Candidate> candidates;
  const auto add = [&](const Sampling& sampling, std::string_view note) {
    Candidate& candidate = candidates.emplace_back();
    candidate.sampling = sampling;
    candidate.name = fmt::format("{} x {}{}", *sampling.columns_per_beam, *sampling.rows, note);
    Scenario scenario = of.scenario;
    scenario.sonars[0].sampling = sampling;
    candidate.simulator = std::make_unique<Simulator>(scenario, of.scene, options.threads);
  };
  add(of.scenario.filled_in(of.scenario.sonars[0]).sampling, " own");
  for (const Sampling& sampling : options.samplings) {
    add(sampling, "");
  }
  return candidates;
}

// Candidates take turns, so that varying load of a shared machine affects all alike.
void time_candidates(std::vector<Candidate>& candidates, std::span<const PingRequest> requests, int repetitions) {
  Ping ping;
  for (int repetition = -1; repetition < repetitions; ++repetition) {
    for (Candidate& candidate : candidates) {
      const auto start = std::chrono::steady_clock::now();
      const std::clock_t clock_start = std::clock();
      for (const PingRequest& request : requests) {
        candidate.simulator->ping(0, request, ping);
      }
      if (repetition >= 0) {
        const auto pings = static_cast<double>(requests.size());
        const double ticks = static_cast<double>(std::clock() - clock_start);
        candidate.processor.push_back(ticks / CLOCKS_PER_SEC * kMilliseconds / pings);
        candidate.milliseconds.push_back(milliseconds_since(start) / pings);
      }
    }
  }
}

// Prints the rows of one case and adds them to `rows`.
void report(const Case& of, const std::vector<Candidate>& candidates, std::size_t pings, BenchRows& rows) {
  const double per_ping = 1 / static_cast<double>(pings);
  for (const Candidate& candidate : candidates) {
    const SamplingError &all = candidate.all, &secondary = candidate.secondary;
    rows.add(of.name, candidate.name, median(candidate.milliseconds), median(candidate.processor),
             static_cast<double>(candidate.rays.secondary) * per_ping,
             static_cast<double>(candidate.rays.return_legs) * per_ping, all.rms_db(), 100 * all.spots(),
             all.level_db(), secondary.rms_db(), 100 * secondary.spots(), secondary.level_db(),
             *candidate.sampling.columns_per_beam, *candidate.sampling.rows, all.spots(), all.holes(),
             secondary.spots(), secondary.holes());
  }
}

void run_case(const Case& of, const SamplingBenchOptions& options, BenchRows& rows) {
  std::vector<PingRequest> requests = requests_of(of.scenario, options.pings);
  Case every_hit = of;  // The converged pings trace a reflected ray from every hit.
  if (of.scenario.secondary == SecondaryEchoes::kSelective) {
    every_hit.scenario.secondary = SecondaryEchoes::kAll;
  }
  const std::vector<Images> converged = mean_images(every_hit, options.converged, requests, options.threads);
  std::vector<Candidate> candidates = candidates_of(of, options);
  for (Candidate& candidate : candidates) {
    compare(mean_images(of, candidate.sampling, requests, options.threads), converged, candidate);
  }
  time_candidates(candidates, requests, options.repetitions);
  report(of, candidates, requests.size(), rows);
}

}  // namespace

int bench_sampling(const SamplingBenchOptions& options) {
  say("Calibrated pings, {} of each scene, {} threads: medians of {} times with all effects, elapsed and of all\n"
      "threads' processors. Error of the mean image (neither noise nor speckle) against {} x {} samples a beam, over "
      "the\n"
      "upper {:.0f} dB of the picture: rms in dB, cells more than 6 dB too loud in %, sum in dB; then the same for "
      "paths\n"
      "of two surfaces and more alone.\n\n",
      options.pings, options.threads, options.repetitions, *options.converged.columns_per_beam, *options.converged.rows,
      kPictureRange);
  say("{:<24} {:>14} | {:>8} {:>8} {:>9} {:>9} | {:>7} {:>7} {:>7} | {:>7} {:>7} {:>7}\n", "scene", "samples",
      "ping ms", "cpu ms", "reflected", "returned", "rms", "spots", "sum", "2nd rms", "spots", "sum");
  BenchRows rows;
  rows.begin("",
             "{:<24} {:>14} | {:>8.2f} {:>8.2f} {:>9.0f} {:>9.0f} | {:>7.2f} {:>7.2f} {:>7.2f} | {:>7.2f} {:>7.2f} "
             "{:>7.2f}\n",
             {"scene", "samples", "ping_ms", "processor_ms", "rays_secondary", "return_legs", "rms_db", "spots_percent",
              "level_db", "secondary_rms_db", "secondary_spots_percent", "secondary_level_db", "columns_per_beam",
              "rows", "spots", "holes", "secondary_spots", "secondary_holes"});
  for (const int count : options.triangles) {
    run_case(generated_case(count), options, rows);
  }
  for (const std::filesystem::path& file : options.scenarios) {
    run_case(case_of(file), options, rows);
  }
  rows.write(options.json);
  return 0;
}

}  // namespace insonify
