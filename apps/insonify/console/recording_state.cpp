// recording_state.cpp -- words and sentences for the states of a recording.

#include "console/recording_state.h"

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

const char* state_text(const RecordingInfo& info) {
  switch (info.state) {
    case RecordingState::kGrowing:
      return "being written";
    case RecordingState::kUnfinished:
      return info.format == "MCAP" ? "unfinished: the run that wrote it was killed, or the disk was full"
                                   : "unfinished: the run that wrote it was killed";
    case RecordingState::kDiskFull:
      return "cut short: the disk was full";
    case RecordingState::kWhole:
      break;
  }
  return "";
}

}  // namespace insonify
