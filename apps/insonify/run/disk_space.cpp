// disk_space.cpp -- compares the size of recordings with the free space of the file system.

#include "run/disk_space.h"

#include <array>
#include <system_error>

#include "console/console.h"

namespace insonify {
namespace {

// "1.5 GB", in decimal units.
std::string bytes_text(std::uint64_t bytes) {
  constexpr std::array<const char*, 6> kUnits = {"bytes", "kB", "MB", "GB", "TB", "PB"};
  auto size = static_cast<double>(bytes);
  std::size_t unit = 0;
  for (; size >= 999.5 && unit + 1 < kUnits.size(); ++unit) {
    size /= 1000;
  }
  return size < 10 && unit > 0 ? fmt::format("{:.1f} {}", size, kUnits[unit])
                               : fmt::format("{:.0f} {}", size, kUnits[unit]);
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

}  // namespace insonify
