// interpreter_lock.cpp -- counts the threads that compute, which the end of Python waits for.

#include "interpreter_lock.h"

#include <pthread.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "insonify/interrupted.h"

namespace insonify::python {
namespace {

std::atomic<int> computing = 0;  // Threads within a Released, without those left behind.
std::atomic<bool> stop = false, ends = false;
std::thread::id ending_thread;  // Set before `ends`.

bool is_left_behind() {
  return ends && std::this_thread::get_id() != ending_thread;
}

[[noreturn]] void wait_for_the_end() {
  --computing;
  while (true) {
    pause();
  }
}

// Called with the lock, and before any thread is stopped.
void end() {
  ending_thread = std::this_thread::get_id();
  ends = true;
  stop = true;
  PyThreadState* const state = PyEval_SaveThread();
  while (computing > 0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  PyEval_RestoreThread(state);
  stop = false;  // Other functions that Python calls at its end may make pings.
}

}  // namespace

const std::atomic<bool>& stop_at_end() {
  return stop;
}

Released::Released() : state_(PyEval_SaveThread()) {
  ++computing;
  if (is_left_behind()) {
    wait_for_the_end();
  }
}

Released::~Released() {
  if (is_left_behind()) {
    wait_for_the_end();
  }
  PyEval_RestoreThread(state_);
  --computing;
}

Locked::Locked() {
  if (PyGILState_Check() == 0 && is_left_behind()) {
    throw Interrupted();
  }
  state_ = PyGILState_Ensure();
}

void bind_end() {
  pthread_atfork(nullptr, nullptr, [] { computing = 0; });  // A fork has only the thread that has called it.
  pybind11::module_::import("atexit").attr("register")(pybind11::cpp_function(&end));
}

}  // namespace insonify::python
