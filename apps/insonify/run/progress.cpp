// progress.cpp -- draws the progress of a run on a terminal or prints it to a pipe.

#include "run/progress.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "console/console.h"
#include "insonify/printable.h"

namespace insonify {
namespace {

constexpr std::size_t kBarWidth = 30;  // [characters]
constexpr std::chrono::milliseconds kRedrawEvery{100};
constexpr std::chrono::seconds kLineEvery{2};

std::string duration(double seconds) {
  const auto whole = static_cast<long>(std::ceil(seconds));
  if (whole >= 3600) {
    return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
  }
  return whole >= 60 ? fmt::format("{} min {:02} s", whole / 60, whole % 60) : fmt::format("{} s", whole);
}

// Progress bar with as much text as the width allows.
std::string bar_line(double share, const std::string& count, const std::string& rate, const std::string& left,
                     std::size_t width) {
  constexpr std::size_t kShortestBar = 8;
  const std::string whole = fmt::format("{}  {}  {}", count, rate, left);
  const std::string most = fmt::format("{}  {}", count, left);
  const std::string& text = whole.size() <= width ? whole : most.size() <= width ? most : count;
  const std::size_t room = width - std::min(width, text.size() + 3);
  if (room < kShortestBar) {
    return text;
  }
  const std::size_t length = std::min(room, kBarWidth);
  const auto filled = static_cast<std::size_t>(static_cast<double>(length) * share);
  return fmt::format("[{:.<{}}] {}", std::string(filled, '#'), length, text);
}

}  // namespace

Progress::Progress(std::uint64_t total, bool quiet)
    : total_(total), quiet_(quiet), start_(Clock::now()), last_(start_) {}

Progress::~Progress() {
  clear_status();
}

void Progress::advance() {
  ++done_;
  const Clock::time_point now = Clock::now();
  const bool due = can_redraw() ? now - last_ >= kRedrawEvery : now - last_ >= kLineEvery;
  if (!quiet_ && due) {
    last_ = now;
    draw();
  }
}

void Progress::draw() {
  const double elapsed = std::chrono::duration<double>(last_ - start_).count();
  const double pings_per_s = static_cast<double>(done_) / elapsed;
  const std::string rate = fmt::format("{:.1f} pings/s", pings_per_s);
  const std::string left = duration(static_cast<double>(total_ - done_) / pings_per_s) + " left";
  if (can_redraw()) {
    const std::string count = fmt::format("{}/{} pings", done_, total_);
    show_status(
        bar_line(static_cast<double>(done_) / static_cast<double>(total_), count, rate, left, terminal_width() - 1));
  } else {
    say("{} of {}, {}, {}\n", done_, counted(total_, "ping"), rate, left);
    flush_output();
  }
}

}  // namespace insonify
