// serve.h -- insonify serve: makes pings live for browsers and other programs.

#pragma once

#include "console/command.h"

namespace insonify {

/// Adds the command.
void add_serve(const Command& program);

}  // namespace insonify
