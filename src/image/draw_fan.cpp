// draw_fan.cpp -- draws one ping as a fan seen from above.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "image/fan_geometry.h"
#include "image/fan_paint.h"
#include "image/number_paint.h"
#include "receiver/ping_table.h"

namespace insonify {
namespace {

// Intensity of a ping by range and azimuth: bilinear interpolation between beam and bin centres, but not over a gap
// between beams, where it is NaN.
class FanTable {
 public:
  FanTable(const Ping& ping, const SonarConfig& sonar, const FanShape& shape)
      : axis_(sonar),
        table_(clean_intensities(ping)),
        beams_(ping.beam_count),
        bins_(ping.bin_count),
        min_range_(sonar.min_range),
        bins_per_metre_(1 / sonar.bin_length()),
        middle_(shape.middle()),
        wraps_(shape.full_circle()),
        slices_(sonar.bearings()),
        has_gaps_(slices_.has_gaps()) {}

  double operator()(double range, double azimuth) const {
    const double bearing = middle_ + near_zero(azimuth - middle_);
    const double beam = axis_.beam_at(bearing);
    const double bin = std::clamp((range - min_range_) * bins_per_metre_ - 0.5, 0.0, bins_ - 1.0);
    const int bin0 = static_cast<int>(bin);
    const int bin1 = std::min(bin0 + 1, bins_ - 1);
    const int beam0 = static_cast<int>(beam + 1) - 1;  // Rounds down from -0.5 on.
    double across = beam - beam0;
    if (has_gaps_) {
      const int own = slices_.last_before(bearing, std::max(beam0, 0));
      if (!slices_.has(own, bearing)) {
        return std::numeric_limits<double>::quiet_NaN();
      }
      across = slices_.gap_after(beam0) ? std::round(across) : across;
    }
    const double along = bin - bin0;
    const int left = column(beam0);
    const int right = column(beam0 + 1);
    const double near = (1 - across) * at(bin0, left) + across * at(bin0, right);
    const double far = (1 - across) * at(bin1, left) + across * at(bin1, right);
    return (1 - along) * near + along * far;
  }

 private:
  // Beam index clamped to the fan; on a full circle it wraps around.
  [[nodiscard]] int column(int beam) const {
    return wraps_ ? (beam + beams_) % beams_ : std::clamp(beam, 0, beams_ - 1);
  }
  [[nodiscard]] double at(int bin, int beam) const {
    return static_cast<double>(
        table_[static_cast<std::size_t>(bin) * static_cast<std::size_t>(beams_) + static_cast<std::size_t>(beam)]);
  }

  BeamAxis axis_;
  std::vector<float> table_;
  int beams_, bins_;
  double min_range_, bins_per_metre_, middle_;
  bool wraps_;
  BearingGrid slices_;
  bool has_gaps_;
};

FanShape fan_shape(const SonarConfig& sonar) {
  const BearingGrid beams = sonar.bearings();
  return {beams.starboard.back(), beams.port.front(), sonar.min_range, sonar.max_range, 0};
}

}  // namespace

NumberPicture draw_fan_numbers(const std::vector<std::uint16_t>& numbers, const SonarConfig& sonar,
                               const Display& display) {
  display.validate();
  check_numbers(numbers, sonar);
  const FanShape shape = fan_shape(sonar);
  const BearingGrid beams = sonar.bearings();
  const BeamAxis axis(sonar);
  return fan_numbers(shape, bare_fan(shape, display, sonar.bin_length()), sonar, [&](int bin, double azimuth) {
    const double bearing = shape.middle() + near_zero(azimuth - shape.middle());
    const int beam = beams.last_before(bearing, std::max(0, static_cast<int>(axis.beam_at(bearing))));
    return beams.has(beam, bearing) ? number_at(numbers, sonar, bin, beam) : kNoLabel;
  });
}

Picture draw_fan(const Ping& ping, const SonarConfig& sonar, const Display& display) {
  display.validate();
  check_ping(ping, sonar);
  const BearingGrid beams = sonar.bearings();
  const FanShape shape = fan_shape(sonar);
  const FanTable table(ping, sonar, shape);
  const FanCells cells{sonar.bin_length(), beams.covered() / sonar.beam_count};
  return fan_picture(display, heading_of(sonar, fmt::format("ping {}", ping.number), ping.time), shape,
                     marks_of(shape, shape.low, shape.high, Mounting::kHorizontal), cells, table,
                     [](Picture&, const FanGeometry&, const Page&) {});
}

}  // namespace insonify
