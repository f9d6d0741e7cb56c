// scan_view.cpp -- draws the pings of a scanning sonar around its head, and side by side; chooses the picture of a
// sonar.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "image/fan_paint.h"
#include "image/number_paint.h"
#include "image/plot.h"
#include "image/scales.h"
#include "image/scan_slots.h"
#include "insonify/error.h"
#include "insonify/printable.h"
#include "insonify/waterfall.h"
#include "receiver/ping_table.h"

namespace insonify {
namespace {

// A ping fills its whole step if that is at most this many beam widths, as displays of scanning sonars do in their
// coarse modes. With longer steps most of the circle is not scanned, and each ping is drawn as wide as its beam.
constexpr double kWidestFill = 3;

// Angle that a ping is drawn over [rad].
double ping_width(const SonarConfig& sonar) {
  const double step = std::abs(sonar.head.step);
  return step <= kWidestFill * sonar.azimuth_aperture ? step : sonar.azimuth_aperture;
}

// The scanned sector, extended by half the width of the outermost pings.
FanShape shape_of(const SonarConfig& sonar) {
  const double width = std::min(kTwoPi, sonar.head.sector_width + ping_width(sonar));
  const bool whole = sonar.head.sector_width > kTwoPi - 1e-6;
  // With a vertical mounting the head's port side points up: up is drawn upwards, and the housing's front to the right.
  const double up = sonar.head.mounting == Mounting::kVertical ? std::numbers::pi / 2 : 0;
  const double half = whole ? std::numbers::pi : width / 2;
  return {sonar.head.sector_center - half, sonar.head.sector_center + half, sonar.min_range, sonar.max_range, up};
}

FanMarks scan_marks(const SonarConfig& sonar, const FanShape& shape) {
  const double half = shape.full_circle() ? std::numbers::pi : sonar.head.sector_width / 2;
  return marks_of(shape, sonar.head.sector_center - half, sonar.head.sector_center + half, sonar.head.mounting);
}

// Step between head-angle labels. Labels of slopes are long: beyond half a circle there is room for few.
double head_angle_step(const SonarConfig& sonar, const FanShape& shape) {
  const double step = radial_step(shape.aperture(), sonar.head.mounting);
  return sonar.head.mounting == Mounting::kVertical && shape.aperture() > std::numbers::pi ? std::numbers::pi / 4
                                                                                           : step;
}

int steps_across(const SonarConfig& sonar, const FanShape& shape) {
  return std::max(1, static_cast<int>(std::lround(shape.aperture() / std::abs(sonar.head.step))));
}

std::string count_text(std::size_t pings) {
  return fmt::format("{} {}", pings, pings == 1 ? "ping" : "pings");
}

}  // namespace

ScanView::ScanView(const SonarConfig& sonar) : sonar_(sonar) {
  if (sonar.beam_count != 1 || sonar.head.step == 0) {
    throw Error(fmt::format("{} turns {} by {} deg: a scan view must have one beam that turns", sonar.name,
                            counted(sonar.beam_count, "beam"), degrees_from_radians(sonar.head.step)));
  }
}

void ScanView::add(const Ping& ping) {
  check_ping(ping, sonar_);
  if (!std::isfinite(ping.head_angle)) {
    throw Error(fmt::format("ping {} of {} has head_angle = {} rad, must be a finite number", ping.number, sonar_.name,
                            ping.head_angle));
  }
  head_angles_.push_back(ping.head_angle);
  profiles_.push_back(clean_intensities(ping));
  last_time_ = ping.time;
}

double ScanView::fitting_full_scale() const {
  std::vector<float> intensities;
  Ping ping;
  ping.beam_count = 1;
  ping.bin_count = sonar_.bin_count;
  for (const std::vector<float>& profile : profiles_) {
    ping.intensity = profile;
    const std::vector<float> more = intensities_to_fit(ping, sonar_);
    intensities.insert(intensities.end(), more.begin(), more.end());
  }
  return insonify::fitting_full_scale(std::move(intensities));
}

Picture ScanView::draw(const Display& display) const {
  display.validate();
  const FanShape shape = shape_of(sonar_);
  const ScanSlots slots(head_angles_, sonar_.head.step, ping_width(sonar_));
  // Linear interpolation along range, and across to the ping before or after.
  const auto intensity = [&](int ping, double bin) {
    const std::vector<float>& profile = profiles_[ping];
    const auto bin0 = static_cast<std::size_t>(bin);
    const double far = static_cast<double>(profile[std::min(bin0 + 1, profile.size() - 1)]);
    const double near = static_cast<double>(profile[bin0]);
    return near + (bin - static_cast<double>(bin0)) * (far - near);
  };
  const auto sample = [&](double range, double azimuth) {
    const ScanSlots::Mix mix = slots.at(azimuth);
    if (mix.ping < 0) {
      return std::numeric_limits<double>::quiet_NaN();
    }
    const double bin = std::clamp((range - sonar_.min_range) / sonar_.bin_length() - 0.5, 0.0, sonar_.bin_count - 1.0);
    return (1 - mix.share) * intensity(mix.ping, bin) + mix.share * intensity(mix.neighbour, bin);
  };
  const FanCells cells{sonar_.bin_length(), ping_width(sonar_)};
  const auto draw_head = [&](Picture& picture, const FanGeometry& geometry, const Page& page) {
    if (!head_angles_.empty() && shape.inside_by(head_angles_.back()) > 0) {
      const Point near = geometry.point_at(sonar_.min_range, head_angles_.back());
      const Point far = geometry.point_at(sonar_.max_range, head_angles_.back());
      draw_line(picture, near, far, 3.5 * page.hairline(), palette::kGridRim);
      draw_line(picture, near, far, 1.5 * page.hairline(), palette::kHead);
    }
  };
  return fan_picture(display, heading_of(sonar_, count_text(head_angles_.size()), last_time_), shape,
                     scan_marks(sonar_, shape), cells, sample, draw_head);
}

Picture ScanView::draw_polar(const Display& display) const {
  display.validate();
  const FanShape shape = shape_of(sonar_);
  PlotAxes axes{{}, range_ticks(sonar_), "head angle", "range (m)"};
  const std::vector<double> azimuths = multiples_within(shape.low, shape.high, head_angle_step(sonar_, shape));
  for (auto azimuth = azimuths.rbegin(); azimuth != azimuths.rend(); ++azimuth) {  // From port, which is left.
    axes.across.push_back(
        {(shape.high - *azimuth) / shape.aperture(), bearing_text(*azimuth, sonar_.head.mounting), *azimuth == 0});
  }
  const ScanSlots slots(head_angles_, sonar_.head.step, ping_width(sonar_));
  return plot_picture(display, heading_of(sonar_, count_text(head_angles_.size()), last_time_), axes,
                      steps_across(sonar_, shape), sonar_.bin_count, [&](int x, int width) {
                        const int ping = slots.at(shape.high - (x + 0.5) / width * shape.aperture()).ping;
                        return ping < 0 ? std::span<const float>() : profiles_[ping];
                      });
}

NumberPicture ScanView::draw_numbers(const std::vector<std::vector<std::uint16_t>>& numbers,
                                     const Display& display) const {
  display.validate();
  const FanShape shape = shape_of(sonar_);
  const ScanSlots slots(head_angles_, sonar_.head.step, ping_width(sonar_));
  return fan_numbers(shape, bare_fan(shape, display, sonar_.bin_length()), sonar_, [&](int bin, double azimuth) {
    const int ping = slots.at(azimuth).ping;
    return ping < 0 ? kNoLabel : numbers.at(static_cast<std::size_t>(ping)).at(static_cast<std::size_t>(bin));
  });
}

NumberPicture ScanView::draw_polar_numbers(const std::vector<std::vector<std::uint16_t>>& numbers,
                                           const Display& display) const {
  display.validate();
  const FanShape shape = shape_of(sonar_);
  const ScanSlots slots(head_angles_, sonar_.head.step, ping_width(sonar_));
  const PlotLayout plot = bare_plot(display, steps_across(sonar_, shape), sonar_.bin_count);
  return plot_numbers(plot, sonar_.bin_count, [&](int bin, double across) {
    const int ping = slots.at(shape.high - across * shape.aperture()).ping;
    return ping < 0 ? kNoLabel : numbers.at(static_cast<std::size_t>(ping)).at(static_cast<std::size_t>(bin));
  });
}

ProductView::ProductView(const SonarConfig& sonar) : sonar_(sonar) {
  constexpr std::size_t kRows = 600;  // Of a waterfall that scrolls.
  if (sonar.product() == Product::kLine) {
    scan_.emplace(sonar);
  } else if (sonar.product() == Product::kWaterfall) {
    waterfall_ = std::make_unique<Waterfall>(sonar, WaterfallOptions(), kRows);
  }
}

ProductView::~ProductView() = default;
ProductView::ProductView(ProductView&&) noexcept = default;
ProductView& ProductView::operator=(ProductView&&) noexcept = default;

void ProductView::add(const Ping& ping) {
  if (scan_) {
    scan_->add(ping);
  } else if (waterfall_ != nullptr) {
    waterfall_->add(ping);
  } else {
    last_ = ping;
  }
}

double ProductView::fitting_full_scale() const {
  return scan_                   ? scan_->fitting_full_scale()
         : waterfall_ != nullptr ? waterfall_->fitting_full_scale()
                                 : insonify::fitting_full_scale(intensities_to_fit(last_, sonar_));
}

Picture ProductView::draw(const Display& display) const {
  return scan_                   ? scan_->draw(display)
         : waterfall_ != nullptr ? waterfall_->draw(display)
                                 : draw_fan(last_, sonar_, display);
}

}  // namespace insonify
