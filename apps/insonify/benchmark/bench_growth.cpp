// bench_growth.cpp -- how set-up and ping grow with each quantity of a scenario, so that cliffs are seen early.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <random>

#include "benchmark/bench.h"
#include "benchmark/bench_scene.h"
#include "benchmark/bench_timing.h"
#include "insonify/simulator.h"

namespace insonify {
namespace {

constexpr int kTriangles = 10'000;  // The scene's, where they do not grow.

struct GrowthCase {
  Scenario scenario;
  Scene scene;
};

// What grows: its case of a size, and the size of its first row.
struct Growth {
  const char* name;
  GrowthCase (*make)(int size);
  int first;
  int most = 1'000'000'000;
};

GrowthCase base_case(int triangles) {
  GrowthCase made{{}, make_bench_scene(triangles)};
  made.scenario.engine = "cpu";
  made.scenario.sonars = {bench_sonar()};
  return made;
}

// Beams as narrow as their spacing: the array grows with them.
GrowthCase with_beams(int beams) {
  GrowthCase made = base_case(kTriangles);
  made.scenario.sonars[0].beam_count = beams;
  return made;
}

GrowthCase with_focused_beams(int beams) {
  GrowthCase made = with_beams(beams);
  made.scenario.sonars[0].focus_range = 5;
  return made;
}

GrowthCase with_bins(int bins) {
  GrowthCase made = base_case(kTriangles);
  made.scenario.sonars[0].bin_count = bins;
  return made;
}

GrowthCase with_range(int range) {
  GrowthCase made = base_case(kTriangles);
  made.scenario.sonars[0].max_range = range;
  return made;
}

GrowthCase with_surfaces(int surfaces) {
  GrowthCase made = base_case(kTriangles);
  made.scenario.max_surfaces = surfaces;
  return made;
}

Instance object_of(const std::shared_ptr<const Mesh>& mesh, const Vec3& position, const char* material) {
  Instance instance;
  instance.name = "object";
  instance.mesh = mesh;
  instance.world_from_mesh.position = position;
  instance.user_material = material;
  return instance;
}

// Places before the sonar, as dense for any number of objects.
class Places {
 public:
  explicit Places(int count) : side_(2 * std::cbrt(count)) {}

  Vec3 next() { return {2 + share() * side_, (share() - 0.5) * side_, (share() - 0.5) * side_}; }
  double share() { return static_cast<double>(random_()) / std::mt19937::max(); }

