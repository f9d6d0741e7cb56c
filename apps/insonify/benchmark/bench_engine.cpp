// bench_engine.cpp -- time of a ping relative to its lower bound ("floor"): Embree alone on the same rays.

#include <algorithm>
#include <chrono>

#include "benchmark/bench.h"
#include "benchmark/bench_scene.h"
#include "benchmark/bench_timing.h"
#include "insonify/simulator.h"

namespace insonify {
namespace {

constexpr int kEngineBlock = 8;  // Consecutive pings, or consecutive floors.

// Timings with one number of threads on one scene, block by block.
class EngineRunner {
 public:
  EngineRunner(const Scenario& scenario, const Scene& scene, int threads)
      : threads_(threads), start_(std::chrono::steady_clock::now()), simulator_(scenario, scene, threads) {
    setup_ms_ = milliseconds_since(start_);
  }

  // Pings, then floors, so that neither finds the other's data in the caches.
  void time_block() {
    const std::vector<double> block_pings = time_pings(simulator_, kEngineBlock, number_, ping_);
    std::vector<double> block_floors;
    rays_ = simulator_.ray_counts();
    for (const double seconds :
         simulator_.time_traversal(0, simulator_.world_from_head(0, {}), kWarmUpPings + kEngineBlock)) {
      block_floors.push_back(seconds * kMilliseconds);
    }
    block_floors.erase(block_floors.begin(), block_floors.begin() + kWarmUpPings);
    ping_blocks_.push_back(median(block_pings));
    floor_blocks_.push_back(median(block_floors));
    pings_.insert(pings_.end(), block_pings.begin(), block_pings.end());
    floors_.insert(floors_.end(), block_floors.begin(), block_floors.end());
  }

  // @param first  Timings with the first number of threads.
  void add_row(const EngineRunner& first, const char* secondary, BenchRows& rows) const {
    const Scene& scene = simulator_.scene();
    const auto triangles = static_cast<double>(scene.triangle_count());
    const EngineMemory memory = simulator_.engine_memory();
    const double ping = median(pings_);
    rows.add(scene.triangle_count(), threads_, secondary, rays_.primary, rays_.secondary, rays_.return_legs, setup_ms_,
             ping, median(floors_), median_ratio(ping_blocks_, floor_blocks_), kMilliseconds / ping,
             median_ratio(first.ping_blocks_, ping_blocks_), median_ratio(first.floor_blocks_, floor_blocks_),
             static_cast<double>(mesh_bytes(scene) + memory.own) / triangles,
             static_cast<double>(memory.library) / triangles, std::ranges::min(pings_), std::ranges::min(floors_));
  }

 private:
  static std::size_t mesh_bytes(const Scene& scene) {
    std::size_t bytes = 0;
    for (const Instance& instance : scene.instances) {
      const Mesh& mesh = *instance.mesh;
      bytes += mesh.vertices.capacity() * sizeof(mesh.vertices[0]) + mesh.normals.capacity() * sizeof(mesh.normals[0]) +
               mesh.triangles.capacity() * sizeof(mesh.triangles[0]) +
               mesh.material_slots.capacity() * sizeof(mesh.material_slots[0]);
    }
    return bytes;
  }

  int threads_;
  std::chrono::steady_clock::time_point start_;
  Simulator simulator_;
  double setup_ms_ = 0;
  Ping ping_;
  std::uint64_t number_ = 0;
  RayCounts rays_;
  std::vector<double> pings_, floors_;              // All times [ms].
  std::vector<double> ping_blocks_, floor_blocks_;  // Median of each block [ms].
};

// Alternates between numbers of threads block by block, so that varying load of a shared machine affects all alike.
void time_rows(const Scene& scene, SecondaryEchoes secondary, const char* name, const BenchOptions& options,
               BenchRows& rows) {
  Scenario scenario;
  scenario.model = EchoModel::kPaper;
  scenario.engine = "cpu";
  scenario.sonars = {bench_sonar()};
  scenario.secondary = secondary;
  std::vector<std::unique_ptr<EngineRunner>> runners;
  for (const int threads : options.threads) {
    runners.push_back(std::make_unique<EngineRunner>(scenario, scene, threads));
  }
  for (int done = 0; done < options.repetitions; done += kEngineBlock) {
    for (const auto& runner : runners) {
      runner->time_block();
    }
  }
  for (const auto& runner : runners) {
    runner->add_row(*runners.front(), name, rows);
  }
}

}  // namespace

int bench_engine(const BenchOptions& options) {
  say("256 beams x 500 bins, 120 x 20 degrees, 20 m, 4 x 200 samples a beam; medians of {} pings, all effects on.\n"
      "floor: Embree alone on the lattice's rays and those really sent on, packets set up; ratio: ping over floor.\n"
      "Where triangles are few the ping draws its primaries (rays 0); the floor traces them all the same.\n"
      "x: times the rate of {} {}, of the ping and of the floor. Blocks of pings and of floors are timed in turn.\n\n"
      "{:>9} {:>7} {:>9} {:>8} {:>8} {:>8} | {:>8} {:>8} {:>8} {:>6} | {:>8} {:>6} {:>7} | {:>6} {:>8}\n",
      options.repetitions, options.threads.front(), options.threads.front() == 1 ? "thread" : "threads", "triangles",
      "threads", "secondary", "rays", "reflected", "return", "setup ms", "ping ms", "floor ms", "ratio", "pings/s",
      "ping x", "floor x", "B/tri", "Embree B");
  BenchRows rows;
  rows.begin("engine",
             "{:>9} {:>7} {:>9} {:>8} {:>8} {:>8} | {:>8.2f} {:>8.2f} {:>8.2f} {:>6.2f} | {:>8.1f} {:>6.2f} {:>7.2f} | "
             "{:>6.0f} {:>8.0f}\n",
             {"triangles", "threads", "secondary", "rays_primary", "rays_secondary", "rays_return", "setup_ms",
              "ping_ms", "floor_ms", "ratio", "pings_per_s", "ping_speedup", "floor_speedup", "bytes_per_triangle",
              "library_bytes_per_triangle", "ping_least_ms", "floor_least_ms"});
  for (const int count : options.triangles) {
    const Scene scene = make_bench_scene(count);
    for (const auto& [secondary, name] :
         {std::pair{SecondaryEchoes::kNone, "none"}, std::pair{SecondaryEchoes::kSelective, "selective"},
          std::pair{SecondaryEchoes::kAll, "all"}}) {
      time_rows(scene, secondary, name, options, rows);
    }
  }
  bench_models(options, rows);
  rows.write(options.json);
  return 0;
}

}  // namespace insonify
