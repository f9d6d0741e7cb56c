// recording_state.cpp -- words and sentences for the states of a recording.

#include "console/recording_state.h"

namespace insonify {

const char* state_word(RecordingState state) {
  switch (state) {
    case RecordingState::kGrowing:
      return "growing";
    case RecordingState::kUnfinished:
      return "unfinished";
    case RecordingState::kWhole:
      break;
  }
  return "whole";
}

const char* state_text(RecordingState state) {
  switch (state) {
    case RecordingState::kGrowing:
      return "being written";
    case RecordingState::kUnfinished:
      return "unfinished: the run that wrote it was killed";
    case RecordingState::kWhole:
      break;
  }
  return "";
}

}  // namespace insonify
