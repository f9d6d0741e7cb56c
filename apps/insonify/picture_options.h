// picture_options.h -- how pictures of pings are drawn: what the commands take, and what comes of it.

#pragma once

#include <string>

#include "insonify/engine.h"
#include "insonify/picture.h"
#include "insonify/receiver_config.h"

namespace CLI {
class App;
}

namespace insonify {

struct PictureOptions {
  std::string pictures = "20";  ///< "all", "last", "none" or how many pings of a fan at most.
  std::string colour_map = "inferno";
  std::string scale;      ///< "" for what suits the model.
  double floor_db = -50;  ///< [dB]
  std::string levels;     ///< "LOW:HIGH" [dB]; "" for a range that fits the pings.
  int height = 720;       ///< [pixels]
};

/// Adds the options that all commands have which draw pings, in a group of their own.
void add_picture_options(CLI::App& command, PictureOptions& options, const std::string& group);

/// How the pings of one sonar are drawn.
struct PictureStyle {
  EchoModel model = EchoModel::kCalibrated;
  Display display = {};
  bool fixed_levels = false;  ///< The display's full scale is given, and fits no ping.
};

/// Levels of the calibrated model are decibels raised by range, unless the receiver has raised them.
/// @throws InputError for options that make no sense.
[[nodiscard]] PictureStyle picture_style(const PictureOptions& options, EchoModel model,
                                         const ReceiverConfig& receiver);

}  // namespace insonify
