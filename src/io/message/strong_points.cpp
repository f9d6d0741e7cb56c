// strong_points.cpp -- selects cells above a level; ties are resolved in table order.

#include "io/message/strong_points.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace insonify {
namespace {

// The level reached by the strongest share of the cells, or by all cells with an echo if there are fewer.
float threshold_of(std::vector<float> raised, double share) {
  const auto wanted = static_cast<std::size_t>(std::ceil(share * static_cast<double>(raised.size())));
  std::erase_if(raised, [](float value) { return !(value > 0); });
  if (raised.empty()) {
    return 0;
  }
  const auto last = raised.begin() + static_cast<std::ptrdiff_t>(std::min(wanted, raised.size()) - 1);
  std::ranges::nth_element(raised, last, std::greater());
  return *last;
}

}  // namespace

std::vector<CloudPoint> strong_points(const Ping& ping, const std::vector<float>& raised, const SonarConfig& sonar,
                                      double share) {
  std::vector<CloudPoint> points;
  const float threshold = threshold_of(raised, share);
  for (int bin = 0; bin < ping.bin_count && threshold > 0; ++bin) {
    for (int beam = 0; beam < ping.beam_count; ++beam) {
      const std::size_t cell = ping.index(bin, beam);
      if (!(raised[cell] >= threshold)) {
        continue;
      }
      const bool known = !ping.elevation.empty() && std::isfinite(ping.elevation[cell]);
      const double elevation = known ? static_cast<double>(ping.elevation[cell]) : sonar.elevation_center;
      const Vec3 place =
          point_from_spherical({sonar.bin_range(bin), sonar.beam_azimuth(beam) + ping.head_angle, elevation});
      points.push_back({static_cast<float>(place.x()), static_cast<float>(place.y()), static_cast<float>(place.z()),
                        10 * std::log10(ping.intensity[cell])});
    }
  }
  return points;
}

}  // namespace insonify
