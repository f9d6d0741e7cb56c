// stop.h -- Ctrl-C, and what else asks a run to end.

#pragma once

#include <atomic>

namespace insonify {

/// From here on SIGINT and SIGTERM end the program at once, with one line: there is nothing to keep yet. A SIGINT that
/// was ignored from the start, as for a job in a shell's background, stays ignored.
void end_when_asked();

/// From here on they set stop_asked(); a second one ends the program.
void note_when_asked();

/// Whether one was noted. Lives as long as the program.
[[nodiscard]] const std::atomic<bool>& stop_asked();

}  // namespace insonify
