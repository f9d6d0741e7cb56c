// secondary_echo.cpp -- powers of secondary echoes in the `paper` model, in vector loops.

#include "echo/mirror/secondary_echo.h"

#include "base/vector_math.h"
#include "echo/laws/laws.h"

namespace insonify {
namespace {

INSONIFY_VECTOR_CLONES
void absorb(int count, float neper_per_metre, const float* __restrict__ strength, const float* __restrict__ length,
            float* __restrict__ left) {
  for (int i = 0; i < count; ++i) {
    left[i] = absorbed(strength[i], neper_per_metre, length[i]);
  }
}

}  // namespace

void secondary_powers(const FlatPlan& plan, int count, const float* strength, const float* rest, float* power) {
  absorb(count, plan.neper_per_metre, strength, rest, power);
  plan.shape.apply(count, power, power);
}

}  // namespace insonify
