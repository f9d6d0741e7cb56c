// recording_state.cpp -- words and sentences for the states of a recording.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

#include "insonify/printable.h"
#include "insonify/recording_info.h"

namespace insonify {

const char* state_word(RecordingState state) {
  switch (state) {
    case RecordingState::kGrowing:
      return "growing";
    case RecordingState::kUnfinished:
      return "unfinished";
    case RecordingState::kDiskFull:
      return "disk_full";
    case RecordingState::kWhole:
      break;
  }
  return "whole";
}

const char* state_text(RecordingState state, std::string_view format) {
  switch (state) {
    case RecordingState::kGrowing:
      return "being written";
    case RecordingState::kUnfinished:
      return format == "MCAP" ? "unfinished: the run that wrote it was killed, or the disk was full"
                              : "unfinished: the run that wrote it was killed";
    case RecordingState::kDiskFull:
      return "cut short: the disk was full";
    case RecordingState::kWhole:
      break;
  }
  return "";
}

std::string unfinished_text(const std::filesystem::path& path, const RecordingInfo& info) {
  if (info.state == RecordingState::kWhole) {
    return "";
  }
  std::vector<std::string> pings;
  for (const RecordedSonar& sonar : info.sonars) {
    pings.push_back(counted(sonar.pings, "ping") + (info.sonars.size() > 1 ? " of " + sonar.config.name : ""));
  }
  return fmt::format("{} is {}; it has {}", path.string(), state_text(info.state, info.format), fmt::join(pings, ", "));
}

}  // namespace insonify
