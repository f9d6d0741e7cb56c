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
constexpr std::uint32_t kAddEchoes[] = {
#include "shaders/add_echoes.inc"
};
constexpr std::uint32_t kSumCells[] = {
#include "shaders/sum_cells.inc"
};
constexpr std::uint32_t kSmooth[] = {
#include "shaders/smooth.inc"
};
constexpr std::uint32_t kDrawSpeckle[] = {
#include "shaders/draw_speckle.inc"
};
constexpr std::uint32_t kShapePulse[] = {
#include "shaders/shape_pulse.inc"
};
constexpr std::uint32_t kDrawNoise[] = {
#include "shaders/draw_noise.inc"
};
constexpr std::uint32_t kFilterNoise[] = {
#include "shaders/filter_noise.inc"
};
constexpr std::uint32_t kFormBeams[] = {
#include "shaders/form_beams.inc"
};
constexpr std::uint32_t kLabelBeams[] = {
#include "shaders/label_beams.inc"
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
      gather(device, "gather", kGather),
      add_echoes(device, "add_echoes", kAddEchoes),
      sum_cells(device, "sum_cells", kSumCells),
      smooth(device, "smooth", kSmooth),
      shape_pulse(device, "shape_pulse", kShapePulse),
      draw_noise(device, "draw_noise", kDrawNoise),
      filter_noise(device, "filter_noise", kFilterNoise),
      form_beams(device, "form_beams", kFormBeams),
      label_beams(device, "label_beams", kLabelBeams) {
  if (device.info().doubles) {
    draw_speckle = gpu::Kernel(device, "draw_speckle", kDrawSpeckle);
  }
}

}  // namespace insonify
