// sounding_grid.h -- grids the soundings of multibeams into the square cells of a chart.

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "insonify/acoustics/sound_speed_profile.h"
#include "insonify/geometry.h"
#include "insonify/sounding.h"
#include "insonify/survey/survey_order.h"
#include "insonify/words.h"

namespace insonify {

/// How the height of a cell follows from the soundings in it.
enum class GridMethod {
  kMean,    ///< Mean, weighted by the inverse of the soundings' variances.
  kMedian,  ///< Median.
  kShoal    ///< The highest of them.
};
template <>
constexpr auto words_of<GridMethod>() {
  return EnumWords<GridMethod, 3>{
      {{"mean", GridMethod::kMean}, {"median", GridMethod::kMedian}, {"shoal", GridMethod::kShoal}}};
}

/// A sounding in the world.
struct PlacedSounding {
  Vec3 position = Vec3::Zero();  ///< [m]
  float deviation = 0;           ///< Standard deviation of its height [m], > 0.
  float quality = 0;             ///< Sounding::quality.
  Detection detection = Detection::kNone;
};

/// Appends the soundings of a ping that were found, along straight rays. The standard deviation of the height is that
/// of the range times the cosine of the angle from straight down; at least a tenth of that of the range, so that beams
/// near the horizontal do not outweigh all others, and at least 1 mm.
/// @param world_from_sonar  Pose of the beams: Ping::world_from_sonar.
void place_soundings(std::span<const Sounding> soundings, const Pose& world_from_sonar,
                     std::vector<PlacedSounding>& placed);

/// The same along rays that a profile bends, as position_of() does.
void place_soundings(std::span<const Sounding> soundings, const Pose& world_from_sonar,
                     const SoundSpeedProfile& profile, double surface_level, double shown_speed,
                     std::vector<PlacedSounding>& placed);

struct SoundingGridOptions {
  double cell = 0;  ///< Side of a cell [m], >= 0; 0: the least of 1, 2 and 5 times a power of ten with which four
                    ///< fifths of the cells that have soundings have five or more.
  GridMethod method = GridMethod::kMean;
  double outliers = 4;  ///< Soundings are refused whose height differs from their cell's median by more than this many
                        ///< standard deviations, >= 0: their own or the cell's, whichever is larger. 0: none.
  int fill = 0;         ///< Widest gap between two cells of a row or a column that is filled [cells], 0..1000.
  double least_quality = 0;            ///< Soundings of a lower Sounding::quality are left out, >= 0.
  std::optional<Detection> only = {};  ///< Soundings that were found otherwise are left out; absent: none.
};

/// Heights of the bed, north (y of the world) up.
struct SoundingGrid {
  double west = 0, north = 0;  ///< World coordinates of the upper left corner [m], multiples of `cell`.
  double cell = 0;             ///< Side of a cell [m].
  int columns = 0, rows = 0;
  GridMethod method = GridMethod::kMean;

  // [row * columns + column], rows from the north.
  std::vector<float> height = {};         ///< z [m]; NaN: none.
  std::vector<float> uncertainty = {};    ///< Standard deviation of the height (1 sigma) [m]; NaN.
  std::vector<std::uint32_t> count = {};  ///< Soundings that the height follows from; 0: none, or filled.
  std::vector<float> truth = {};          ///< Height of the scene [m]; NaN: none. Empty without.

  std::uint64_t given = 0;     ///< Soundings.
  std::uint64_t left_out = 0;  ///< By quality or detection.
  std::uint64_t refused = 0;   ///< Outliers.
  std::uint64_t filled = 0;    ///< Cells.

  [[nodiscard]] std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
  }
};

/// Grids soundings. A cell's height follows from the soundings in the cell alone, and is that at their place in it.
///
/// The uncertainty of a mean is that of independent soundings, 1 / sqrt(sum of 1 / variance), that of a median
/// sqrt(pi / 2) times as much where all are alike, that of the highest its own. Means and medians of soundings that
/// scatter by more than they state have it multiplied by Birge's ratio, sqrt(chi^2 / (n - 1)) (Phys. Rev. 40, 207
/// (1932)). CUBE (Calder and Mayer, Geochem. Geophys. Geosyst. 4(6), 1048 (2003)) weighs in the same way, but carries
/// soundings to nodes around them with an uncertainty that grows with distance and slope, and keeps several hypotheses
/// of a node's depth; this does neither.
/// @throws Error without a sounding that is used, for one that is not finite, and for a grid of more than 100 million
///         cells.
[[nodiscard]] SoundingGrid make_sounding_grid(std::span<const PlacedSounding> soundings,
                                              const SoundingGridOptions& options = {});

/// How the heights of a grid differ from its truth, over all cells that have both.
struct GridErrors {
  std::uint64_t cells = 0;
  double mean = 0;       ///< Of height - truth [m].
  double deviation = 0;  ///< Standard deviation of the difference [m].
  double within_95 = 0;  ///< Size of difference that 95 % of the cells do not exceed [m].

  // Share of cells whose difference allowed_uncertainty() allows, 0..1.
  double exclusive = 0, special = 0, order_1a = 0;
};

/// @param datum  Height from which depths count [m].
/// @return       Absent where no cell has both.
[[nodiscard]] std::optional<GridErrors> errors_of(const SoundingGrid& grid, double datum);

}  // namespace insonify
