// draw_channels.cpp -- draws distance, intensity and both as three panels over one azimuth axis.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "image/colours.h"
#include "image/plot.h"
#include "image/scales.h"
#include "insonify/channels.h"
#include "insonify/error.h"

namespace insonify {
namespace {

constexpr int kPanels = 3;
constexpr double kCaptionHeight = 1.9;  // Height of the caption above a panel [em].
constexpr int kLeastPanel = 40;         // [pixels]

enum class Panel { kDistance, kIntensity, kBoth };

Rgb colour_of(Panel panel, double distance, double intensity) {
  switch (panel) {
    case Panel::kDistance:
      return colour(ColourMap::kBlue, distance);
    case Panel::kIntensity:
      return colour(ColourMap::kInferno, intensity);
    default: {
      const auto level = [](double value) {
        return static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0, 1.0)));
      };
      return {0, level(intensity), level(distance)};
    }
  }
}

// Intensity drawn brightest: the least of 1, 2, 2.5 and 5 times a power of ten that is not below the strongest echo.
double full_scale_of(const Channels& channels) {
  double strongest = 1e-6;
  for (const float intensity : channels.intensity) {
    strongest = std::max(strongest, std::isnan(intensity) ? 0.0 : static_cast<double>(intensity));
  }
  return nice_step(strongest, 1);
}

std::string caption_of(Panel panel, double max_range, double full_scale) {
  switch (panel) {
    case Panel::kDistance:
      return fmt::format("pulse distance, 0 to {} m", number_text(max_range));
    case Panel::kIntensity:
      return fmt::format("echo intensity, 0 to {}", number_text(full_scale));
    default:
      return "both: distance blue, intensity green";
  }
}

// Rectangle of a panel on the picture [pixels].
struct Frame {
  int left, top, width, height;
};

void paint(Picture& picture, const Frame& frame, Panel panel, const Channels& channels, double max_range,
           double full_scale) {
  for (int y = 0; y < frame.height; ++y) {
    const int row = static_cast<int>((y + 0.5) / frame.height * channels.rows);
    for (int x = 0; x < frame.width; ++x) {
      const int column = static_cast<int>((x + 0.5) / frame.width * channels.columns);
      const std::size_t at = static_cast<std::size_t>(row) * channels.columns + column;
      const auto distance = static_cast<double>(channels.distance[at]);
      const Rgb shown = std::isnan(distance) ? palette::kNotYetSeen
                                             : colour_of(panel, distance / max_range,
                                                         static_cast<double>(channels.intensity[at]) / full_scale);
      put(picture, frame.left + x, frame.top + y, shown);
    }
  }
}

std::string degrees_text(double angle) {
  return number_text(std::round(10 * degrees_from_radians(angle)) / 10) + "°";
}

void draw_scale(Picture& picture, const Frame& frame, Panel panel, const Page& page) {
  if (panel == Panel::kBoth) {
    return;
  }
  const int left = frame.left + frame.width + static_cast<int>(std::lround(0.8 * page.em()));
  const int right = left + static_cast<int>(std::lround(0.7 * page.em()));
  for (int y = 0; y < frame.height; ++y) {
    const double level = 1 - (y + 0.5) / frame.height;
    fill_rectangle(picture, {left * 1.0, frame.top + y * 1.0}, {right * 1.0, frame.top + y + 1.0},
                   {colour_of(panel, level, level), 1});
  }
}

// Layout of the panels on the picture [pixels]: equal sizes, equal distances.
struct Layout {
  int width, height;
  Frame first;
  int step;

  [[nodiscard]] Frame frame(Panel panel) const {
    return {first.left, first.top + static_cast<int>(panel) * step, first.width, first.height};
  }
  [[nodiscard]] int bottom() const { return first.top + (kPanels - 1) * step + first.height; }
};

int pixels(double length) {
  return static_cast<int>(std::ceil(length));
}

int layout_width(const Display& display) {
  return display.height * 4 / 3;
}

