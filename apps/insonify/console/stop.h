// stop.h -- handles requests to end a run: SIGINT (Ctrl-C), SIGTERM, and SIGHUP (the terminal is gone); for a report.

#pragma once

#include <atomic>

namespace insonify {

/// What a SIGINT means that was ignored at the start, as in what a shell's script starts with `&`.
enum class IgnoredInterrupt {
  kStays,  ///< It stays ignored: the program ends by itself.
  kEnds,   ///< It ends the program, which runs until it is stopped, and then has something to report.
};

/// From this call on these signals end the program at once with a one-line message: there are no results to keep yet.
/// A SIGHUP that was ignored at the start, as under nohup, stays ignored.
void end_when_asked(IgnoredInterrupt ignored = IgnoredInterrupt::kStays);

/// From this call on the signals set stop_asked(); a second one ends the program. With kEnds, SIGUSR1 sets
/// report_asked().
void note_when_asked(IgnoredInterrupt ignored = IgnoredInterrupt::kStays);

/// Flag set by the signals. Valid as long as the program runs.
[[nodiscard]] const std::atomic<bool>& stop_asked();

/// Whether SIGUSR1 has asked for a report since the last call.
[[nodiscard]] bool report_asked();

}  // namespace insonify
