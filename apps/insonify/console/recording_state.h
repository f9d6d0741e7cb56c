// recording_state.h -- how a recording's state is told.

#pragma once

#include "insonify/recording_info.h"

namespace insonify {

/// "whole", "growing", "unfinished", "disk_full": for JSON.
[[nodiscard]] const char* state_word(RecordingState state);

/// What is not as it should be: "unfinished: the run that wrote it was killed"; "" of a whole recording.
[[nodiscard]] const char* state_text(const RecordingInfo& info);

}  // namespace insonify
