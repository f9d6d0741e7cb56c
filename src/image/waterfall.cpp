// waterfall.cpp -- draws pings of one beam as columns, averaged where there are more of them than pixels.

#include "insonify/waterfall.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "image/colours.h"
#include "image/plot.h"
#include "image/scales.h"
#include "insonify/error.h"
#include "insonify/printable.h"
#include "receiver/ping_table.h"

namespace insonify {
namespace {

// Ticks at the middle of round places among the pings, named by their numbers.
std::vector<AxisTick> ping_ticks(const std::vector<std::uint64_t>& numbers) {
  constexpr int kMostParts = 8;
  const auto count = static_cast<double>(numbers.size());
  std::vector<AxisTick> ticks;
  for (const double place : multiples_within(0, count - 1, std::max(1.0, nice_step(count, kMostParts)))) {
    const auto index = static_cast<std::size_t>(std::lround(place));
    ticks.push_back({(place + 0.5) / count, fmt::format("{}", numbers[index]), index == 0});
  }
  return ticks;
}

}  // namespace

Waterfall::Waterfall(const SonarConfig& sonar) : sonar_(sonar) {
  if (sonar.beam_count != 1) {
    throw Error(fmt::format("{} has {}: a waterfall must have one", sonar.name, counted(sonar.beam_count, "beam")));
  }
}

void Waterfall::add(const Ping& ping) {
  check_ping(ping, sonar_);
  profiles_.push_back(clean_intensities(ping));
  numbers_.push_back(ping.number);
  last_time_ = ping.time;
}

Picture Waterfall::draw(const Display& display) const {
  display.validate();
  if (profiles_.empty()) {
    throw Error(fmt::format("{}: a waterfall must have at least one ping", sonar_.name));
  }
  const PlotAxes axes{ping_ticks(numbers_), range_ticks(sonar_), "ping", "range (m)"};
  std::vector<float> mean;
  return plot_picture(
      display, heading_of(sonar_, counted(profiles_.size(), "ping"), last_time_), axes,
      static_cast<int>(profiles_.size()), sonar_.bin_count, [&](int x, int width) {
        const double step = static_cast<double>(profiles_.size()) / width;
        const auto first = static_cast<std::size_t>(x * step);
        const auto end = std::clamp(static_cast<std::size_t>((x + 1) * step), first + 1, profiles_.size());
        mean.assign(profiles_[first].size(), 0);
        for (std::size_t ping = first; ping < end; ++ping) {
          std::ranges::transform(mean, profiles_[ping], mean.begin(),
                                 [&](float sum, float value) { return sum + value / static_cast<float>(end - first); });
        }
        return std::span<const float>(mean);
      });
}

}  // namespace insonify
