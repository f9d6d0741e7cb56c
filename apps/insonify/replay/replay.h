// replay.h -- insonify replay --view: shows the recordings of a run in the viewer.

#pragma once

#include <string>

#include "replay/recorded_run.h"
#include "serve/page_server.h"

namespace insonify {

struct ReplayOptions {
  RecordedRunOptions run;
  PageServerOptions server;
  double speed = 1;  ///< Seconds of the recording in a second.
  bool paused = false;
};

/// @return  kDone. @throws InputError for wrong input, Error for a failure while running
int replay(const ReplayOptions& options);

}  // namespace insonify
