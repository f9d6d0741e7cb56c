// log_to_user.h -- shows what the library reports while a command runs.

#pragma once

#include "insonify/log.h"

namespace insonify {

/// Prints messages to the standard output and warnings to the standard error stream.
/// @param quiet  Prints warnings only.
[[nodiscard]] Log log_to_user(bool quiet);

}  // namespace insonify
