// interpreter_lock.h -- gives the interpreter's lock back while C++ computes, also in threads that Python leaves behind
// at its end.

#pragma once

#include <pybind11/pybind11.h>

#include <atomic>

namespace insonify::python {

// Once it has begun to end, Python stops a daemon thread that asks for the lock by an exception that no destructor lets
// through: the process aborts. So the end waits for threads that compute, which stop_at_end() makes short, and these
// wait for the end of the process instead of the lock.

/// True while the end waits; for Simulator::stop_when().
[[nodiscard]] const std::atomic<bool>& stop_at_end();

/// Without the lock while it lives, as py::gil_scoped_release.
class Released {
 public:
  Released();
  ~Released();
  Released(const Released&) = delete;
  Released& operator=(const Released&) = delete;

 private:
  PyThreadState* state_;
};

/// With the lock while it lives, as py::gil_scoped_acquire.
class Locked {
 public:
  /// @throws Interrupted in a thread that is left behind.
  Locked();
  ~Locked() { PyGILState_Release(state_); }
  Locked(const Locked&) = delete;
  Locked& operator=(const Locked&) = delete;

 private:
  PyGILState_STATE state_;
};

/// Has Python wait for the threads at its end.
void bind_end();

}  // namespace insonify::python
