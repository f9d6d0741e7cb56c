// speckle.h -- fully developed speckle: random amplitude and phase of each cell, fixed in the world.

#pragma once

#include <complex>
#include <cstdint>
#include <span>
#include <vector>

#include "echo/grid/echo_grid.h"
#include "insonify/geometry.h"
#include "insonify/sonar_config.h"

namespace insonify {

/// Turns cell energies into a circular complex Gaussian field with those mean intensities (Goodman, Speckle Phenomena
/// in Optics (2007), ch. 3): each cell echoes as one effective scatterer, with a random amplitude and phase and the
/// phase of its path out and back.
///
/// The random numbers are a hash of the scatterer's place in the world, so that a static scene gives the same speckle
/// in every ping. Its place is a bearing index, counted from a fixed direction of the world, and a range index, counted
/// from an anchor: the nearest point of a cubic lattice fixed in the world. Hence
///
/// - when the sonar turns or moves along a bearing, a cell takes over the random numbers of its neighbour;
/// - when it moves sideways, the phases change with the path lengths: an array of length D sees speckle that
///   decorrelates over a shift of D / 2 (docs/concepts/speckle.md);
/// - when it passes the middle between two anchors, all numbers are drawn anew;
/// - pings at another carrier frequency see the same scatterers with other phases, see carrier_band().
class Speckle {
 public:
  /// Distance between anchors [m].
  static constexpr double kAnchorSpacing = 1;

  /// @param cells        The grids' cells, see BearingCells::sonar.
  /// @param range_scale  True range / reported range.
  /// @param wavelength   [m]
  /// @param band         See carrier_band(), > 0.
  Speckle(const SonarConfig& cells, double range_scale, double wavelength, double band, std::uint64_t seed);

  /// The anchor nearest to a transducer, relative to it.
  struct View {
    Vec3f offset;              ///< From the anchor to the transducer, in the sonar frame [m].
    float bearing_offset = 0;  ///< Added to a bearing in the sonar frame, gives the bearing in the world [rad].
    std::uint32_t key{};       ///< Key of the anchor's random numbers.
  };
  [[nodiscard]] View seen_from(const Pose& world_from_sonar) const;

  /// Scatterers of one cell's row of bins. The vectors are [bin], set in `bins` only.
  struct Row {
    BinRange bins;
    std::vector<std::uint32_t> surface;  ///< Label: instance and material, see echo/grid/echo.h.
    std::uint32_t bearing = 0;           ///< Bearing index, the same for the whole row.
    std::vector<std::uint32_t> range;    ///< Range index.
    std::vector<float> turns;            ///< Phase of the path out and back, to the middle of the cell [turns of 2 pi].
  };
  /// Change of that phase over the length of a cell [turns].
  [[nodiscard]] double turns_per_bin() const { return turns_per_bin_; }

  /// Finds the scatterers of the given bins of a cell.
  void locate(const View& view, int cell, BinRange bins, const EchoGrid& grid, Row& row) const;

  /// field[bin] = sqrt(energy[bin]) x the scatterer's random complex number x its phase, in row.bins.
  void draw(const View& view, const Row& row, std::span<const float> energy,
            std::span<std::complex<float>> field) const;

 private:
  int bins_;
  float first_range_, bin_length_;  // True range of bin 0's middle, and true bin length [m].
  float cell_width_;                // Width of the narrowest cell [rad].
  float turns_per_metre_;           // Phase per metre of range, out and back [turns/m].
  double turns_per_bin_;
  float carrier_;               // Carrier frequency in bands, see carrier_band().
  std::vector<float> azimuth_;  // [cell]: azimuth of the centre [rad].
  std::uint64_t seed_;
};

}  // namespace insonify
