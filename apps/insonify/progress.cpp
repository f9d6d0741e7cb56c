// progress.cpp -- how far a run is, on a terminal or in a pipe.

#include "progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <string>

namespace insonify {
namespace {

constexpr int kBarWidth = 30;  // [characters]
constexpr std::chrono::milliseconds kRedrawEvery{100};
constexpr std::chrono::seconds kLineEvery{2};

std::string duration(double seconds) {
  const auto whole = static_cast<long>(std::ceil(seconds));
  if (whole >= 3600) {
    return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
  }
  return whole >= 60 ? fmt::format("{} min {:02} s", whole / 60, whole % 60) : fmt::format("{} s", whole);
}

}  // namespace

Progress::Progress(std::uint64_t total, bool quiet)
    : total_(total), quiet_(quiet), terminal_(isatty(STDOUT_FILENO) != 0), start_(Clock::now()), last_(start_) {}

Progress::~Progress() {
  finish();
}

void Progress::advance() {
  ++done_;
  const Clock::time_point now = Clock::now();
  const bool due = terminal_ ? now - last_ >= kRedrawEvery : now - last_ >= kLineEvery;
  if (!quiet_ && due) {
    last_ = now;
    draw();
  }
}

void Progress::draw() {
  const double elapsed = std::chrono::duration<double>(last_ - start_).count();
  const double rate = static_cast<double>(done_) / elapsed;
  const double left = static_cast<double>(total_ - done_) / rate;
  if (terminal_) {
    const auto filled = static_cast<std::size_t>(static_cast<double>(kBarWidth * done_) / static_cast<double>(total_));
    const std::string bar = std::string(filled, '#') + std::string(kBarWidth - filled, '.');
    fmt::print("\r[{}] {}/{} pings  {:.1f} pings/s  {} left\x1b[K", bar, done_, total_, rate, duration(left));
    drawn_ = true;
  } else {
    fmt::print("{} of {} pings, {:.1f} pings/s, {} left\n", done_, total_, rate, duration(left));
  }
  std::fflush(stdout);
}

void Progress::finish() {
  if (drawn_) {
    fmt::print("\r\x1b[K");
    drawn_ = false;
  }
}

}  // namespace insonify
