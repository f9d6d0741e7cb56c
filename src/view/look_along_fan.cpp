// look_along_fan.cpp -- images of distance and intensity, from one ray per direction of a fan.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "echo/engine.h"
#include "insonify/acoustics/absorption.h"
#include "insonify/error.h"
#include "insonify/scene_view.h"
#include "view/drawn_sonar.h"

namespace insonify {

Channels look_along_fan(Engine& engine, const SonarConfig& sonar, const Water& water, const Pose& world_from_sonar,
                        int columns, int rows) {
  check_field("channels", {"columns", "", from_to(1, 8192), ""}, columns);
  check_field("channels", {"rows", "", from_to(0, 8192), ""}, rows);
  if (sonar.is_side_scan()) {
    throw Error(fmt::format("{}: channels show what lies in a fan; this one's type is sss", sonar.name));
  }
  const InsonifiedSector sector(sonar, world_from_sonar);
  Channels channels;
  channels.columns = columns;
  channels.starboard_edge = sector.low_azimuth();
  channels.port_edge = sector.high_azimuth();
  channels.lower_edge = sector.low_elevation();
  channels.upper_edge = sector.high_elevation();
  const double shape = (channels.upper_edge - channels.lower_edge) / (channels.port_edge - channels.starboard_edge);
  channels.rows = rows > 0 ? rows : static_cast<int>(std::clamp(std::lround(columns * shape), 16L, 8192L));

  std::vector<Ray> rays;
  rays.reserve(static_cast<std::size_t>(columns) * channels.rows);
  for (int row = 0; row < channels.rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const Vec3 far = sector.point_at(1, 1 - (column + 0.5) / columns, 1 - (row + 0.5) / channels.rows);
      rays.push_back({.origin = world_from_sonar.position,
                      .direction = (far - world_from_sonar.position).normalized(),
                      .max_distance = sonar.max_range});
    }
  }
  std::vector<Hit> hits(rays.size());
  engine.trace(rays, hits);

  const double neper_per_metre = kNeperPerDecibel * water.absorption_db_per_m_at(sonar.frequency);
  constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Hit& hit = hits[i];
    const bool met = std::isfinite(hit.distance) && hit.distance >= sonar.min_range;
    const double strength = std::max(0.0, -hit.normal.dot(rays[i].direction)) * static_cast<double>(hit.reflectivity) *
                            std::exp(-2 * neper_per_metre * hit.distance);
    channels.distance.push_back(met ? static_cast<float>(hit.distance) : kNothing);
    channels.intensity.push_back(met ? static_cast<float>(strength) : kNothing);
  }
  return channels;
}

}  // namespace insonify
