// bench_paper.cpp -- the paper's tables of computing times, on its workload.

#include <algorithm>
#include <cmath>
#include <optional>

#include "benchmark/bench.h"
#include "benchmark/bench_scene.h"
#include "benchmark/bench_timing.h"
#include "insonify/simulator.h"

namespace insonify {
namespace {

constexpr int kPings = 3;  // Timed pings per scene, after one warm-up.

struct Mode {
  const char* name;
  PrimaryEchoes primary;
  SecondaryEchoes secondary;
};
constexpr Mode kModes[] = {
    {"primary", PrimaryEchoes::kAuto, SecondaryEchoes::kNone},      // As in 2017.
    {"hybrid", PrimaryEchoes::kAuto, SecondaryEchoes::kSelective},  // As in the paper.
    {"full", PrimaryEchoes::kRays, SecondaryEchoes::kAll},
};

struct Mean {
  double sum = 0, squares = 0;
  int count = 0;

  void add(double value) {
    sum += value;
    squares += value * value;
    ++count;
  }
  [[nodiscard]] double value() const { return sum / count; }
  [[nodiscard]] double deviation() const { return std::sqrt(std::max(0.0, squares / count - value() * value())); }
};

// One sonar in one mode, timed over all scenes.
struct PaperRow {
  const PaperSetup* setup = nullptr;
  const Mode* mode = nullptr;
  Mean ping_ms = {}, setup_ms = {}, floor_ms = {}, rays_primary = {}, rays_secondary = {};
};

// Times pings of a new scene in steady state.
void sample(PaperRow& row, const PaperBenchOptions& options, std::uint64_t number) {
  Scenario scenario;
  scenario.model = EchoModel::kPaper;
  scenario.engine = "cpu";
  scenario.sonars = {sonar_of(*row.setup, options.filled ? 10 : 0)};
  scenario.primary = row.mode->primary;
  scenario.secondary = row.mode->secondary;
  scenario.seed = number;
  const auto setup_start = std::chrono::steady_clock::now();
  Simulator simulator(scenario, options.filled ? make_filled_scene() : make_random_scene(number), options.threads);
  row.setup_ms.add(milliseconds_since(setup_start));

  Ping ping;
  std::vector<double> times;
  for (std::uint64_t i = 0; i <= kPings; ++i) {
    const auto start = std::chrono::steady_clock::now();
    simulator.ping(0, {.number = i}, ping);
    if (i > 0) {
      times.push_back(milliseconds_since(start));
    }
  }
  row.ping_ms.add(median(times));
  const RayCounts rays = simulator.ray_counts();
  row.rays_primary.add(static_cast<double>(rays.primary));
  row.rays_secondary.add(static_cast<double>(rays.secondary + rays.return_legs));

  const std::vector<double> floors = simulator.time_traversal(0, simulator.world_from_head(0, {}), 2);
  row.floor_ms.add(floors.back() * kMilliseconds);
}

// Time that the paper prints for the same method; none for `full`, which the paper does not have.
std::string printed(const PaperRow& row) {
  const std::string mode = row.mode->name;
  return mode == "full" ? ""
                        : fmt::format("{:.1f}", mode == "primary" ? row.setup->printed_2017_ms : row.setup->printed_ms);
}

std::string name_of(const PaperSetup& setup) {
  return fmt::format("{} {:>3} x {:<4} {:>3} x {:<2}", setup.scanning() ? "MSIS" : "FLS ", setup.beams, setup.bins,
                     setup.azimuth_deg, setup.elevation_deg);
}

void add_row(const PaperRow& row, const char* scene, BenchRows& rows) {
  const PaperSetup& setup = *row.setup;
  const double ping_ms = row.ping_ms.value(), setup_ms = row.setup_ms.value();
  rows.add(name_of(setup), row.mode->name, ping_ms, row.ping_ms.deviation(), kMilliseconds / ping_ms, setup_ms,
           setup_ms + ping_ms, row.rays_primary.value(), row.rays_secondary.value(), row.floor_ms.value(), printed(row),
           setup.beams, setup.bins, setup.azimuth_deg, setup.elevation_deg, row.ping_ms.count, scene);
}

std::string markdown_of(const std::vector<PaperRow>& rows) {
  std::string text =
      "| Beams x bins | Field [deg] | Mode | Ping [ms] | Deviation | Pings/s | Set-up [ms] | Both [ms] | Primary rays "
      "| "
      "Secondary rays | Floor [ms] | The paper prints [ms] |\n"
      "| ---: | ---: | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n";
  for (const PaperRow& row : rows) {
    text += fmt::format(
        "| {} x {} | {} x {} | {} | {:.3f} | {:.3f} | {:.0f} | {:.2f} | {:.2f} | {:.0f} | {:.0f} | "
        "{:.3f} | {} |\n",
        row.setup->beams, row.setup->bins, row.setup->azimuth_deg, row.setup->elevation_deg, row.mode->name,
        row.ping_ms.value(), row.ping_ms.deviation(), kMilliseconds / row.ping_ms.value(), row.setup_ms.value(),
        row.setup_ms.value() + row.ping_ms.value(), row.rays_primary.value(), row.rays_secondary.value(),
        row.floor_ms.value(), printed(row));
  }
  return text;
}

}  // namespace

int bench_paper(const PaperBenchOptions& options) {
  say("The paper's tables: {} samples of {}.\n"
      "Range 20 m, all effects on, {} threads. ms, std: mean and deviation of a ping in steady state; set-up: scene "
      "and\n"
      "sonar ready to ping; both: as the paper counts. primary: no secondary echoes, the 2017 method; hybrid: the\n"
      "paper's; full: all rays. 2nd rays: reflected rays and return legs. floor: Embree alone on the lattice and the "
      "rays\n"
      "sent on. printed: by the paper, on a GeForce GTX 1060.\n\n"
      "{:<23} {:<8}| {:>8} {:>7} {:>9} | {:>8} {:>8} | {:>8} {:>9} | {:>8} | {:>7}\n",
      options.samples, options.filled ? "a scene that fills the fan" : "a cylinder, box, sphere and cone at random",
      options.threads, "sonar", "mode", "ms", "std", "pings/s", "set-up", "both", "1st rays", "2nd rays", "floor ms",
      "printed");
  std::vector<PaperRow> rows;
  BenchRows written;
  written.begin(
      "", "{} {:<8}| {:>8.3f} {:>7.3f} {:>9.1f} | {:>8.2f} {:>8.2f} | {:>8.0f} {:>9.0f} | {:>8.3f} | {:>7}\n",
      {"sonar", "mode", "mean_ms", "std_ms", "pings_per_s", "setup_ms", "both_ms", "rays_primary", "rays_secondary",
       "floor_ms", "printed_ms", "beams", "bins", "azimuth_deg", "elevation_deg", "samples", "scene"});
  for (const PaperSetup& setup : paper_setups()) {
    std::vector<PaperRow> three;
    for (const Mode& mode : kModes) {
      three.push_back({.setup = &setup, .mode = &mode});
    }
    for (int number = 0; number < options.samples; ++number) {
      for (PaperRow& row : three) {
        sample(row, options, static_cast<std::uint64_t>(number));
      }
    }
    for (const PaperRow& row : three) {
      add_row(row, options.filled ? "filled" : "random", written);
    }
    rows.insert(rows.end(), three.begin(), three.end());
  }
  written.write(options.json);
  write_text(options.markdown, markdown_of(rows));
  return 0;
}

}  // namespace insonify
