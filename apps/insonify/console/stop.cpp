// stop.cpp -- signal handlers. What they call is async-signal-safe.

#include "console/stop.h"

#include <unistd.h>

#include <csignal>
#include <string_view>

#include "console/console.h"
#include "console/outcome.h"

namespace insonify {
namespace {

std::atomic<bool> asked = false, asked_for_report = false;
static_assert(std::atomic<bool>::is_always_lock_free, "handlers of signals must not wait");
bool terminal = false;  // Whether the standard error stream is a terminal.

void end_now(int) {
  constexpr std::string_view kMessage = "insonify: interrupted before the first ping\n";
  clear_status();
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, kMessage.data(), kMessage.size());
  _exit(kFailed);
}

void note(int signal) {
  constexpr std::string_view kMessage = "insonify: stopping; once more ends the program at once\n";
  asked = true;
  if (terminal) {
    clear_status();
    [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, kMessage.data(), kMessage.size());
  }
  std::signal(signal, SIG_DFL);
}

void handle_with(void (*handler)(int), IgnoredInterrupt ignored) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const bool ends = signal == SIGINT && ignored == IgnoredInterrupt::kEnds;
    if (std::signal(signal, handler) == SIG_IGN && !ends) {
      std::signal(signal, SIG_IGN);
    }
  }
}

}  // namespace

void end_when_asked(IgnoredInterrupt ignored) {
  handle_with(end_now, ignored);
}

void note_when_asked(IgnoredInterrupt ignored) {
  terminal = isatty(STDERR_FILENO) != 0;
  handle_with(note, ignored);
  if (ignored == IgnoredInterrupt::kEnds) {
    std::signal(SIGUSR1, [](int) { asked_for_report = true; });
  }
}

const std::atomic<bool>& stop_asked() {
  return asked;
}

bool report_asked() {
  return asked_for_report.exchange(false);
}

}  // namespace insonify
