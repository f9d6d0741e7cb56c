// guarded.h -- runs a program and turns what it throws into a line and an exit status.

#pragma once

#include <functional>

namespace insonify {

/// Opens closed standard streams, runs the program, reports an error in one line.
/// @return  The exit status of the process.
[[nodiscard]] int run_guarded(const std::function<int()>& program);

}  // namespace insonify
