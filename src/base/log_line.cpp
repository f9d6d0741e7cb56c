// log_line.cpp -- makes every log message printable, whatever it quotes.

#include "base/log_line.h"

#include "insonify/printable.h"

namespace insonify {

void log_line(const Log& log, Severity severity, std::string_view message) {
  if (log) {
    log(severity, printable(message, kLongestMessage));
  }
}

}  // namespace insonify
