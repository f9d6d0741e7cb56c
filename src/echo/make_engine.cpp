// make_engine.cpp -- the list of engines, and the defaults of their interface.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

#include "echo/cpu/cpu_engine.h"
#include "echo/engine.h"
#include "echo/gpu_kind.h"
#include "echo/reference/reference_engine.h"
#include "insonify/error.h"

namespace insonify {
namespace {

// Those that run everywhere first.
std::vector<const EngineKind*>& kinds() {
  static std::vector<const EngineKind*> list = {&CpuEngine::kKind, &gpu_kind(), &ReferenceEngine::kKind};
  return list;
}

}  // namespace

std::vector<std::string_view> engine_names() {
  std::vector<std::string_view> names;
  for (const EngineKind* kind : kinds()) {
    names.push_back(kind->name);
  }
  return names;
}

std::vector<std::string_view> engine_choices() {
  std::vector<std::string_view> choices = engine_names();
  choices.insert(choices.begin(), kAutoEngine);
  return choices;
}

std::vector<const EngineKind*> kinds_on_devices() {
  std::vector<const EngineKind*> found;
  std::ranges::copy_if(kinds().rbegin(), kinds().rend(), std::back_inserter(found),
                       [](const EngineKind* kind) { return kind->find_hardware != nullptr; });
  return found;
}

const EngineKind& engine_kind(std::string_view name) {
  const auto found = std::ranges::find(kinds(), name, [](const EngineKind* kind) { return kind->name; });
  if (found == kinds().end()) {
    throw Error(fmt::format("engine \"{}\" is unknown; there are {}", name, fmt::join(engine_names(), ", ")));
  }
  return **found;
}

void add_engine_kind(const EngineKind& kind) {
  kinds().push_back(&kind);
}

std::unique_ptr<Engine> make_engine(std::string_view name, Workers& workers, std::string_view device) {
  return engine_kind(name).make(workers, device);
}

std::vector<std::string> device_texts() {
  return gpu_device_texts();
}

std::vector<double> Engine::time_traversal(const PingView&, int) {
  return {};
}

}  // namespace insonify
