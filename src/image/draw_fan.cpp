// draw_fan.cpp -- draws one ping as a fan seen from above, that of a multibeam seen from behind, with its soundings.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

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
  FanTable(const Ping& ping, const SonarConfig& sonar)
      : axis_(sonar),
        table_(clean_intensities(ping)),
        beams_(ping.beam_count),
        bins_(ping.bin_count),
        min_range_(sonar.min_range),
        bins_per_metre_(1 / sonar.bin_length()),
        slices_(sonar.bearings()),
        has_gaps_(slices_.has_gaps()) {
    const FanShape shape{slices_.starboard.back(), slices_.port.front()};
    middle_ = shape.middle();
    wraps_ = shape.full_circle();
  }

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
  double min_range_, bins_per_metre_, middle_ = 0;
  bool wraps_ = false;
  BearingGrid slices_;
  bool has_gaps_;
};

// A fan as it is drawn. That of a multibeam points down, with port to the left: it is mirrored, and turned by half a
// circle.
struct DrawnFan {
  explicit DrawnFan(const SonarConfig& sonar) : mirrored(sonar.is_multibeam()) {
    const BearingGrid beams = sonar.bearings();
    const double low = beams.starboard.back(), high = beams.port.front();
    shape = mirrored ? FanShape{-high, -low, sonar.min_range, sonar.max_range, std::numbers::pi}
                     : FanShape{low, high, sonar.min_range, sonar.max_range, 0};
  }

  // The sonar's bearing of an azimuth of the picture, and the other way round.
  [[nodiscard]] double turned(double azimuth) const { return mirrored ? -azimuth : azimuth; }

  bool mirrored;
  FanShape shape;
};

void mark_soundings(const Ping& ping, const DrawnFan& fan, const FanGeometry& geometry, double width,
                    Picture& picture) {
  for (const Sounding& sounding : ping.soundings) {
    if (sounding.found()) {
      const Point at =
          geometry.point_at(static_cast<double>(sounding.range), fan.turned(static_cast<double>(sounding.azimuth)));
      draw_line(picture, {at.x - width, at.y}, {at.x + width, at.y}, width,
                sounding.detection == Detection::kPhase ? palette::kByPhase : palette::kByAmplitude);
    }
  }
}

std::string what_of(const Ping& ping) {
  const auto count = [&](Detection detection) {
    return std::ranges::count(ping.soundings, detection, &Sounding::detection);
  };
  const std::string number = fmt::format("ping {}", ping.number);
  return ping.soundings.empty() ? number
                                : fmt::format("{}   {} soundings by amplitude (blue), {} by phase (green)", number,
                                              count(Detection::kAmplitude), count(Detection::kPhase));
}

}  // namespace

NumberPicture draw_fan_numbers(const std::vector<std::uint16_t>& numbers, const SonarConfig& sonar,
                               const Display& display) {
  display.validate();
  check_numbers(numbers, sonar);
  const DrawnFan fan(sonar);
  const BearingGrid beams = sonar.bearings();
  const BeamAxis axis(sonar);
  return fan_numbers(fan.shape, bare_fan(fan.shape, display, sonar.bin_length()), sonar, [&](int bin, double azimuth) {
    const double bearing = fan.turned(fan.shape.middle() + near_zero(azimuth - fan.shape.middle()));
    const int beam = beams.last_before(bearing, std::max(0, static_cast<int>(axis.beam_at(bearing))));
    return beams.has(beam, bearing) ? number_at(numbers, sonar, bin, beam) : kNoLabel;
  });
}

Picture draw_fan(const Ping& ping, const SonarConfig& sonar, const Display& display) {
  display.validate();
  check_ping(ping, sonar);
  const BearingGrid beams = sonar.bearings();
  const DrawnFan fan(sonar);
  const FanTable table(ping, sonar);
  const FanCells cells{sonar.bin_length(), beams.covered() / sonar.beam_count};
  FanMarks marks = marks_of(fan.shape, fan.shape.low, fan.shape.high, Mounting::kHorizontal);
  marks.mirrored = fan.mirrored;
  return fan_picture(
      display, heading_of(sonar, what_of(ping), ping.time), fan.shape, marks, cells,
      [&](double range, double azimuth) { return table(range, fan.turned(azimuth)); },
      [&](Picture& picture, const FanGeometry& geometry, const Page& page) {
        mark_soundings(ping, fan, geometry, 2 * page.hairline(), picture);
      });
}

}  // namespace insonify
