// bench_primary.cpp -- times rasterised and traced primary echoes, and the choice of `primary: auto`.

#include <algorithm>
#include <chrono>
#include <memory>

#include "benchmark/bench.h"
#include "benchmark/bench_scene.h"
#include "benchmark/bench_timing.h"
#include "insonify/simulator.h"

namespace insonify {
namespace {

constexpr int kPrimaryBlock = 5;  // Consecutive pings.

struct Fan {
  const char* name;
  SonarConfig sonar;
};

// From a wide fan to the single beam of a scanning sonar.
std::vector<Fan> fans() {
  Fan wide{"256 beams x 120 deg", bench_sonar()};
  Fan narrow{"128 beams x 45 deg", bench_sonar()};
  narrow.sonar.beam_count = 128;
  narrow.sonar.azimuth_aperture = radians_from_degrees(45);
  Fan coarse{"64 beams x 120 deg", bench_sonar()};
  coarse.sonar.beam_count = 64;
  coarse.sonar.sampling = {.columns_per_beam = 2, .rows = 100};
  Fan single{"1 beam x 3 deg", bench_sonar()};
  single.sonar.beam_count = 1;
  single.sonar.azimuth_aperture = radians_from_degrees(3);
  single.sonar.elevation_aperture = radians_from_degrees(35);
  return {wide, narrow, coarse, single};
}

// Timings with one setting of `primary` on one scene, block by block.
class PrimaryRunner {
 public:
  PrimaryRunner(const Scene& scene, const SonarConfig& sonar, PrimaryEchoes primary)
      : simulator_(scenario_of(sonar, primary), scene, 1) {}

  void time_block() { blocks_.push_back(median(time_pings(simulator_, kPrimaryBlock, number_, ping_))); }

  [[nodiscard]] double milliseconds() const { return median(blocks_); }
  [[nodiscard]] bool drew() { return simulator_.ray_counts().primary == 0; }

 private:
  static Scenario scenario_of(const SonarConfig& sonar, PrimaryEchoes primary) {
    Scenario scenario;
    scenario.model = EchoModel::kPaper;
    scenario.engine = "cpu";
    scenario.sonars = {sonar};
    scenario.primary = primary;
    scenario.secondary = SecondaryEchoes::kNone;
    return scenario;
  }

  Simulator simulator_;
  Ping ping_;
  std::uint64_t number_ = 0;
  std::vector<double> blocks_;  // Median of each block [ms].
};

}  // namespace

int bench_primary(const BenchOptions& options) {
  say("Whole pings without secondary echoes, one thread: primaries traced and drawn, medians of {} pings in turn.\n"
      "auto: what `primary: auto` takes; regret: how much longer that is than the better of the two.\n\n"
      "{:<20} {:>9} {:>9} | {:>9} {:>9} | {:>6} {:>7}\n",
      options.repetitions, "fan", "samples", "triangles", "rays ms", "raster ms", "auto", "regret");
  BenchRows rows;
  rows.begin("", "{:<20} {:>9} {:>9} | {:>9.3f} {:>9.3f} | {:>6} {:>5.0f} %\n",
             {"fan", "samples", "triangles", "rays_ms", "raster_ms", "auto", "regret_percent", "regret", "beams",
              "azimuth_deg"});
  double worst = 0;
  for (const int count : options.triangles) {
    const Scene scene = make_bench_scene(count);
    for (const Fan& fan : fans()) {
      PrimaryRunner rays(scene, fan.sonar, PrimaryEchoes::kRays);
      PrimaryRunner raster(scene, fan.sonar, PrimaryEchoes::kRaster);
      PrimaryRunner chosen(scene, fan.sonar, PrimaryEchoes::kAuto);
      chosen.time_block();
      for (int done = 0; done < options.repetitions; done += kPrimaryBlock) {
        rays.time_block();
        raster.time_block();
      }
      const double rays_ms = rays.milliseconds(), raster_ms = raster.milliseconds();
      const double regret = (chosen.drew() ? raster_ms : rays_ms) / std::min(rays_ms, raster_ms) - 1;
      worst = std::max(worst, regret);
      const Sampling sampling = fan.sonar.sampling;
      const int samples = fan.sonar.beam_count * sampling.columns_per_beam.value_or(Sampling::kColumns) *
                          sampling.rows.value_or(Sampling::kRows);
      rows.add(fan.name, samples, scene.triangle_count(), rays_ms, raster_ms, chosen.drew() ? "raster" : "rays",
               100 * regret, regret, fan.sonar.beam_count, degrees_from_radians(fan.sonar.azimuth_aperture));
    }
  }
  say("\nlargest regret {:.0f} %\n", 100 * worst);
  rows.write(options.json);
  return 0;
}

}  // namespace insonify
