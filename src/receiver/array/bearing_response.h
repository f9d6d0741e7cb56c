// bearing_response.h -- forms beams from bearing cells: sums the cells weighted by the array's beam pattern.

#pragma once

#include <algorithm>
#include <complex>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "echo/grid/echo_grid.h"
#include "insonify/array_pattern.h"
#include "insonify/sonar_config.h"
#include "receiver/array/defocused_tables.h"
#include "receiver/array/gain_matrix.h"
#include "sonar/fan_pattern.h"

namespace insonify {

/// Beam pattern of a line array of length D, sampled on a grid of bearing cells (Van Trees, Optimum Array Processing
/// (2002), ch. 2).
///
/// A beam steered to u0 = sin(azimuth) receives an echo from u with the amplitude gain g((D / wavelength) (u - u0)).
/// Without speckle, cell energies E are summed: beam = sum over cells of |g|^2 E. With speckle, complex cell fields f
/// are summed: beam = sum over cells of g f. The gain is 1 at u0 and the sum is not divided by the number of cells. A
/// discrete echo therefore keeps its level in the beam that points at it, and the level of an extended echo grows with
/// the beam width.
///
/// Cells must be no wider than wavelength / D, or the correlation of speckle between neighbouring beams is wrong; half
/// a beam spacing is fine enough. Where the edges of cells are given, those wider than kWideCell are received with the
/// mean of |g|^2 over the cell, since their middle may be at a zero of the pattern. An array out of focus has other
/// gains in other zones of bins. As matrices of all zones may need gigabytes, those beyond kMostKept numbers are looked
/// up in DefocusedTables whenever a ping is received. A bearing is given by its sine, so all bearings must be within 90
/// degrees of the axis.
class BearingResponse {
 public:
  static constexpr double kFloorDb = -60;
  static constexpr double kWideCell = 0.5;                        ///< [wavelength / D]; side lobes are one wide.
  static constexpr std::size_t kMostKept = std::size_t{1} << 25;  ///< 128 MB: all of an array of 256 beams.

  /// Range of bins, up to `end`, in which a defocused array has one pattern.
  struct Zone {
    int end;
    double edge_phase;  ///< Phase at the edges of the unsteered array [rad]: ArrayPattern::defocused().
  };

  /// Optional properties of the array.
  struct Extras {
    std::span<const double> cell_edges = {};  ///< u of the cells' edges, one more than cells; empty: every cell has the
                                              ///< gain of its centre.
    FanPattern element{std::nullopt};         ///< One element's gain, which multiplies that of the array.
    std::vector<Zone> zones = {};             ///< Empty: the array is focused at every range.
    int elements = 0;                         ///< Number of the array's elements; 0: a line. Only asked with `zones`.
    std::size_t most_kept = kMostKept;        ///< Most gains out of focus that are kept.
  };

  /// @param length      D / wavelength, > 0.
  /// @param cell_sines  u of each cell's centre, in the order of the cells.
  /// @param beam_sines  u0 of each beam, in the order of the beams.
  /// @param floor_db    Energy gain re the main lobe [dB]: the cells beyond the outermost one that reaches it are left
  ///                    out of a beam's sum.
  BearingResponse(const ArrayPattern& pattern, double length, std::span<const double> cell_sines,
                  std::span<const double> beam_sines, double floor_db, const Extras& extras);
  BearingResponse(const ArrayPattern& pattern, double length, std::span<const double> cell_sines,
                  std::span<const double> beam_sines, double floor_db = kFloorDb)
      : BearingResponse(pattern, length, cell_sines, beam_sines, floor_db, Extras()) {}

  [[nodiscard]] int beam_count() const { return static_cast<int>(beam_sines_.size()); }
  [[nodiscard]] int cell_count() const { return static_cast<int>(cell_sines_.size()); }

  /// Amplitude gain g for an echo from u in beam number `beam` and a bin.
  [[nodiscard]] std::complex<double> gain(int beam, double u, int bin = 0) const;

  /// The same of sound that another source sent: received by the array, whether or not the array sends too.
  [[nodiscard]] std::complex<double> one_way_gain(int beam, double u, int bin) const {
    return pattern_.is_two_way() ? std::sqrt(gain(beam, u, bin)) : gain(beam, u, bin);
  }

