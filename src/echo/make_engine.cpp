// make_engine.cpp -- engines by name.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "echo/cpu/cpu_engine.h"
#include "echo/reference/reference_engine.h"
#include "insonify/engine.h"
#include "insonify/error.h"

namespace insonify {

std::vector<std::string_view> engine_names() {
  return {"cpu", "reference"};
}

std::unique_ptr<Engine> make_engine(std::string_view name, int threads) {
  if (threads < 0 || threads > 1024) {
    throw Error(fmt::format("threads = {} must be from 0 to 1024", threads));
  }
  if (name == "cpu") {
    return std::make_unique<CpuEngine>(threads);
  }
  if (name == "reference") {
    return std::make_unique<ReferenceEngine>(threads);
  }
  throw Error(fmt::format("engine \"{}\" is unknown; there are {}", name, fmt::join(engine_names(), ", ")));
}

std::vector<double> time_traversal(Engine& engine, const PingPlan& plan, const Pose& world_from_sonar,
                                   int repetitions) {
  if (auto* cpu = dynamic_cast<CpuEngine*>(&engine)) {
    return cpu->time_traversal(plan, world_from_sonar, repetitions);
  }
  throw Error(fmt::format("engine \"{}\" traces its rays itself: there is no bare traversal to time", engine.name()));
}

}  // namespace insonify
