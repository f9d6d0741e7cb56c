// denormals.h -- flushes denormal numbers to zero within a scope: they make arithmetic many times slower.

#pragma once

#include <cstdint>

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace insonify {

/// Switches denormal numbers off in this thread, as Embree wants it, and restores what was there. Does nothing on
/// processors other than x86-64 and 64-bit ARM.
class DenormalsOff {
 public:
  DenormalsOff() : saved_(control()) { set_control(saved_ | kOff); }
  ~DenormalsOff() { set_control(saved_); }
  DenormalsOff(const DenormalsOff&) = delete;
  DenormalsOff& operator=(const DenormalsOff&) = delete;

 private:
#if defined(__SSE__)
  using Control = std::uint32_t;
  static constexpr Control kOff = 0x8040;  // MXCSR: flush results to zero, take operands as zero.
  static Control control() {
    return _mm_getcsr();
  }
  static void set_control(Control control) {
    _mm_setcsr(control);
  }
#elif defined(__aarch64__)
  using Control = std::uint64_t;
  static constexpr Control kOff = 1U << 24;  // FZ in FPCR: both.
  static Control control() {
    Control control;
    asm volatile("mrs %0, fpcr" : "=r"(control));
    return control;
  }
  static void set_control(Control control) {
    asm volatile("msr fpcr, %0" : : "r"(control));
  }
#else
  using Control = std::uint32_t;
  static constexpr Control kOff = 0;
  static Control control() {
    return 0;
  }
  static void set_control(Control /*control*/) {}
#endif
  Control saved_;
};

}  // namespace insonify