  /// Fraction of the beam x cell products that the sums include in focus, 0..1. The computing time is proportional to
  /// it.
  [[nodiscard]] double filled() const { return in_focus_.energy.filled(); }

  /// Tables of the array out of focus; null where it is focused at every range.
  [[nodiscard]] const DefocusedTables* defocused() const { return tables_ ? &*tables_ : nullptr; }

  /// Number of gains out of focus that are kept, and whether all are: then pings look up none.
  [[nodiscard]] std::size_t kept() const { return kept_; }
  [[nodiscard]] bool keeps_all() const {
    return std::ranges::all_of(focuses_, [](const Focus& focus) { return focus.tables.empty() || focus.kept; });
  }

  /// The gains of all bins, where keeps_all(); they refer to this object.
  [[nodiscard]] std::vector<GainZone> zones() const;

  /// Beam energies: the matrix product beams = |g|^2 cells, for the bins of one task. Allocates nothing.
  /// @param cells      Cell energies, [cell][bin].
  /// @param beams      Beam energies, [beam][bin]; written in `bins`.
  /// @param bin_count  Bins per row of `cells` and of `beams`.
  /// @param bins       Bins to compute. Threads divide a ping by bins; the result does not depend on the division.
  /// @param filled     Bins outside which all cells are zero, so that the beams are too.
  void receive_energy(std::span<const float> cells, std::span<float> beams, int bin_count, BinRange bins,
                      BinRange filled) const;

  /// Beam fields: the product beams = g cells of complex fields, with the same shapes. Takes twice the operations of
  /// receive_energy(); four times where g is complex, as it is with faulty array elements.
  void receive_field(std::span<const std::complex<float>> cells, std::span<std::complex<float>> beams, int bin_count,
                     BinRange bins, BinRange filled) const;

 private:
  struct Gains {
    GainMatrix energy = {};                     // |g|^2.
    GainMatrix in_phase = {}, quadrature = {};  // Real and imaginary part of g; quadrature is empty where g is real.
  };
  // Bins before `end`.
  struct Focus {
    int end = std::numeric_limits<int>::max();
    std::vector<int> tables = {};  // [beam] Number in tables_; empty in focus.
    std::optional<Gains> kept = {};
  };
  // Gains of some beams out of focus, and [cell] those of one.
  struct Scratch {
    Gains gains;
    std::vector<float> in_phase, quadrature;
  };
  [[nodiscard]] const Focus& focus_at(int bin) const;
  [[nodiscard]] std::complex<double> focused_gain(int beam, double u) const;
  template <typename Gain>
  [[nodiscard]] double mean_intensity(int cell, const Gain& gain) const;
  void fill_in_focus(double floor);
  void defocus(const Extras& extras, double floor);
  void keep_gains(std::size_t most);
  void set_block(const Focus& focus, int block, int first_beam, bool energy, Scratch& scratch) const;
  template <typename Receive>
  void for_each_part(BinRange bins, bool energy, const Receive& receive) const;

  ArrayPattern pattern_;
  double length_;
  FanPattern element_;
  std::vector<double> beam_sines_;
  std::vector<double> cell_sines_;
  std::vector<double> cell_edges_;    // Empty, or one more than cells.
  std::vector<float> places_;         // [cell] D / wavelength times the sine.
  std::vector<float> element_gains_;  // [cell] Amplitude gain of one element.
  std::vector<int> wide_;             // Cells that are received with their mean.
  double widest_ = 0;                 // Half width of the widest of them [wavelength / D].
  Gains in_focus_;
  std::vector<Focus> focuses_;  // By range; one if the array is focused everywhere.
  std::optional<DefocusedTables> tables_;
  std::size_t kept_ = 0;
};

/// Zones of bins in which an array's edge phase is almost the same. Empty where the sonar has no focus_range.
/// @param length      D / wavelength.
/// @param wavelength  [m].
/// @param range_scale True range / shown range.
[[nodiscard]] std::vector<BearingResponse::Zone> focus_zones(const SonarConfig& sonar, double length, double wavelength,
                                                             double range_scale);

}  // namespace insonify