// Pixels cover equal angles in azimuth and elevation where there is room for it. Without axes the panels fill the
// picture.
Layout lay_out(const Channels& channels, const Page& page, const Display& display) {
  const Lettering& lettering = page.lettering();
  const bool axes = display.annotations;
  const double em = page.em();
  const int width = layout_width(display);
  const int left = axes ? pixels(page.margin() + lettering.width("-00.0°") + kTextGap * em) : 0;
  const int right = axes ? width - pixels(page.margin() + 1.6 * em) : width;
  const int top = axes ? pixels(page.title_height()) : 0;
  const int below = axes ? pixels(page.margin() + 2 * lettering.height() + 2 * em) : 0;
  const int caption = axes ? pixels(kCaptionHeight * em) : 0;
  const int room = std::max((display.height - top - below) / kPanels - caption, kLeastPanel);
  const double shape = (channels.upper_edge - channels.lower_edge) / (channels.port_edge - channels.starboard_edge);
  const int height = std::clamp(static_cast<int>(std::lround(shape * (right - left))), kLeastPanel, room);
  return {
      width, top + kPanels * (height + caption) + below, {left, top + caption, right - left, height}, height + caption};
}

void label_panel(Picture& picture, const Frame& frame, const std::string& caption, const Channels& channels,
                 const Page& page) {
  const Lettering& lettering = page.lettering();
  lettering.draw(picture, {frame.left * 1.0, frame.top - 0.75 * page.em()}, caption, palette::kText, Anchor::kStart);
  const double right_end = frame.left - kTextGap * page.em(), half_letter = 0.5 * lettering.height();
  lettering.draw(picture, {right_end, frame.top + half_letter}, degrees_text(channels.upper_edge), palette::kText,
                 Anchor::kEnd);
  lettering.draw(picture, {right_end, frame.top + frame.height - half_letter}, degrees_text(channels.lower_edge),
                 palette::kText, Anchor::kEnd);
}

// The azimuth axis under the lowest panel.
void draw_axis(Picture& picture, const Layout& layout, const Channels& channels, Mounting mounting, const Page& page) {
  const Lettering& lettering = page.lettering();
  const double em = page.em(), bottom = layout.bottom(), aperture = channels.port_edge - channels.starboard_edge;
  for (const double azimuth :
       multiples_within(channels.starboard_edge, channels.port_edge, radial_step(aperture, mounting))) {
    const double x = layout.first.left + (channels.port_edge - azimuth) / aperture * layout.first.width;
    draw_line(picture, {x, bottom}, {x, bottom + kTickLength * em}, page.hairline(), palette::kText);
    lettering.draw(picture, {x, bottom + (kTickLength + kTextGap) * em + lettering.height() / 2},
                   bearing_text(std::remainder(azimuth, 2 * std::numbers::pi), mounting), palette::kText);
  }
  lettering.draw(
      picture, {layout.first.left + layout.first.width / 2.0, picture.height - page.margin() - lettering.height() / 2},
      mounting == Mounting::kVertical ? "slope across, angle to the plane of the scan upwards"
                                      : "azimuth across, elevation upwards",
      palette::kText);
}

}  // namespace

Picture draw_channels(const Channels& channels, const SonarConfig& sonar, const Display& display) {
  display.validate();
  const std::size_t count = static_cast<std::size_t>(channels.columns) * channels.rows;
  if (count == 0 || channels.distance.size() != count || channels.intensity.size() != count) {
    throw Error(fmt::format("channels have {} distances and {} intensities for {} columns x {} rows",
                            channels.distance.size(), channels.intensity.size(), channels.columns, channels.rows));
  }
  Page page(display, {name_of(sonar), fmt::format("{}   {} m   what the fan is made of",
                                                  frequency_text(sonar.frequency), number_text(sonar.max_range))});
  page.fit_title(layout_width(display));
  const Layout layout = lay_out(channels, page, display);
  const double full_scale = full_scale_of(channels);
  Picture picture = blank_picture(layout.width, layout.height, palette::kBackground);
  for (const Panel panel : {Panel::kDistance, Panel::kIntensity, Panel::kBoth}) {
    const Frame frame = layout.frame(panel);
    paint(picture, frame, panel, channels, sonar.max_range, full_scale);
    if (display.annotations) {
      label_panel(picture, frame, caption_of(panel, sonar.max_range, full_scale), channels, page);
      draw_scale(picture, frame, panel, page);
    }
  }
  if (display.annotations) {
    draw_axis(picture, layout, channels, sonar.head.mounting, page);
    page.draw_title(picture);
  }
  return picture;
}

}  // namespace insonify
