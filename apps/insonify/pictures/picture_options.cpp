// picture_options.cpp -- command-line options, converted to a display and a style of pictures, and to options of
// messages.

#include "pictures/picture_options.h"

#include <fmt/format.h>

#include <cmath>

#include "console/outcome.h"
#include "console/validators.h"

namespace insonify {

void add_picture_options(const Command& command, PictureOptions& options, bool with_scale) {
  command.option("--colour-map,--color-map", "NAME", &options.colour_map, "inferno, copper, grey or blue [inferno]");
  if (with_scale) {
    command.option("--scale", "NAME", &options.scale,
                   "linear or db [db in the calibrated model, linear in the paper's]", one_of({"linear", "db"}));
    command.option("--floor-db", "DB", &options.floor_db, "Darkest level on a decibel scale [-50]",
                   number_within({.least = -300, .most = 0, .most_allowed = false}));
  }
  command.option("--levels", "LOW:HIGH", &options.levels,
                 "Colour range in decibels as on the colour bar, such as -90:-40 [fitted to the pings]", levels());
  command.exclude("--levels", {"--floor-db", "--scale"});
  command.option("--height", "N", &options.height, "Height of each picture in pixels, 240 to 8192 [720]",
                 whole_number(240, 8192));
}

void add_waterfall_options(const Command& command, PictureOptions& options) {
  command.flag("--corrected", &options.corrected, "Waterfall on ground ranges of a level bed, not slant ranges");
  command.flag("--to-scale", &options.to_scale, "Waterfall with as many metres a pixel along the track as across");
  command.option("--along", "WHAT", &options.along,
                 "What a waterfall's rows are labelled by: ping, time or distance [ping]",
                 one_of({"ping", "time", "distance"}));
  add_line_options(command, options.line);
}

void add_counts_option(const Command& command, PictureOptions& options) {
  command.flag("--counts", &options.counts,
               "Draw the counts that the instrument delivers (receiver.counts), from 0 to the greatest");
  command.exclude("--counts", {"--scale", "--floor-db", "--levels"});
}

PictureStyle picture_style(const PictureOptions& options, EchoModel model, const ReceiverConfig& receiver) {
  PictureStyle style{.model = model, .display = usual_display(model, receiver)};
  Display& display = style.display;
  display.colour_map = colour_map_from_name(options.colour_map);
  if (!options.scale.empty()) {
    display.scale = options.scale == "db" ? Scale::kDecibel : Scale::kLinear;
  }
  display.floor_db = options.floor_db;
  const bool plain = options.plain || options.masks;
  display.height = options.height.value_or(display.height);
  display.annotations = !plain;
  display.pixel_per_bin = plain && !options.height;
  if (const auto levels = parsed_levels(options.levels)) {
    style.fixed_levels = true;
    display.of_one = model == EchoModel::kPaper;
    display.scale = Scale::kDecibel;
    display.full_scale = std::pow(10, levels->second / 10);
    display.floor_db = levels->first - levels->second;
  }
  display.validate();
  style.waterfall_options = {.corrected = options.corrected,
                             .normalised = options.line.normalised,
                             .to_scale = options.to_scale,
                             .along = options.along == "time"       ? AlongTrack::kTime
                                      : options.along == "distance" ? AlongTrack::kDistance
                                                                    : AlongTrack::kPing,
                             .bottom = bottom_options(options.line)};
  return style;
}

PictureStyle picture_style(const PictureOptions& options, EchoModel model, const ReceiverConfig& receiver,
                           const SonarConfig& sonar) {
  PictureStyle style = picture_style(options, model, receiver);
  if (options.counts) {
    if (model == EchoModel::kPaper || !receiver.counts) {
      throw InputError(
          fmt::format("--counts: the pings of {} have no counts; receiver.counts: true adds them, in the "
                      "calibrated model",
                      sonar.name));
    }
    const Display intensities = style.display;
    style.fixed_levels = true;
    style.display = counts_display(sonar);
    style.display.colour_map = intensities.colour_map;
    style.display.height = intensities.height;
    style.display.annotations = intensities.annotations;
    style.display.pixel_per_bin = intensities.pixel_per_bin;
  }
  return style;
}

std::vector<std::string> MessageChoice::given() const {
  std::vector<std::string> names;
  if (fan_rate) {
    names.emplace_back("--fan-rate");
  }
  if (!start.empty()) {
    names.emplace_back("--start");
  }
  return names;
}

void add_message_choice(const Command& command, MessageChoice& choice, const std::string& where,
                        const std::string& default_start) {
  command.option("--fan-rate", "N", &choice.fan_rate,
                 "Fan pictures " + where +
                     " per second of ping time, at most; 0: none [2 for a scanning sonar, else one per ping]",
                 number_within(from_to(0, 1000)));
  const Check start_time = {[](const std::string& text) -> std::string {
    try {
      (void)start_from_text(text);
      return {};
    } catch (const Error& error) {
      return error.what();
    }
  }};
  command.option("--start", "TIME", &choice.start,
                 "When the run started, for the times " + where + ": the pings' time 0, such as 2026-06-01T10:00:00Z " +
                     default_start,
                 start_time);
}

MessageOptions message_options(const PictureStyle& style, const MessageChoice& choice) {
  MessageOptions messages{.colour_map = style.display.colour_map, .fan_rate = choice.fan_rate};
  if (!choice.start.empty()) {
    messages.start_ns = start_from_text(choice.start);
  }
  if (style.fixed_levels) {
    messages.high_db = 10 * std::log10(style.display.full_scale);
    messages.low_db = *messages.high_db + style.display.floor_db;
  }
  return messages;
}

}  // namespace insonify
