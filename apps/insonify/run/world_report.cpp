// world_report.cpp -- describes the world and the first ping, and finds likely mistakes.

#include "run/world_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "insonify/survey/bottom_detection.h"

namespace insonify {
namespace {

// Rounds a coordinate for printing, to the millimetre or to six digits.
double rounded(double value) {
  return std::round(value * 1000) / 1000 + 0;  // Adding zero turns -0 into 0.
}

bool is_empty(const Box3& box) {
  return box.low.x() > box.high.x();
}

// Bounds of the scene without its planes, which represent endless grounds; of all if there is nothing else.
Box3 extent_of(const Scene& scene) {
  constexpr std::size_t kTrianglesOfAPlane = 2;
  Scene solids;
  std::ranges::copy_if(scene.instances, std::back_inserter(solids.instances),
                       [](const Instance& instance) { return instance.mesh->triangles.size() > kTrianglesOfAPlane; });
  const Box3 bounds = solids.bounds();
  return is_empty(bounds) ? scene.bounds() : bounds;
}

// Worlds are a few ranges wide, surveyed seabeds a few hundred: beyond that, a unit is probably wrong by a thousand.
std::string size_oddity(const Box3& world, const SonarConfig& sonar) {
  constexpr double kTooManyRanges = 400, kTooFewBins = 3;
  constexpr double kTooFewRanges = 0.02;  // 20 ranges of a world in kilometres. Bins can be long.
  const double across = (world.high - world.low).maxCoeff();
  if (across > kTooManyRanges * sonar.max_range) {
    return fmt::format(
        "the world is {:.4g} m across, {:.3g} times the range of {}; if its files are in millimetres, scale "
        "them by 0.001",
        across, across / sonar.max_range, sonar.name);
  }
  if (across < std::min(kTooFewBins * sonar.bin_length(), kTooFewRanges * sonar.max_range)) {
    return fmt::format(
        "the world is {:.3g} m across, {:.2g} bins of {}; if its files are in kilometres, scale them by 1000", across,
        across / sonar.bin_length(), sonar.name);
  }
  return "";
}

// Numbers of pings from the first to the last.
std::vector<std::uint64_t> spread_pings(std::uint64_t pings, std::uint64_t most) {
  const std::uint64_t count = std::min(pings, most);
  std::vector<std::uint64_t> numbers;
  for (std::uint64_t i = 0; i < count; ++i) {
    numbers.push_back(count > 1 ? i * (pings - 1) / (count - 1) : 0);
  }
  return numbers;
}

// A line for each object that the sonar is inside of at some pings: the first, the last and evenly spread ones between
// them, 32 in all, fewer in a world of many triangles. All objects are placed as at that time.
std::vector<std::string> solids_met(Simulator& simulator, const ScenarioRequests& requests, int sonar) {
  constexpr std::uint64_t kMostPings = 32, kMostTriangles = 2'000'000;  // Together about 0.2 s.
  const std::uint64_t most =
      std::clamp<std::uint64_t>(kMostTriangles / (simulator.scene().triangle_count() + 1), 2, kMostPings);
  std::set<int> met;
  std::vector<std::string> texts;
  for (const std::uint64_t ping : spread_pings(requests.ping_count(sonar), most)) {
    const PingRequest request = requests.at(sonar, ping);
    const Scene scene = simulator.scene_at(request);
    for (const int inside : scene.solids_around(simulator.world_from_head(sonar, request).position)) {
      if (met.insert(inside).second) {
        texts.push_back(fmt::format("{} {} inside of {}, and receives its inner surface", simulator.sonar(sonar).name,
                                    ping == 0 ? "begins" : fmt::format("is at ping {}", ping),
                                    scene.instances[inside].name));
      }
    }
  }
  return texts;
}

// Without a trajectory the vehicle stands still, and so do its sonars while they listen.
std::string motion_oddity(const Scenario& scenario) {
  const std::vector<Waypoint>& waypoints = scenario.trajectory.waypoints;
  const bool moves = std::ranges::any_of(waypoints, [&](const Waypoint& one) {
    return one.position != waypoints.front().position || one.orientation != waypoints.front().orientation;
  });
  if (!scenario.motion_in_ping || moves) {
    return "";
  }
  const auto given = scenario.places.find("motion_in_ping");
  return fmt::format("{}motion_in_ping has no effect unless there is a trajectory along which the sonars move",
                     given != scenario.places.end() ? given->second.text() : "");
}

// @param last_ping  Its time [s].
std::string length_text(const std::string& whose, const Trajectory& trajectory, const SonarConfig& sonar,
                        double last_ping) {
  if (trajectory.waypoints.size() < 2) {
    return "";
  }
  const double period = *sonar.ping_period;
  const double begin = trajectory.waypoints.front().time, end = trajectory.waypoints.back().time;
  if (begin > last_ping) {
    return fmt::format(
        "the last ping of {} is at {:.4g} s, the trajectory{} begins at {:.10g} s: nothing moves before that; "
        "for a file, `start: {:.10g}` makes that time 0",
        sonar.name, last_ping, whose, begin, begin);
  }
  if (last_ping + period < end) {
    return fmt::format(
        "the last ping of {} is at {:.4g} s, the trajectory{} ends at {:.4g} s; --duration {:.6g} would ping until "
        "then",
        sonar.name, last_ping, whose, end, end);
  }
  if (last_ping > end + period) {
    return fmt::format(
        "the last ping of {} is at {:.4g} s, the trajectory{} ends at {:.4g} s: nothing moves after that", sonar.name,
        last_ping, whose, end);
  }
  return "";
}

// "; the bottom in 251 of 256 beams, 19.8 to 20.1 m below it"; "" without soundings.
std::string soundings_text(const Ping& ping) {
  if (ping.soundings.empty()) {
    return "";
  }
  std::vector<double> depths;
  for (const Sounding& sounding : ping.soundings) {
    if (sounding.found()) {
      depths.push_back(ping.world_from_sonar.position.z() - position_of(sounding, ping.world_from_sonar).z());
    }
  }
  if (depths.empty()) {
    return "; the bottom in no beam";
  }
  const auto [least, most] = std::ranges::minmax(depths);
  return fmt::format("; the bottom in {} of {} beams, {:.3g} to {:.3g} m below it", depths.size(),
                     ping.soundings.size(), least, most);
}

}  // namespace

std::string size_text(const Scene& scene) {
  const Box3 box = scene.bounds();
  if (is_empty(box)) {
    return "open water";
  }
  const Vec3 size = box.high - box.low;
  return fmt::format("{:.4g} x {:.4g} x {:.4g} m (x {:.6g} to {:.6g}, y {:.6g} to {:.6g}, z {:.6g} to {:.6g})",
                     size.x(), size.y(), size.z(), rounded(box.low.x()), rounded(box.high.x()), rounded(box.low.y()),
                     rounded(box.high.y()), rounded(box.low.z()), rounded(box.high.z()));
}

std::vector<std::string> oddities_of(Simulator& simulator, const ScenarioRequests& requests) {
  std::vector<std::string> texts;
  if (const std::string text = motion_oddity(simulator.scenario()); !text.empty()) {
    texts.push_back(text);
  }
  const Box3 world = extent_of(simulator.scene());
  for (int i = 0; i < requests.sonar_count() && !is_empty(world); ++i) {
    if (const std::string text = size_oddity(world, simulator.sonar(i)); !text.empty()) {
      texts.push_back(text);
      break;
    }
  }
  for (int i = 0; i < requests.sonar_count(); ++i) {
    const std::vector<std::string> inside = solids_met(simulator, requests, i);
    texts.insert(texts.end(), inside.begin(), inside.end());
  }
  for (const std::string& name : simulator.too_many_thin_parts()) {
    texts.push_back(fmt::format(
        "{} has too many thin parts (ropes, rods, nets) to be sampled on the object: their echoes vary with "
        "their position among the samples of the fan; divide it into several objects, or leave some out",
        name));
  }
  if (const std::size_t count = simulator.edges_left_out(); count > 0) {
    texts.push_back(fmt::format("the world has too many straight edges: the {} shortest have no echo", count));
  }
  return texts;
}

std::vector<std::string> lengths_of(const Simulator& simulator, const ScenarioRequests& requests) {
  std::vector<std::string> texts;
  const Scenario& scenario = simulator.scenario();
  for (int i = 0; i < requests.sonar_count() && scenario.ping_spans.empty(); ++i) {  // Spans say when pings end.
    const double last_ping = requests.time_of(i, requests.ping_count(i) - 1);
    std::vector<std::string> of_sonar = {length_text("", scenario.trajectory, simulator.sonar(i), last_ping)};
    for (const Motion& motion : scenario.motions) {
      of_sonar.push_back(length_text(" of " + motion.object, motion.trajectory, simulator.sonar(i), last_ping));
    }
    std::ranges::remove_copy(of_sonar, std::back_inserter(texts), std::string());
  }
  return texts;
}

std::string first_ping_text(const Scene& scene, const SonarConfig& sonar, const Ping& ping) {
  if (ping.instance.empty()) {
    return "";
  }
  std::set<std::uint16_t> objects;
  int nearest = sonar.bin_count, farthest = -1;
  for (int bin = 0; bin < sonar.bin_count; ++bin) {
    for (int beam = 0; beam < sonar.beam_count; ++beam) {
      const std::uint16_t label = ping.instance[static_cast<std::size_t>(bin) * sonar.beam_count + beam];
      if (label != kNoLabel) {
        objects.insert(label);
        nearest = std::min(nearest, bin);
        farthest = bin;
      }
    }
  }
  const auto present =
      std::ranges::count_if(scene.instances, [](const Instance& instance) { return instance.present; });
  if (objects.empty()) {
    return fmt::format("first ping: echoes of none of {} object{}{}", present, present == 1 ? "" : "s",
                       soundings_text(ping));
  }
  return fmt::format("first ping: echoes of {} of {} object{}, from {:.3g} to {:.3g} m{}", objects.size(), present,
                     present == 1 ? "" : "s", sonar.bin_range(nearest), sonar.bin_range(farthest),
                     soundings_text(ping));
}

}  // namespace insonify