 private:
  std::mt19937 random_{1};  // The same on every machine.
  double side_;
};

// Boxes of steel with parallel faces, in one mesh.
GrowthCase with_faces(int faces) {
  constexpr int kFacesOfBox = 6;
  const int boxes = std::max(1, faces / kFacesOfBox);
  Places places(boxes);
  Mesh all;
  for (int i = 0; i < boxes; ++i) {
    const Vec3f middle = places.next().cast<float>();
    const Mesh box = make_box({0.2 + places.share(), 0.2 + places.share(), 0.2 + places.share()});
    const auto first = static_cast<std::uint32_t>(all.vertices.size());
    for (std::size_t v = 0; v < box.vertices.size(); ++v) {
      all.vertices.emplace_back(box.vertices[v] + middle);
      all.normals.push_back(box.normals[v]);
    }
    for (const auto& [a, b, c] : box.triangles) {
      all.triangles.push_back({first + a, first + b, first + c});
    }
  }
  GrowthCase made;
  made.scenario.engine = "cpu";
  made.scenario.sonars = {bench_sonar()};
  made.scene.instances = {object_of(std::make_shared<const Mesh>(std::move(all)), Vec3::Zero(), "steel")};
  assign_materials(made.scene, {});
  return made;
}

GrowthCase with_instances(int instances) {
  const auto ball = std::make_shared<const Mesh>(make_sphere(0.3, 0.3));
  GrowthCase made;
  made.scenario.engine = "cpu";
  made.scenario.sonars = {bench_sonar()};
  Places places(instances);
  for (int i = 0; i < instances; ++i) {
    made.scene.instances.push_back(object_of(ball, places.next(), "steel"));
  }
  assign_materials(made.scene, {});
  return made;
}

constexpr Growth kGrowths[] = {{"beams", with_beams, 64},         {"focus", with_focused_beams, 64},
                               {"bins", with_bins, 500},          {"range", with_range, 20},
                               {"surfaces", with_surfaces, 1, 3}, {"triangles", base_case, 100'000},
                               {"faces", with_faces, 1500},       {"instances", with_instances, 250}};

struct GrowthTimes {
  double set_up, ping;  // Medians [ms].
};

// Set-up is all that the first ping takes beyond those that follow, with the making of the simulator.
GrowthTimes time_case(const GrowthCase& of, const GrowthBenchOptions& options) {
  std::vector<double> set_up, pings;
  for (int i = 0; i < options.repetitions; ++i) {
    const auto start = std::chrono::steady_clock::now();
    Simulator simulator(of.scenario, of.scene, options.threads);
    Ping ping;
    simulator.ping(0, {}, ping);
    const double first = milliseconds_since(start);
    std::uint64_t number = 1;
    const double rest = median(time_pings(simulator, options.repetitions, number, ping));
    set_up.push_back(std::max(0.0, first - rest));
    pings.push_back(rest);
  }
  return {median(std::move(set_up)), median(std::move(pings))};
}

// Slope between two rows on doubly logarithmic paper.
double exponent(double time, double before, double size, double size_before) {
  return std::log(time / before) / std::log(size / size_before);
}

void run_growth(const Growth& growth, const GrowthBenchOptions& options, BenchRows& rows) {
  const int first = std::max(1, growth.first / options.divided_by);
  std::optional<std::pair<int, GrowthTimes>> before;
  for (int row = 0; row <= options.doublings; ++row) {
    const int size = std::min(first << row, growth.most);
    if (before && size == before->first) {
      break;
    }
    const GrowthTimes times = time_case(growth.make(size), options);
    if (before) {
      const auto slope = [&](double GrowthTimes::*time) {
        return exponent(times.*time, before->second.*time, size, before->first);
      };
      rows.begin("", "{:<10} {:>9} | {:>9.1f} {:>8.2f} | {:>8.2f} {:>8.2f}\n",
                 {"grows", "size", "setup_ms", "setup_exponent", "ping_ms", "ping_exponent"});
      rows.add(growth.name, size, times.set_up, slope(&GrowthTimes::set_up), times.ping, slope(&GrowthTimes::ping));
    } else {
      rows.begin("", "{:<10} {:>9} | {:>9.1f}          | {:>8.2f}\n", {"grows", "size", "setup_ms", "ping_ms"});
      rows.add(growth.name, size, times.set_up, times.ping);
    }
    before = {size, times};
  }
}

}  // namespace

std::vector<std::string> growth_names() {
  std::vector<std::string> names;
  for (const Growth& growth : kGrowths) {
    names.emplace_back(growth.name);
  }
  return names;
}

int bench_growth(const GrowthBenchOptions& options) {
  say("Calibrated pings, all effects on, {} threads; medians of {}. One quantity grows at a time, the others are those "
      "of\n"
      "256 beams x 500 bins, 20 m, {} triangles. An exponent of 1 is linear; it is that between a row and the last.\n\n"
      "{:<10} {:>9} | {:>9} {:>8} | {:>8} {:>8}\n",
      options.threads, options.repetitions, kTriangles, "grows", "size", "set-up ms", "exponent", "ping ms",
      "exponent");
  BenchRows rows;
  for (const Growth& growth : kGrowths) {
    if (options.grows.empty() || std::ranges::find(options.grows, growth.name) != options.grows.end()) {
      run_growth(growth, options, rows);
    }
  }
  rows.write(options.json);
  return 0;
}

}  // namespace insonify
