// replay.h -- insonify replay --view: shows the recordings of a run in the viewer.

#pragma once

#include "console/command.h"

namespace insonify {

/// Adds the command, which draws pictures unless it is asked for the viewer.
void add_replay(const Command& program);

}  // namespace insonify
