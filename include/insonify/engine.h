// engine.h -- choices of how echoes are computed, and the names of the engines that compute them.

#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace insonify {

/// How the nearest surface in each direction is found; the echoes are the same.
enum class PrimaryEchoes {
  kAuto,  ///< Whichever is likely to be faster.
  kRays,
  kRaster  ///< Triangles drawn into the fan's own columns and rows. `reference` traces rays all the same.
};

/// From which hits a reflected ray is traced to a second surface.
enum class SecondaryEchoes {
  kNone,
  kSelective,  ///< A random sample of the hits, preferring those that can give a strong echo, with weights that keep
               ///< sums unbiased; all hits whose ray may hit something where these are few.
  kAll
};

/// Model of scattering and propagation.
enum class EchoModel {
  kPaper,      ///< That of the paper: echoes shaped to 0..1 and averaged in each bin. See paper_model.h.
  kCalibrated  ///< Echo intensities relative to the source's at 1 m, summed in each bin: 10 log10 of a sum is EL - SL.
};

/// Rays that one ping sent.
struct RayCounts {
  std::uint64_t primary = 0;    ///< Rays continued behind surfaces that transmit sound count again.
  std::uint64_t secondary = 0;  ///< Reflected, and the few probes by which kSelective chooses.
  std::uint64_t return_legs = 0;

  RayCounts& operator+=(const RayCounts& other) {
    primary += other.primary;
    secondary += other.secondary;
    return_legs += other.return_legs;
    return *this;
  }
};

/// Memory that an engine uses for a scene, besides the meshes themselves.
struct EngineMemory {
  std::size_t own = 0;      ///< Vertices, normals and tables [bytes].
  std::size_t library = 0;  ///< Memory allocated by the ray-tracing library [bytes].
};

/// Finds the echoes of pings on one kind of hardware; Simulator::engine() has one. What it can do is the library's own
/// matter: pass it to fitting_view() and the like.
class Engine;

/// Names of the engines built in, fastest first.
[[nodiscard]] std::vector<std::string_view> engine_names();

}  // namespace insonify
