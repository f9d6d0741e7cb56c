// stop.h -- handles requests to end a run: SIGINT (Ctrl-C), SIGTERM, and SIGHUP (the terminal is gone).

#pragma once

#include <atomic>

namespace insonify {

/// From this call on these signals end the program at once with a one-line message: there are no results to keep yet.
/// One that was ignored at the start, as SIGINT in a background job and SIGHUP under nohup, stays ignored.
void end_when_asked();

/// From this call on the signals set stop_asked(); a second one ends the program.
void note_when_asked();

/// Flag set by the signals. Valid as long as the program runs.
[[nodiscard]] const std::atomic<bool>& stop_asked();

}  // namespace insonify
