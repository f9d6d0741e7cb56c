// log_line.h -- writes to the log; all code that logs goes through here.

#pragma once

#include <string_view>

#include "insonify/log.h"
#include "insonify/printable.h"

namespace insonify {

/// Passes `message`, made printable, to `log` unless that is empty.
inline void log_line(const Log& log, Severity severity, std::string_view message) {
  if (log) {
    log(severity, printable(message, kLongestMessage));
  }
}

}  // namespace insonify
