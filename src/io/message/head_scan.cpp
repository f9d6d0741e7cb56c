// head_scan.cpp -- finds first returns and the ends of turns.

#include "io/message/head_scan.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace insonify {
namespace {

constexpr double kSameStep = 1e-6;  // Rounding of angles [rad].

bool keeps_turning(const SonarConfig& sonar) {
  return sonar.head.sector_width > 2 * std::numbers::pi - kSameStep;
}

}  // namespace

std::optional<int> first_return(const Ping& raised, const Display& display) {
  const auto is_above = [&](int bin) {
    return shown_level(display, static_cast<double>(raised.intensity[raised.index(bin, 0)])) >= kReturnShare;
  };
  int bin = 0;
  while (bin < raised.bin_count && is_above(bin)) {
    ++bin;
  }
  while (bin < raised.bin_count && !is_above(bin)) {
    ++bin;
  }
  return bin < raised.bin_count ? std::optional(bin) : std::nullopt;
}

void HeadScan::add(const Ping& ping, const Ping& raised, std::uint64_t time_ns, const SonarConfig& sonar,
                   const Display& display) {
  if (std::exchange(ended_, {})) {  // The ping at an edge of the sector ends a sweep and begins the next.
    lines_.erase(lines_.begin(), keeps_turning(sonar) ? lines_.end() : lines_.end() - 1);
  }
  constexpr float kNone = std::numeric_limits<float>::infinity();
  Line line{ping.number, time_ns, ping.head_angle, kNone, -kNone};
  if (const std::optional<int> bin = first_return(raised, display)) {
    line.range = static_cast<float>(sonar.bin_range(*bin));
    line.intensity = 10 * std::log10(ping.intensity[ping.index(*bin, 0)]);
  }
  if (!lines_.empty() && (line.number != lines_.back().number + 1 || time_ns < lines_.back().time_ns)) {
    lines_.clear();
  }
  if (lines_.size() > 1 &&
      std::abs(line.angle - lines_.back().angle - (lines_[1].angle - lines_[0].angle)) > kSameStep) {
    lines_.erase(lines_.begin(), lines_.end() - 1);  // The head has turned back.
  }
  lines_.push_back(line);
  if (lines_.size() > 1 && lines_.size() >= sonar.pings_per_turn()) {
    ended_ = made(sonar);
  }
}

HeadScan::Ended HeadScan::made(const SonarConfig& sonar) const {
  constexpr double kNanoseconds = 1e-9;
  const auto steps = static_cast<double>(lines_.size() - 1);
  const Line &first = lines_.front(), &last = lines_.back();
  const double interval = static_cast<double>(last.time_ns - first.time_ns) * kNanoseconds / steps;
  Ended ended{.time_ns = first.time_ns, .first_ping = first.number, .scan = {}};
  ended.scan = {.first_angle = std::remainder(first.angle, 2 * std::numbers::pi),
                .step = (last.angle - first.angle) / steps,
                .interval = interval,
                .duration = interval * (keeps_turning(sonar) ? steps + 1 : steps),
                .least_range = sonar.min_range,
                .most_range = sonar.max_range,
                .ranges = {},
                .intensities = {}};
  for (const Line& line : lines_) {
    ended.scan.ranges.push_back(line.range);
    ended.scan.intensities.push_back(line.intensity);
  }
  return ended;
}

}  // namespace insonify
