// info.h -- insonify info: describes recordings.

#pragma once

#include "console/command.h"

namespace insonify {

/// Adds the command. It describes every recording, also after one that cannot be read, and returns kWrongInput then.
void add_info(const Command& program);

}  // namespace insonify
