// interruption.cpp -- the interruption flag of each thread.

#include "base/interruption.h"

#include <utility>

#include "insonify/interrupted.h"

namespace insonify {
namespace {

thread_local const std::atomic<bool>* flag = nullptr;

}  // namespace

InterruptionScope::InterruptionScope(const std::atomic<bool>& asked) : before_(std::exchange(flag, &asked)) {}

InterruptionScope::~InterruptionScope() {
  flag = before_;
}

void check_interruption() {
  if (flag != nullptr && flag->load(std::memory_order_relaxed)) {
    throw Interrupted();
  }
}

}  // namespace insonify
