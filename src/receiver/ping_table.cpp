// ping_table.cpp -- checks that a ping has the shape of its sonar, and replaces NaN intensities by 0.

#include "receiver/ping_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "insonify/error.h"
#include "insonify/printable.h"

namespace insonify {

void check_ping(const Ping& ping, const SonarConfig& sonar) {
  if (ping.beam_count != sonar.beam_count || ping.bin_count != sonar.bin_count) {
    throw Error(fmt::format("ping {} of {} has {} x {}, must have {} x {}", ping.number, sonar.name,
                            counted(ping.beam_count, "beam"), counted(ping.bin_count, "bin"), sonar.beam_count,
                            sonar.bin_count));
  }
  const std::size_t cells = static_cast<std::size_t>(ping.beam_count) * static_cast<std::size_t>(ping.bin_count);
  const auto check = [&](std::size_t size, const char* values) {
    if (size != cells) {
      throw Error(fmt::format("ping {} of {} has {} {}, must have {}", ping.number, sonar.name, size, values, cells));
    }
  };
  check(ping.intensity.size(), "intensities");
  if (!ping.elevation.empty()) {
    check(ping.elevation.size(), "elevations");
  }
  if (!ping.soundings.empty() && ping.soundings.size() != static_cast<std::size_t>(sonar.beam_count)) {
    throw Error(fmt::format("ping {} of {} has {} soundings, must have {}", ping.number, sonar.name,
                            ping.soundings.size(), sonar.beam_count));
  }
}

void check_numbers(const std::vector<std::uint16_t>& numbers, const SonarConfig& sonar) {
  const std::size_t cells = static_cast<std::size_t>(sonar.beam_count) * static_cast<std::size_t>(sonar.bin_count);
  if (numbers.size() != cells) {
    throw Error(fmt::format("{}: there are {} numbers of bins, must be {}", sonar.name, numbers.size(), cells));
  }
}

std::vector<float> clean_intensities(const Ping& ping) {
  std::vector<float> table = ping.intensity;
  std::replace_if(
      table.begin(), table.end(), [](float value) { return std::isnan(value); }, 0.0F);
  return table;
}

}  // namespace insonify
