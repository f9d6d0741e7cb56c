// slant_range.h -- from ranges along the sound's path to ranges on a level bed, and gain against its angle.

#pragma once

#include <array>
#include <span>
#include <vector>

#include "insonify/ping.h"
#include "insonify/sonar_config.h"

namespace insonify {

/// Range on a level bed of what is at a slant range: sqrt(r^2 - h^2), 0 above the bed [m].
/// @param altitude  h, height of the sonar above the bed [m], > 0; along the plane of the beams.
/// @throws Error for an altitude that is not.
[[nodiscard]] double ground_range(double slant_range, double altitude);

/// Cells of equal length on the bed to one side, the first from below the sonar on.
struct GroundGrid {
  double cell = 0.1;  ///< Length of a cell [m], > 0.
  int count = 1;      ///< >= 1.

  [[nodiscard]] double range(int index) const { return (index + 0.5) * cell; }  ///< Middle of a cell [m].
};

/// Cells as long as the sonar's bins, out to its max_range.
[[nodiscard]] GroundGrid ground_grid_of(const SonarConfig& sonar);

/// A ping on the ground: the mean intensity of each cell, over the parts of the bins' footprints that lie in it. The
/// integral over the bed is that of the bins. NaN in cells that no bin covers. Bins of the water column are left out.
/// @param altitude  Vertical height above the bed [m], > 0; the pitch of the ping's pose inclines the beams' plane.
/// @return  cell-major, [cell * beam_count + beam].
/// @throws Error for an altitude that is not positive, a ping of another shape, a pose that is not finite.
[[nodiscard]] std::vector<float> slant_to_ground(const Ping& ping, const SonarConfig& sonar, double altitude,
                                                 const GroundGrid& grid);

/// Removes the dependence of levels on the angle to the bed: the mean intensity at each angle below the horizontal, of
/// each side, over a line. It takes beam pattern and backscatter by angle out together, and with a steady altitude what
/// is left of the loss with range. Means over angles of the bed itself: a line over objects alone would lose them.
class AngleGain {
 public:
  explicit AngleGain(int beam_count) : sides_(static_cast<std::size_t>(beam_count)) {}

  /// Adds a ping of a line.
  /// @throws Error as slant_to_ground().
  void add(const Ping& ping, const SonarConfig& sonar, double altitude);

  /// The ping with each intensity divided by the mean at its angle, interpolated, times the mean of all angles of both
  /// sides, which so become equally bright. Bins of the water column are treated as straight below.
  [[nodiscard]] Ping applied(Ping ping, const SonarConfig& sonar, double altitude) const;

 private:
  struct Class {
    double sum = 0;      // Intensities of its bins.
    double degrees = 0;  // Their angles below the horizontal [deg].
    double count = 0;    // Number of bins.
  };
  using Side = std::array<Class, 90>;  // By degrees below the horizontal.
  struct Mean {
    double degrees = 0, level = 0;
  };
  static std::vector<Mean> means_of(const Side& side);
  [[nodiscard]] double mean_of_all() const;

  std::vector<Side> sides_;
};

}  // namespace insonify
