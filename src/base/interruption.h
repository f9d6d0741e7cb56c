// interruption.h -- lets another thread end long set-up work of this one.

#pragma once

#include <atomic>

namespace insonify {

/// While it lives, check_interruption() in this thread looks at a flag. For work that has no other way to be stopped,
/// such as making the tables of a sonar.
class InterruptionScope {
 public:
  /// @param asked  Must live as long as this.
  explicit InterruptionScope(const std::atomic<bool>& asked);
  ~InterruptionScope();
  InterruptionScope(const InterruptionScope&) = delete;
  InterruptionScope& operator=(const InterruptionScope&) = delete;

 private:
  const std::atomic<bool>* before_;
};

/// Costs some nanoseconds; does nothing in a thread without an InterruptionScope.
/// @throws Interrupted while the flag of the innermost one is true.
void check_interruption();

}  // namespace insonify
