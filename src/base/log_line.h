// log_line.h -- writes to the log; all code that logs goes through here.

#pragma once

#include <string_view>

#include "insonify/log.h"

namespace insonify {

/// Passes `message`, made printable, to `log` unless that is empty.
void log_line(const Log& log, Severity severity, std::string_view message);

}  // namespace insonify
