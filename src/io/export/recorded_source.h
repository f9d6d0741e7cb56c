// recorded_source.h -- what messages and pictures tell of a sonar, from its recording.

#pragma once

#include "insonify/messages.h"
#include "io/recording/recording_file.h"

namespace insonify {

/// @throws Error with the path for a recording without model or settings.
[[nodiscard]] EchoModel model_of(const RecordingFile& recording);
[[nodiscard]] MessageSource message_source(const RecordingFile& recording);

}  // namespace insonify
