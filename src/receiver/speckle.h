// speckle.h -- with which phase and amplitude each cell echoes: numbers fixed in the world.

#pragma once

#include <complex>
#include <cstdint>
#include <span>
#include <vector>

#include "echo/grid/echo_grid.h"
#include "insonify/geometry.h"
#include "insonify/sonar_config.h"

namespace insonify {

/// Turns the energies of a grid into a complex Gaussian field of that mean square: each cell echoes like one scatterer
/// that stands for all of its own, with a random amplitude and phase, and the phase of the way there and back.
///
/// Scatterers are told by their bearing, counted from a direction of the world, and by their range from an anchor in
/// the world, the nearest of a cubic lattice. When the sonar turns or comes nearer, cells take over their neighbours'
/// scatterers; when it moves sideways their phases change as bearings do, and what an array of length D hears of them
/// is alike up to a shift of D / 2: by then it has forgotten them, so that they need not change bearings besides. Past
/// the middle between two anchors all are drawn anew.
class Speckle {
 public:
  /// Distance between anchors [m].
  static constexpr double kAnchorSpacing = 1;

  /// @param cells        What grids are of.
  /// @param true_ranges  True over reported range.
  /// @param wavelength   [m]
  Speckle(const SonarConfig& cells, double true_ranges, double wavelength, std::uint64_t seed);

  /// The anchor, as seen from a transducer.
  struct View {
    Vec3f offset;         ///< From the anchor to the transducer, along the axes of the sonar [m].
    float turned = 0;     ///< What makes a bearing one of the world's [rad].
    std::uint32_t key{};  ///< Of the anchor's random numbers.
  };
  [[nodiscard]] View seen_from(const Pose& world_from_sonar) const;

  /// The scatterers of one row of cells.
  struct Row {
    BinRange bins;                       ///< Whose scatterers they are.
    std::vector<std::uint32_t> surface;  ///< Of each bin: instance and material, see echo/grid/echo.h.
    std::uint32_t bearing = 0;           ///< Index that tells the scatterers from those of other rows.
    std::vector<std::uint32_t> range;    ///< Of each, within the row.
    std::vector<float> turns;            ///< Phase of the way there and back, but for what does not change.
  };
  /// Of the given bins alone.
  void locate(const View& view, int cell, BinRange bins, const EchoGrid& grid, Row& row) const;

  /// field = sqrt(energy) x the scatterers' random numbers, in the bins that were located.
  void draw(const View& view, const Row& row, std::span<const float> energy,
            std::span<std::complex<float>> field) const;

 private:
  int bins_;
  float first_range_, bin_length_;  // True, of the middle of bin 0; [m].
  float cell_width_;                // Of the narrowest [rad].
  float turns_per_metre_;           // There and back.
  std::vector<float> azimuth_;      // Of the cells.
  std::uint64_t seed_;
};

}  // namespace insonify
