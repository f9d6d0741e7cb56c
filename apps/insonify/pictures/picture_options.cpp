// picture_options.cpp -- command-line options for pictures of pings, converted to a display and a style.

#include "pictures/picture_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>

#include "console/levels.h"
#include "console/outcome.h"
#include "console/validators.h"

namespace insonify {

void add_picture_options(CLI::App& command, PictureOptions& options, const std::string& group) {
  command.add_option("--colour-map,--color-map", options.colour_map, "inferno, copper, grey or blue [inferno]")
      ->type_name("NAME")
      ->group(group);
  CLI::Option* scale =
      command.add_option("--scale", options.scale, "linear or db [db in the calibrated model, linear in the paper's]")
          ->check(one_of({"linear", "db"}))
          ->type_name("NAME")
          ->group(group);
  CLI::Option* floor = command.add_option("--floor-db", options.floor_db, "Darkest level on a decibel scale [-50]")
                           ->check(number_within({.least = -300, .most = 0, .most_allowed = false}))
                           ->type_name("DB")
                           ->group(group);
  command
      .add_option("--levels", options.levels,
                  "Colour range in decibels as on the colour bar, such as -90:-40 [fitted to the pings]")
      ->check(levels())
      ->type_name("LOW:HIGH")
      ->excludes(floor)
      ->excludes(scale)
      ->group(group);
  command.add_option("--height", options.height, "Height of each picture in pixels, 240 to 8192 [720]")
      ->check(whole_number(240, 8192))
      ->type_name("N")
      ->group(group);
}

void add_counts_option(CLI::App& command, PictureOptions& options, const std::string& group) {
  command
      .add_flag("--counts", options.counts,
                "Draw the counts that the instrument delivers (receiver.counts), from 0 to the greatest")
      ->excludes("--scale")
      ->excludes("--floor-db")
      ->excludes("--levels")
      ->group(group);
}

PictureStyle picture_style(const PictureOptions& options, EchoModel model, const ReceiverConfig& receiver) {
  PictureStyle style{.model = model, .display = usual_display(model, receiver)};
  Display& display = style.display;
  display.colour_map = colour_map_from_name(options.colour_map);
  if (!options.scale.empty()) {
    display.scale = options.scale == "db" ? Scale::kDecibel : Scale::kLinear;
  }
  display.floor_db = options.floor_db;
  display.height = options.height;
  if (const auto levels = parsed_levels(options.levels)) {
    style.fixed_levels = true;
    display.of_one = model == EchoModel::kPaper;
    display.scale = Scale::kDecibel;
    display.full_scale = std::pow(10, levels->second / 10);
    display.floor_db = levels->first - levels->second;
  }
  display.validate();
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
  }
  return style;
}

}  // namespace insonify
