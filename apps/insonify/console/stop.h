// stop.h -- handles requests to end a run: SIGINT (Ctrl-C) and SIGTERM.

#pragma once

#include <atomic>

namespace insonify {

/// From this call on SIGINT and SIGTERM end the program at once with a one-line message: there are no results to keep
/// yet. A SIGINT that was ignored at the start, as in a background job, stays ignored.
void end_when_asked();

/// From this call on the signals set stop_asked(); a second one ends the program.
void note_when_asked();

/// Flag set by the signals. Valid as long as the program runs.
[[nodiscard]] const std::atomic<bool>& stop_asked();

}  // namespace insonify
