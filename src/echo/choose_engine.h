// choose_engine.h -- the engine that `auto` stands for: a device where it is expected to be faster than `cpu`.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "echo/engine.h"

namespace insonify {

/// What the time of a scenario's pings depends on.
struct PingLoad {
  int beams = 0;            ///< Most beams of one sonar.
  double samples = 0;       ///< Samples of a ping, all sonars' lattices together.
  double triangles = 0;     ///< Triangles in the scene.
  int threads = 1;          ///< Threads on the host.
  std::uint64_t pings = 0;  ///< Pings of each sonar that will be made; 0: unknown, many.
  bool bends_rays = false;  ///< Whether the water bends rays.
};

/// Expected times of one ping of each sonar [s], without what engines have in common: receivers and sources.
struct ExpectedTimes {
  double host = 0, device = 0;
};
[[nodiscard]] ExpectedTimes expected_times(const PingLoad& load);

/// Why a device would not be faster; none where it would. Depends on the load alone, so that no driver is opened in
/// vain.
[[nodiscard]] std::optional<std::string> against_device(const PingLoad& load);

/// The kind of engine for a load, and a line for the user that says which and why.
struct EngineChoice {
  const EngineKind* kind = nullptr;
  std::string text;
};

/// @param device  See Scenario::device.
[[nodiscard]] EngineChoice choose_engine(const PingLoad& load, std::string_view device);

}  // namespace insonify
