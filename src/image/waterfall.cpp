// waterfall.cpp -- draws pings as rows from port to starboard, the newest at the top.

#include "insonify/waterfall.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "image/colours.h"
#include "image/plot.h"
#include "image/scales.h"
#include "image/waterfall_rows.h"
#include "insonify/error.h"
#include "insonify/printable.h"
#include "survey/checks.h"

namespace insonify {
namespace {

// What lies along the track, the oldest ping at 0, the end of the newest at 1.
class Along {
 public:
  Along(const std::deque<Ping>& pings, const SonarConfig& sonar, const WaterfallOptions& options)
      : distances_(distances_along(pings)),
        by_distance_(options.along == AlongTrack::kDistance),
        to_scale_(options.to_scale) {
    usual_step_ = usual_step(distances_);
    length_ = distances_.back() + usual_step_;
    if (to_scale_ && !(length_ > 0)) {
      throw Error(fmt::format("{}: to scale needs a sonar that has moved along its track", sonar.name));
    }
    for (std::size_t ping = 0; ping < pings.size(); ++ping) {
      values_.push_back(options.along == AlongTrack::kPing   ? static_cast<double>(pings[ping].number)
                        : options.along == AlongTrack::kTime ? pings[ping].time
                                                             : distances_[ping]);
    }
  }

  [[nodiscard]] double length() const { return length_; }  // [m]

  // Whether a share of the axis lies where the vehicle has jumped, as between the lines of a survey that pauses on
  // turns.
  [[nodiscard]] bool is_gap(double place) const {
    constexpr double kJump = 5;  // Usual steps.
    const std::size_t ping = ping_at(place);
    return to_scale_ && ping + 1 < distances_.size() && distances_[ping + 1] - distances_[ping] > kJump * usual_step_ &&
           place * length_ > distances_[ping] + usual_step_;
  }

  // The ping at a share of the axis.
  [[nodiscard]] std::size_t ping_at(double place) const {
    if (to_scale_) {
      const auto next = std::ranges::upper_bound(distances_, place * length_);
      return static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, next - distances_.begin() - 1));
    }
    return std::min(distances_.size() - 1, static_cast<std::size_t>(place * static_cast<double>(distances_.size())));
  }

  // The middle of a ping's row.
  [[nodiscard]] double place_of(std::size_t ping) const {
    return to_scale_ ? distances_[ping] / length_
                     : (static_cast<double>(ping) + 0.5) / static_cast<double>(distances_.size());
  }

  [[nodiscard]] std::vector<AxisTick> ticks() const {
    constexpr int kMostParts = 8;
    std::vector<AxisTick> ticks;
    const double window = values_.back() - values_.front();
    std::size_t last = distances_.size();
    if (!(window > 0)) {
      return {{place_of(0), number_text(values_.front()), true}};
    }
    for (const double value : multiples_within(values_.front(), values_.back(), nice_step(window, kMostParts))) {
      const auto next = std::ranges::lower_bound(values_, value * (1 - 1e-12));
      const auto ping =
          static_cast<std::size_t>(std::min(next - values_.begin(), static_cast<std::ptrdiff_t>(values_.size()) - 1));
      if (by_distance_ && to_scale_) {
        ticks.push_back({value / length_, fmt::format("{:.12g}", value + 0.0), ticks.empty()});
      } else if (ping != last) {  // Of values that were jumped over the first.
        ticks.push_back({place_of(ping), fmt::format("{:.12g}", value + 0.0), ticks.empty()});
      }
      last = ping;
    }
    return ticks;
  }

 private:
  // Median of the steps that moved [m]; 0 without.
  static double usual_step(const std::vector<double>& distances) {
    std::vector<double> steps;
    for (std::size_t ping = 1; ping < distances.size(); ++ping) {
      if (distances[ping] > distances[ping - 1]) {
        steps.push_back(distances[ping] - distances[ping - 1]);
      }
    }
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
    std::ranges::nth_element(steps, middle);
    return steps.empty() ? 0 : *middle;
  }

  std::vector<double> distances_, values_;
  double length_ = 0, usual_step_ = 0;  // [m]
  bool by_distance_;
  bool to_scale_;
};

// Ranges to both sides, 0 in the middle.
std::vector<AxisTick> side_ticks(const WaterfallRows& rows) {
  std::vector<AxisTick> ticks;
  const double port = rows.port_cells * rows.cell, starboard = rows.starboard_cells * rows.cell;
  for (const double range : multiples_within(-port, starboard, ring_step(std::max(port, starboard)))) {
    ticks.push_back({(range + port) / (port + starboard), number_text(std::abs(range)), range == 0});
  }
  return ticks;
}

std::string across_caption(const WaterfallRows& rows, bool corrected, bool sideways) {
  if (!sideways) {
    return "range (m)";
  }
  return fmt::format("{}{} range (m){}", rows.port_cells > 0 ? "port   " : "", corrected ? "ground" : "slant",
                     rows.starboard_cells > 0 ? "   starboard" : "");
}

