// bench_engine.cpp -- how long a ping takes, and how far that is from its floor: Embree alone on the same rays.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>

#include "bench.h"
#include "bench_scene.h"
#include "insonify/error.h"
#include "insonify/simulator.h"

namespace insonify {
namespace {

constexpr int kWarmUp = 2;
constexpr int kBlock = 8;  // Pings or floors in a row.
constexpr double kMilliseconds = 1e3;

struct Row {
  int threads = 0;
  std::size_t triangles = 0;
  const char* secondary = "";
  RayCounts rays = {};
  double setup_ms = 0;
  double ping_ms = 0, ping_least_ms = 0;  // Median and least.
  double floor_ms = 0, floor_least_ms = 0;
  double ratio = 0;                         // Median of ping over floor, block by block.
  double own_bytes = 0, library_bytes = 0;  // A triangle.
};

double median(std::vector<double> values) {
  std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
  return values[values.size() / 2];
}

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() * kMilliseconds;
}

// Blocks of pings and blocks of floors in turn: both meet the same weather on a shared machine, and neither finds the
// other's data in its caches.
Row time_row(const Scene& scene, int threads, SecondaryEchoes secondary, const char* name, int repetitions) {
  Scenario scenario;
  scenario.sonars = {bench_sonar()};
  scenario.secondary = secondary;
  Row row{.threads = threads, .triangles = scene.triangle_count(), .secondary = name};
  const auto setup_start = std::chrono::steady_clock::now();
  Simulator simulator(scenario, scene, threads);
  row.setup_ms = milliseconds_since(setup_start);

  const auto plan = make_ping_plan({.sonar = simulator.sonar(0),
                                    .water = scenario.water,
                                    .paper = scenario.paper,
                                    .secondary = secondary,
                                    .seed = scenario.seed});
  Ping ping;
  std::uint64_t number = 0;
  std::vector<double> pings, floors, ratios;
  for (int done = 0; done < repetitions; done += kBlock) {
    std::vector<double> block_pings, block_floors;
    for (int i = -kWarmUp; i < kBlock; ++i) {
      const auto start = std::chrono::steady_clock::now();
      simulator.make_ping(0, number++, ping);
      if (i >= 0) {
        block_pings.push_back(milliseconds_since(start));
      }
    }
    row.rays = simulator.engine().ray_counts();
    for (const double seconds :
         time_traversal(simulator.engine(), *plan, simulator.world_from_head(0, 0), kWarmUp + kBlock)) {
      block_floors.push_back(seconds * kMilliseconds);
    }
    block_floors.erase(block_floors.begin(), block_floors.begin() + kWarmUp);
    ratios.push_back(median(block_pings) / median(block_floors));
    pings.insert(pings.end(), block_pings.begin(), block_pings.end());
    floors.insert(floors.end(), block_floors.begin(), block_floors.end());
  }
  row.ping_ms = median(pings);
  row.ping_least_ms = std::ranges::min(pings);
  row.floor_ms = median(floors);
  row.floor_least_ms = std::ranges::min(floors);
  row.ratio = median(ratios);
  const EngineMemory memory = simulator.engine().memory();
  std::size_t mesh_bytes = 0;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = *instance.mesh;
    mesh_bytes += mesh.vertices.capacity() * sizeof(mesh.vertices[0]) +
                  mesh.normals.capacity() * sizeof(mesh.normals[0]) +
                  mesh.triangles.capacity() * sizeof(mesh.triangles[0]) +
                  mesh.material_slots.capacity() * sizeof(mesh.material_slots[0]);
  }
  row.own_bytes = static_cast<double>(mesh_bytes + memory.own) / static_cast<double>(row.triangles);
  row.library_bytes = static_cast<double>(memory.library) / static_cast<double>(row.triangles);
  return row;
}

nlohmann::json to_json(const Row& row) {
  return {{"triangles", row.triangles},
          {"threads", row.threads},
          {"secondary", row.secondary},
          {"rays_primary", row.rays.primary},
          {"rays_secondary", row.rays.secondary},
          {"rays_return", row.rays.return_legs},
          {"setup_ms", row.setup_ms},
          {"ping_ms", row.ping_ms},
          {"ping_least_ms", row.ping_least_ms},
          {"pings_per_s", kMilliseconds / row.ping_ms},
          {"floor_ms", row.floor_ms},
          {"floor_least_ms", row.floor_least_ms},
          {"ratio", row.ratio},
          {"bytes_per_triangle", row.own_bytes},
          {"library_bytes_per_triangle", row.library_bytes}};
}

void write_json(const std::filesystem::path& path, const nlohmann::json& rows) {
  std::ofstream file(path);
  file << rows.dump(2) << '\n';
  file.flush();
  if (!file) {
    throw Error(fmt::format("{}: cannot be written", path.string()));
  }
}

}  // namespace

int bench_engine(const BenchOptions& options) {
  fmt::print(
      "256 beams x 500 bins, 120 x 20 degrees, 20 m, 4 x 200 samples a beam; medians of {} pings, all effects on.\n"
      "floor: Embree alone on the same rays, packets set up; ratio: ping over floor, block by block.\n\n"
      "{:>9} {:>7} {:>9} {:>8} {:>8} {:>8} | {:>8} {:>8} {:>8} {:>6} | {:>8} {:>7} {:>9}\n",
      options.repetitions, "triangles", "threads", "secondary", "rays", "onward", "return", "setup ms", "ping ms",
      "floor ms", "ratio", "pings/s", "B/tri", "Embree B");
  nlohmann::json rows = nlohmann::json::array();
  for (const int count : options.triangles) {
    const Scene scene = make_bench_scene(count);
    for (const auto& [secondary, name] :
         {std::pair{SecondaryEchoes::kNone, "none"}, std::pair{SecondaryEchoes::kSelective, "selective"},
          std::pair{SecondaryEchoes::kAll, "all"}}) {
      for (const int threads : options.threads) {
        const Row row = time_row(scene, threads, secondary, name, options.repetitions);
        fmt::print(
            "{:>9} {:>7} {:>9} {:>8} {:>8} {:>8} | {:>8.2f} {:>8.2f} {:>8.2f} {:>6.2f} | {:>8.1f} {:>7.0f} {:>9.0f}\n",
            row.triangles, row.threads, row.secondary, row.rays.primary, row.rays.secondary, row.rays.return_legs,
            row.setup_ms, row.ping_ms, row.floor_ms, row.ratio, kMilliseconds / row.ping_ms, row.own_bytes,
            row.library_bytes);
        rows.push_back(to_json(row));
      }
    }
  }
  if (!options.json.empty()) {
    write_json(options.json, rows);
  }
  return 0;
}

}  // namespace insonify
