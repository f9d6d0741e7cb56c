// slant_range.h -- from ranges along the sound's path to ranges on a level bed, and gain against its angle.

#pragma once

#include <array>
#include <map>
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

/// Removes the dependence of levels on the angle to the bed: the usual intensity at each angle below the horizontal, of
/// each side, over a line. It takes beam pattern and backscatter by angle out together, and with a steady altitude what
/// is left of the loss with range. Usual is the mean of the middle half of the intensities at an angle, so that objects
/// and shadows in less than a quarter of the line do not count: they would leave a stripe at their angle.
class AngleGain {
 public:
  explicit AngleGain(int beam_count) : sides_(static_cast<std::size_t>(beam_count)) {}

  /// Adds a ping of a line.
  /// @throws Error as slant_to_ground().
  void add(const Ping& ping, const SonarConfig& sonar, double altitude);

  /// The ping with each intensity divided by the usual one at its angle, interpolated, times the mean of those of all
  /// angles of both sides, which so become equally bright. Bins of the water column are treated as straight below.
  [[nodiscard]] Ping applied(Ping ping, const SonarConfig& sonar, double altitude) const;

 private:
  struct Step {
    double sum = 0, count = 0;  // Intensities, and their number.
  };
  struct Class {
    std::map<int, Step> steps;  // By level, in steps of 0.1 dB.
    Step all;
    double degrees = 0;  // Sum of the angles of its bins below the horizontal [deg].
  };
  using Side = std::array<Class, 90>;  // By degrees below the horizontal.
  struct Mean {
    double degrees = 0, level = 0;
  };
  static double usual_of(const Class& bins);
  [[nodiscard]] const std::vector<std::vector<Mean>>& means() const;
  [[nodiscard]] double mean_of_all() const;

  std::vector<Side> sides_;
  mutable std::vector<std::vector<Mean>> means_;  // [side] Made when first asked for after an add().
};

}  // namespace insonify
