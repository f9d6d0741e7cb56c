// picture_options.h -- command-line options for pictures of pings, shared by run and draw.

#pragma once

#include <string>

#include "insonify/engine.h"
#include "insonify/messages.h"
#include "insonify/picture.h"
#include "insonify/receiver_config.h"
#include "insonify/sonar_config.h"

namespace CLI {  // NOLINT(readability-identifier-naming)
class App;
}

namespace insonify {

struct PictureOptions {
  std::string pictures = "20";  ///< "all", "last", "none" or the largest number of pings drawn of a fan.
  std::string colour_map = "inferno";
  std::string scale;      ///< linear or db; "" for the model's default.
  double floor_db = -50;  ///< [dB]
  std::string levels;     ///< "LOW:HIGH" [dB]; "" to fit the pings.
  int height = 720;       ///< [pixels]
  bool counts = false;    ///< Draw counts instead of intensities.
};

/// Adds the options shared by all commands that draw pings, as a group.
void add_picture_options(CLI::App& command, PictureOptions& options, const std::string& group);

/// Adds --counts, beside the options above.
void add_counts_option(CLI::App& command, PictureOptions& options, const std::string& group);

/// Style of the pictures of one sonar's pings.
struct PictureStyle {
  EchoModel model = EchoModel::kCalibrated;
  Display display = {};
  bool fixed_levels = false;  ///< Full scale is given, not fitted to pings.
};

/// Levels of the calibrated model are decibels with gain by range, unless the receiver has applied such a gain.
/// @throws InputError for contradictory options.
[[nodiscard]] PictureStyle picture_style(const PictureOptions& options, EchoModel model,
                                         const ReceiverConfig& receiver);

/// The same for one sonar, whose counts are drawn if the options ask for them.
/// @throws InputError also if it has none.
[[nodiscard]] PictureStyle picture_style(const PictureOptions& options, EchoModel model, const ReceiverConfig& receiver,
                                         const SonarConfig& sonar);

}  // namespace insonify
