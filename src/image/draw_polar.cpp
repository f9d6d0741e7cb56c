// draw_polar.cpp -- draws one ping as a table: beams across, bins upwards.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "image/colours.h"
#include "image/fan_geometry.h"
#include "image/number_paint.h"
#include "image/plot.h"
#include "image/scales.h"
#include "receiver/ping_table.h"

namespace insonify {
namespace {

std::vector<AxisTick> azimuth_ticks(const SonarConfig& sonar) {
  const BeamAxis axis(sonar);
  const double aperture = axis.port_edge() - axis.starboard_edge();
  std::vector<AxisTick> ticks;
  for (const double azimuth : multiples_within(axis.starboard_edge(), axis.port_edge(), radial_step(aperture))) {
    ticks.push_back({(axis.beam_at(azimuth) + 0.5) / sonar.beam_count, bearing_text(azimuth), azimuth == 0});
  }
  std::reverse(ticks.begin(), ticks.end());  // From port, which is left.
  return ticks;
}

// Mean over the beams from..to in every bin; the first and last beam are weighted by the fraction that is included.
void average_beams(const std::vector<float>& table, int beam_count, double from, double to,
                   std::vector<float>& profile) {
  std::fill(profile.begin(), profile.end(), 0.0F);
  const int last = std::min(beam_count, static_cast<int>(std::ceil(to)));
  for (int beam = static_cast<int>(from); beam < last; ++beam) {
    const auto share = static_cast<float>((std::min(to, beam + 1.0) - std::max(from, beam * 1.0)) / (to - from));
    for (std::size_t bin = 0; bin < profile.size(); ++bin) {
      profile[bin] += share * table[bin * static_cast<std::size_t>(beam_count) + static_cast<std::size_t>(beam)];
    }
  }
}

}  // namespace

NumberPicture draw_polar_numbers(const std::vector<std::uint16_t>& numbers, const SonarConfig& sonar,
                                 const Display& display) {
  display.validate();
  check_numbers(numbers, sonar);
  const PlotLayout plot = bare_plot(display, sonar.beam_count, sonar.bin_count);
  return plot_numbers(plot, sonar.bin_count, [&](int bin, double across) {
    return number_at(numbers, sonar, bin, static_cast<int>(across * sonar.beam_count));
  });
}

Picture draw_polar(const Ping& ping, const SonarConfig& sonar, const Display& display) {
  display.validate();
  check_ping(ping, sonar);
  const PlotAxes axes{azimuth_ticks(sonar), range_ticks(sonar), "azimuth", "range (m)"};
  const std::vector<float> table = clean_intensities(ping);
  std::vector<float> profile(static_cast<std::size_t>(ping.bin_count));
  return plot_picture(display, heading_of(sonar, fmt::format("ping {}", ping.number), ping.time), axes, ping.beam_count,
                      ping.bin_count, [&](int x, int width) {
                        const double step = static_cast<double>(ping.beam_count) / width;
                        average_beams(table, ping.beam_count, x * step, (x + 1) * step, profile);
                        return std::span<const float>(profile);
                      });
}

}  // namespace insonify
