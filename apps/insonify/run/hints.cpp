// hints.cpp -- compares recordings with the free space; finds the largest echo, and suggests why it is none or weak.

#include "run/hints.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <system_error>

#include "console/console.h"

namespace insonify {
namespace {

std::string point_text(const Vec3& point) {
  // Adding zero turns -0 into 0.
  const auto rounded = [](double value) { return std::round(value * 100) / 100 + 0; };
  return fmt::format("({:.7g}, {:.7g}, {:.7g})", rounded(point.x()), rounded(point.y()), rounded(point.z()));
}

// The settings of a sonar that silence bins or beams: " (dead_range)", "; 3 of its 16 beams are missing
// (missing_beams)"; "" if there are none.
std::string silenced_text(const SonarConfig& sonar) {
  std::string text;
  if (sonar.dead_range > sonar.bin_range(sonar.bin_count - 1)) {
    text = fmt::format("; dead_range = {:.4g} m leaves it no bin", sonar.dead_range);
  } else if (sonar.dead_range > sonar.min_range) {
    text = " (dead_range)";
  }
  const std::set<int> missing(sonar.missing_beams.begin(), sonar.missing_beams.end());
  if (!missing.empty()) {
    text +=
        fmt::format("; {} of its {} beams are missing (missing_beams)",
                    std::ssize(missing) == sonar.beam_count ? "all" : fmt::to_string(missing.size()), sonar.beam_count);
  }
  return text;
}

}  // namespace

void report_disk_space(const Scenario& scenario, const ScenarioRequests& requests, const std::filesystem::path& folder,
                       const RunOptions& options, const MessageOptions& messages) {
  std::uint64_t needed = 0;
  bool at_most = options.compress;
  for (std::size_t i = 0; i < scenario.sonars.size(); ++i) {
    const std::uint64_t pings = requests.ping_count(static_cast<int>(i));
    for (const RecordingFormat* format : options.record) {
      needed += format->bytes(scenario, scenario.sonars[i], pings, messages);
      at_most = at_most || format->has_messages;
    }
  }
  std::filesystem::path there = std::filesystem::absolute(folder);
  std::error_code error;
  while (!std::filesystem::exists(there, error) && there.has_relative_path()) {
    there = there.parent_path();
  }
  const std::filesystem::space_info space = std::filesystem::space(there, error);
  if (error) {
    return;  // Some file systems do not report their free space.
  }
  const std::string text = fmt::format("the recordings need {}{}, {} are free", at_most ? "at most " : "",
                                       bytes_text(needed), bytes_text(space.available));
  if (needed > space.available) {
    complain(fmt::format("warning: {}: {}; a full disk ends the run, which keeps the pings made so far",
                         folder.string(), text));
  } else if (!options.quiet) {
    say("disk: {}\n", text);
  }
}

void Loudness::add(const Ping& ping) {
  for (std::size_t i = 0; i < ping.intensity.size(); ++i) {
    // Without labels, noise cannot be distinguished from an echo.
    if (ping.instance.empty() || ping.instance[i] != kNoLabel) {
      loudest_ = std::max(loudest_, static_cast<double>(ping.intensity[i]));
    }
  }
}

bool receives_more_than_surfaces(const Scenario& scenario) {
  return !scenario.points.empty() || !scenario.interferers.empty() || scenario.water.volume_backscatter_db.has_value();
}

std::string silence_text(const Simulator& simulator, int sonar) {
  const Box3 world = simulator.scene().bounds();
  const Pose world_from_head = simulator.world_from_head(sonar, ScenarioRequests(simulator.scenario()).at(sonar, 0));
  const SonarConfig& config = simulator.sonar(sonar);
  const std::string where = world.low.x() > world.high.x() ? "there is nothing but the water's surface"
                                                           : fmt::format("the world reaches from {} to {} m",
                                                                         point_text(world.low), point_text(world.high));
  return fmt::format(
      "nothing was received in any ping of {}: {}, the sonar was at {} m at first, looking along {}, and receives from "
      "{:.4g} to {:.4g} m{}",
      config.name, where, point_text(world_from_head.position), point_text(world_from_head.orientation * Vec3::UnitX()),
      std::max(config.min_range, config.dead_range), config.max_range, silenced_text(config));
}

std::string dimness_text(const Loudness& loudness, const SonarConfig& sonar) {
  return fmt::format("the loudest echo of {} is {:.2g} % of full scale, nearly black: --scale db shows it, or raise {}",
                     sonar.name, 100 * loudness.loudest(),
                     loudness.loudest() > 0 ? fmt::format("its gain: --set sonars.{}.gain={:.2g}", sonar.name,
                                                          sonar.gain / loudness.loudest())
                                            : "its gain");
}

}  // namespace insonify
