// make_engine.cpp -- the list of engines, and the defaults of their interface.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>

#include "echo/cpu/cpu_engine.h"
#include "echo/engine.h"
#include "echo/reference/reference_engine.h"
#include "insonify/error.h"

namespace insonify {
namespace {

constexpr const EngineKind* kKinds[] = {&CpuEngine::kKind, &ReferenceEngine::kKind};

}  // namespace

std::vector<std::string_view> engine_names() {
  std::vector<std::string_view> names;
  for (const EngineKind* kind : kKinds) {
    names.push_back(kind->name);
  }
  return names;
}

const EngineKind& engine_kind(std::string_view name) {
  const auto* const found = std::ranges::find(kKinds, name, [](const EngineKind* kind) { return kind->name; });
  if (found == std::end(kKinds)) {
    throw Error(fmt::format("engine \"{}\" is unknown; there are {}", name, fmt::join(engine_names(), ", ")));
  }
  return **found;
}

std::unique_ptr<Engine> make_engine(std::string_view name, int threads) {
  if (threads < 0 || threads > 1024) {
    throw Error(fmt::format("threads = {} must be from 0 to 1024", threads));
  }
  return engine_kind(name).make(threads);
}

void Engine::insonify_all(const PingPlan& plan, std::span<const Pose> poses, std::span<EchoGrid> grids) {
  assert(poses.size() == grids.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    insonify(plan, poses[i], grids[i]);
  }
}

std::vector<double> Engine::time_traversal(const PingPlan&, const Pose&, int) {
  return {};
}

}  // namespace insonify
