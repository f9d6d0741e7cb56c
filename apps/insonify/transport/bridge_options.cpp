// bridge_options.cpp -- options common to all bridges, and the list of bridges.

#include "transport/bridge_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "console/levels.h"
#include "console/outcome.h"
#include "console/validators.h"
#include "transport/bridge_kinds.h"

namespace insonify {

std::span<const BridgeKind> bridge_kinds() {
  static const BridgeKind kKinds[] = {ros1_kind(), dds_kind(), gazebo_kind()};
  return kKinds;
}

const BridgeKind& bridge_kind(std::string_view name) {
  return *std::ranges::find(bridge_kinds(), name, [](const BridgeKind& kind) { return std::string_view(kind.name); });
}

void add_bridge_options(CLI::App& command, const BridgeKind& kind, BridgeRequest& request) {
  BridgeOptions& options = request.bridge;
  command.add_option("SCENARIO", options.scenario, "Scenario file (YAML, or Stonefish's .scn)")->required();
  command.add_option("--set", options.settings, "Change a key of the scenario, such as max_range=20; may be repeated")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->allow_extra_args(false)  // Arguments for ROS may follow.
      ->take_all();
  command
      .add_option("--rate", options.live.rate_limit, "Limit of pings per second of each sonar [the sonar's own rate]")
      ->check(number_within(above_to(0, 1000)))
      ->type_name("HZ");
  command.add_option("--threads", options.live.threads, "Worker threads; 0: one per processor [0]")
      ->check(whole_number(0, 1024))
      ->type_name("N");
  command.add_flag("-q,--quiet", options.quiet, "Print only warnings and errors");

  const std::string messages = "Messages";
  command.add_option("--bits", options.messages.bits, "Bits of the values of sonar images, 8 or 16 [16]")
      ->check(one_of({"8", "16"}))
      ->type_name("N")
      ->group(messages);
  command
      .add_option_function<std::string>(
          "--levels",
          [&options](const std::string& text) {
            const auto given = parsed_levels(text);
            options.messages.low_db = given->first;
            options.messages.high_db = given->second;
          },
          "Levels of the darkest and the brightest value [dB], such as -90:-40 [-100:-40, or the receiver's]")
      ->check(levels())
      ->type_name("LOW:HIGH")
      ->group(messages);
  command
      .add_option("--fan-height", options.messages.fan_height, "Height of fan pictures in pixels, 240 to 8192 [480]")
      ->check(whole_number(240, 8192))
      ->type_name("N")
      ->group(messages);
  command.add_option("--world-frame", options.messages.world_frame, "Name of the world's frame [world]")
      ->check(not_empty("a frame, such as odom"))
      ->type_name("FRAME")
      ->group(messages);

  kind.add_options(command, request);
  command.footer(std::string(kind.footer) + "\n\nCtrl-C ends it; SIGUSR1 prints rate and latency.");
  command.allow_extras(kind.ros1_words);
}

void check_other_words(const CLI::App& command, const BridgeKind& kind) {
  std::vector<std::string> words = command.remaining();
  std::erase_if(words, [](const std::string& word) { return word.find(":=") != std::string::npos; });
  if (!words.empty()) {
    throw InputError(fmt::format("not understood: {} (insonify bridge {} --help)", fmt::join(words, " "), kind.name));
  }
}

}  // namespace insonify