// Mean of a row's cells from..to that hold something; NaN without any.
float mean_of_cells(const std::vector<float>& row, double from, double to) {
  double sum = 0, weight = 0;
  const auto last = std::min(row.size(), static_cast<std::size_t>(std::ceil(to)));
  for (auto cell = static_cast<std::size_t>(from); cell < last; ++cell) {
    const double share = std::min(to, static_cast<double>(cell) + 1) - std::max(from, static_cast<double>(cell));
    if (!std::isnan(row[cell])) {
      sum += share * double{row[cell]};
      weight += share;
    }
  }
  return weight > 0 ? static_cast<float>(sum / weight) : std::numeric_limits<float>::quiet_NaN();
}

// The first return of each side, where the bottom is in sight.
void draw_altitudes(Picture& picture, const PlotLayout& plot, const WaterfallRows& rows, const Along& along,
                    double hairline) {
  const std::size_t sides = rows.first_return.size() / rows.rows.size();
  const int height = plot.bottom - plot.top;
  for (std::size_t side = 0; side < sides; ++side) {
    const int sign = side == 0 && rows.port_cells > 0 ? -1 : 1;
    double last = std::nan("");
    for (int y = 0; y < height; ++y) {
      const double place = 1 - (y + 0.5) / height;
      const double range = along.is_gap(place) ? std::nan("") : rows.first_return[along.ping_at(place) * sides + side];
      const double x =
          plot.left + (rows.port_cells + sign * range / rows.cell) / rows.cells() * (plot.right - plot.left);
      if (!std::isnan(last) && !std::isnan(x)) {
        draw_line(picture, {last, plot.top + y - 0.5}, {x, plot.top + y + 0.5}, 1.5 * hairline, palette::kHead);
      }
      last = x;
    }
  }
}

}  // namespace

Waterfall::Waterfall(const SonarConfig& sonar, WaterfallOptions options, std::size_t most_pings)
    : sonar_(sonar), options_(std::move(options)), most_(most_pings) {
  check_side_looking(sonar);
}

void Waterfall::add(const Ping& ping) {
  check_line_ping(ping, sonar_);
  Ping shown;
  shown.number = ping.number;
  shown.time = ping.time;
  shown.world_from_sonar = ping.world_from_sonar;
  shown.bin_count = ping.bin_count;
  shown.beam_count = ping.beam_count;
  shown.intensity = ping.intensity;
  pings_.push_back(std::move(shown));
  if (most_ > 0 && pings_.size() > most_) {
    pings_.pop_front();
  }
}

double Waterfall::fitting_full_scale() const {
  WaterfallOptions shown = options_;
  shown.altitude_line = false;
  std::vector<float> all;
  for (const std::vector<float>& row : waterfall_rows(pings_, sonar_, shown).rows) {
    all.insert(all.end(), row.begin(), row.end());
  }
  return insonify::fitting_full_scale(std::move(all));
}

Picture Waterfall::draw(const Display& display) const {
  display.validate();
  if (pings_.empty()) {
    throw Error(fmt::format("{}: a waterfall must have at least one ping", sonar_.name));
  }
  const Along along(pings_, sonar_, options_);
  WaterfallOptions shown = options_;
  shown.altitude_line = options_.altitude_line && !options_.corrected && display.annotations;
  const WaterfallRows rows = waterfall_rows(pings_, sonar_, shown);
  const char* const captions[] = {"ping", "time (s)", "distance (m)"};
  const PlotAxes axes{
      side_ticks(rows), along.ticks(),
      across_caption(rows, options_.corrected, std::abs(sonar_.beam_azimuth(0)) > radians_from_degrees(45)),
      captions[static_cast<int>(options_.along)]};
  // Steps along the track, those of the plot's bins.
  const int steps =
      options_.to_scale ? std::max<int>(8192, static_cast<int>(pings_.size())) : static_cast<int>(pings_.size());
  std::vector<float> means(pings_.size()), profile(static_cast<std::size_t>(steps));
  PlotStyle style;
  style.shape = options_.to_scale ? along.length() / (rows.cells() * rows.cell) : 0;
  style.over = [&](Picture& picture, const PlotLayout& plot, double hairline) {
    if (shown.altitude_line) {
      draw_altitudes(picture, plot, rows, along, hairline);
    }
  };
  return plot_picture(
      display, heading_of(sonar_, counted(pings_.size(), "ping"), pings_.back().time), axes, rows.cells(), steps,
      [&](int x, int width) {
        const double step = static_cast<double>(rows.cells()) / width;
        std::ranges::transform(rows.rows, means.begin(), [&](const std::vector<float>& row) {
          return mean_of_cells(row, x * step, (x + 1) * step);
        });
        for (int i = 0; i < steps; ++i) {
          const double place = (i + 0.5) / steps;
          profile[i] = along.is_gap(place) ? std::numeric_limits<float>::quiet_NaN() : means[along.ping_at(place)];
        }
        return std::span<const float>(profile);
      },
      style);
}

}  // namespace insonify
