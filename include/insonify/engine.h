// engine.h -- options for computing echoes, and the names of the engines.

#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "insonify/words.h"

namespace insonify {

/// How the nearest surface in each direction is found; the echoes are the same.
enum class PrimaryEchoes {
  kAuto,  ///< Picks the faster method by a cost model.
  kRays,
  kRaster  ///< Triangles drawn into the fan's columns and rows. `reference` always traces rays.
};
template <>
constexpr auto words_of<PrimaryEchoes>() {
  return EnumWords<PrimaryEchoes, 3>{
      {{"auto", PrimaryEchoes::kAuto}, {"rays", PrimaryEchoes::kRays}, {"raster", PrimaryEchoes::kRaster}}};
}

/// Selection of the hits from which a reflected ray is traced to a second surface.
enum class SecondaryEchoes {
  kNone,
  kSelective,  ///< A weighted random sample of the hits (unbiased sums) that prefers strong echoes; all hits whose ray
               ///< may hit something if these are few.
  kAll
};
template <>
constexpr auto words_of<SecondaryEchoes>() {
  return EnumWords<SecondaryEchoes, 3>{
      {{"none", SecondaryEchoes::kNone}, {"selective", SecondaryEchoes::kSelective}, {"all", SecondaryEchoes::kAll}}};
}

/// Model of scattering and propagation.
enum class EchoModel {
  kPaper,      ///< The paper's: echoes mapped to 0..1 and averaged in each bin. See paper_model.h.
  kCalibrated  ///< Echo intensities relative to the source's at 1 m, summed in each bin: 10 log10 of a sum is EL - SL.
};
template <>
constexpr auto words_of<EchoModel>() {
  return EnumWords<EchoModel, 2>{{{"paper", EchoModel::kPaper}, {"calibrated", EchoModel::kCalibrated}}};
}

/// Rays that one ping sent.
struct RayCounts {
  std::uint64_t primary = 0;    ///< Rays continued behind transmitting surfaces count again.
  std::uint64_t secondary = 0;  ///< Reflected rays, and kSelective's few probes.
  std::uint64_t return_legs = 0;

  RayCounts& operator+=(const RayCounts& other) {
    primary += other.primary;
    secondary += other.secondary;
    return_legs += other.return_legs;
    return *this;
  }
};

/// What a step of a batch took on a device.
struct StepTime {
  std::string_view step;  ///< As the file of its shader is named.
  double seconds = 0;
};

/// Memory that an engine uses for a scene, without the meshes themselves.
struct EngineMemory {
  std::size_t own = 0;      ///< Vertices, normals and tables [bytes].
  std::size_t library = 0;  ///< Memory allocated by the ray-tracing library [bytes].
};

/// Finds the echoes of pings on one kind of hardware. Opaque: pass Simulator::engine() to fitting_view() and similar
/// functions.
class Engine;

/// Names of the built-in engines.
[[nodiscard]] std::vector<std::string_view> engine_names();

/// Stands for the engine that is expected to be the fastest: one on a graphics card for fans of many beams, else `cpu`.
inline constexpr std::string_view kAutoEngine = "auto";

/// What Scenario::engine may be: kAutoEngine, and the names of the engines.
[[nodiscard]] std::vector<std::string_view> engine_choices();

/// The devices that engine `gpu` may run on, a text each: index, name, driver, and what one lacks; or why there is
/// none.
[[nodiscard]] std::vector<std::string> device_texts();

}  // namespace insonify
