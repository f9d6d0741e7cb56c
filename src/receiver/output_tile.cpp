// output_tile.cpp -- collects labels into tiles and writes tiles, transposed, into the tables of a ping.

#include "receiver/output_tile.h"

#include <cmath>
#include <limits>

#include "base/vector_math.h"
#include "echo/grid/echo.h"

namespace insonify {
namespace {

// mean = moment / energy: the mean elevation of each bin's label [rad]; NaN in bins without a label.
INSONIFY_VECTOR_CLONES
void divide_or_nan(int count, const SurfaceLabel* __restrict__ surface, const float* __restrict__ moment,
                   const float* __restrict__ energy, float* __restrict__ mean) {
  for (int i = 0; i < count; ++i) {
    mean[i] =
        (surface[i] != kNoSurface) & (energy[i] > 0) ? moment[i] / energy[i] : std::numeric_limits<float>::quiet_NaN();
  }
}

// Merges the labels of one row of cells into `best`: each bin takes the row's label where it has more energy than the
// best so far, or where there is none yet.
INSONIFY_VECTOR_CLONES
void take_stronger(int count, const SurfaceLabel* __restrict__ surface, const float* __restrict__ energy,
                   const float* __restrict__ moment, SurfaceLabel* __restrict__ best_surface,
                   float* __restrict__ best_energy, float* __restrict__ best_moment) {
  for (int i = 0; i < count; ++i) {
    const bool first = best_surface[i] == kNoSurface;
    const bool stronger = (surface[i] != kNoSurface) & (first | (energy[i] > best_energy[i]));
    best_surface[i] = stronger ? surface[i] : best_surface[i];
    best_energy[i] = stronger ? energy[i] : best_energy[i];
    best_moment[i] = stronger ? moment[i] : best_moment[i];
  }
}

// Copies `count` values. Nearly all tiles are kTileBeams wide; for these the compiler knows the length.
template <typename Value>
[[gnu::always_inline]] inline void copy_beams(const Value* from, int count, Value* to) {
  if (count == kTileBeams) {
    std::copy_n(from, kTileBeams, to);
  } else {
    std::copy_n(from, count, to);
  }
}

}  // namespace

void size_tables(Ping& ping, int beams, int bins, GroundTruth ground_truth) {
  ping.beam_count = beams;
  ping.bin_count = bins;
  const std::size_t cells = static_cast<std::size_t>(beams) * bins;
  const std::size_t labelled = ground_truth == GroundTruth::kNone ? 0 : cells;
  const std::size_t full = ground_truth == GroundTruth::kFull ? cells : 0;
  ping.intensity.resize(cells);
  ping.instance.resize(labelled);
  ping.material.resize(labelled);
  ping.elevation.resize(labelled);
  ping.strongest_instance.resize(kStrongestCount * full);
  ping.strongest_share.resize(kStrongestCount * full);
  ping.elevation_spread.resize(full);
  ping.path_order.resize(full);
  ping.shadow.resize(full);
  ping.direct_intensity.resize(full);
  ping.phase.clear();
  ping.soundings.clear();
}

void copy_labels(const FormedBeams& formed, std::size_t start, const TilePlace& place, int beam_of_tile,
                 OutputTile& tile) {
  tile.has_labels = true;
  std::copy_n(&formed.surface[start], place.bin_count, tile.surface[beam_of_tile]);
  std::copy_n(&formed.elevation[start], place.bin_count, tile.elevation[beam_of_tile]);
}

void take_labels(const EchoGrid& grid, int first_row, int rows, const TilePlace& place, int beam_of_tile,
                 OutputTile& tile) {
  SurfaceLabel* surface = tile.surface[beam_of_tile];
  float energy[kTileBins] = {}, moment[kTileBins] = {};
  std::fill_n(surface, kTileBins, kNoSurface);
  for (int row = first_row; row < first_row + rows; ++row) {
    const BinRange bins = grid.filled(row) & place.bins();
    if (!bins.empty()) {
      tile.has_labels = true;
      const EchoGrid::LabelRows labels = grid.label_rows(row);
      const int at = bins.first - place.first_bin;
      take_stronger(bins.last - bins.first, labels.surface + bins.first, labels.energy + bins.first,
                    labels.elevation_moment + bins.first, surface + at, energy + at, moment + at);
    }
  }
  divide_or_nan(kTileBins, surface, moment, energy, tile.elevation[beam_of_tile]);
}

INSONIFY_VECTOR_CLONES
void write_tile(const OutputTile& tile, const TilePlace& place, bool labelled, Ping& ping) {
  BinTile<float> intensity, elevation;
  BinTile<std::uint32_t> surface;
  transpose_tile(tile.intensity, intensity);
  if (labelled && tile.has_labels) {
    transpose_tile(tile.elevation, elevation);
    transpose_tile(tile.surface, surface);
  }
  for (int i = 0; i < place.bin_count; ++i) {
    const std::size_t row = ping.index(place.first_bin + i, place.first_beam);
    copy_beams(intensity[i], place.beam_count, &ping.intensity[row]);
    if (!labelled) {
      continue;
    }
    if (!tile.has_labels) {
      std::fill_n(&ping.instance[row], place.beam_count, kNoLabel);
      std::fill_n(&ping.material[row], place.beam_count, kNoLabel);
      std::fill_n(&ping.elevation[row], place.beam_count, std::numeric_limits<float>::quiet_NaN());
      continue;
    }
    std::uint16_t instance[kTileBeams], material[kTileBeams];
    for (int b = 0; b < kTileBeams; ++b) {
      instance[b] = instance_of(surface[i][b]);
      material[b] = material_of(surface[i][b]);
    }
    copy_beams(instance, place.beam_count, &ping.instance[row]);
    copy_beams(material, place.beam_count, &ping.material[row]);
    copy_beams(elevation[i], place.beam_count, &ping.elevation[row]);
  }
}

float near_field(const SonarConfig& sonar, int bin) {
  if (sonar.blanking_range <= sonar.min_range) {
    return 1;
  }
  const double along = (sonar.bin_range(bin) - sonar.min_range) / (sonar.blanking_range - sonar.min_range);
  return static_cast<float>(std::clamp(along, 0.0, 1.0));
}

}  // namespace insonify
