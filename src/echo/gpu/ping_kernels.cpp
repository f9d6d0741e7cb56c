// ping_kernels.cpp -- the compiled shaders of a ping.

#include "echo/gpu/ping_kernels.h"

namespace insonify {
namespace {

constexpr std::uint32_t kTracePrimaries[] = {
#include "shaders/trace_primaries.inc"
};
constexpr std::uint32_t kTurnUp[] = {
#include "shaders/turn_up.inc"
};
constexpr std::uint32_t kEvaluate[] = {
#include "shaders/evaluate.inc"
};
constexpr std::uint32_t kSelect[] = {
#include "shaders/select.inc"
};
constexpr std::uint32_t kDeposit[] = {
#include "shaders/deposit.inc"
};
constexpr std::uint32_t kCountGroups[] = {
#include "shaders/count_groups.inc"
};
constexpr std::uint32_t kMirror[] = {
#include "shaders/mirror.inc"
};
constexpr std::uint32_t kReflect[] = {
#include "shaders/reflect.inc"
};
constexpr std::uint32_t kGather[] = {
#include "shaders/gather.inc"
};

}  // namespace

PingKernels::PingKernels(gpu::Device& device)
    : trace_primaries(device, "trace_primaries", kTracePrimaries),
      turn_up(device, "turn_up", kTurnUp),
      evaluate(device, "evaluate", kEvaluate),
      select(device, "select", kSelect),
      deposit(device, "deposit", kDeposit),
      count_groups(device, "count_groups", kCountGroups),
      reflect(device, "reflect", kReflect),
      mirror(device, "mirror", kMirror),
      gather(device, "gather", kGather) {}

}  // namespace insonify
