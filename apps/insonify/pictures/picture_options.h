// picture_options.h -- command-line options for pictures of pings and recordings of messages, shared by several
// commands.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "console/command.h"
#include "insonify/engine.h"
#include "insonify/messages.h"
#include "insonify/picture.h"
#include "insonify/receiver_config.h"
#include "insonify/sonar_config.h"
#include "insonify/waterfall.h"
#include "pictures/altitudes.h"

namespace insonify {

struct PictureOptions {
  std::string pictures = "20";  ///< "all", "last", "none" or the largest number of pings drawn of a fan.
  std::string colour_map = "inferno";
  std::string scale;               ///< linear or db; "" for the model's default.
  double floor_db = -50;           ///< [dB]
  std::string levels;              ///< "LOW:HIGH" [dB]; "" to fit the pings.
  std::optional<int> height = {};  ///< [pixels]; absent: 720, or with `plain` a pixel a bin.
  bool counts = false;             ///< Draw counts instead of intensities.
  bool plain = false;              ///< Only the picture itself: no title, axes and colour bar.
  bool masks = false;              ///< Also the labels of each pixel, in the pixels of plain pictures.

  // Waterfalls of side-scan sonars.
  LineOptions line;
  bool corrected = false, to_scale = false;  ///< See WaterfallOptions.
  std::string along = "ping";                ///< ping, time or distance.
};

/// Adds the options shared by all commands that draw pings.
/// @param with_scale  Whether there are --scale and --floor-db too.
void add_picture_options(const Command& command, PictureOptions& options, bool with_scale = true);

/// Adds the options of waterfalls, beside the options above.
void add_waterfall_options(const Command& command, PictureOptions& options);

/// Adds --counts, beside the options above.
void add_counts_option(const Command& command, PictureOptions& options);

/// Style of the pictures of one sonar's pings.
struct PictureStyle {
  EchoModel model = EchoModel::kCalibrated;
  Display display = {};
  bool fixed_levels = false;  ///< Full scale is given, not fitted to pings.
  bool waterfall = false;     ///< Pings of a single beam that does not turn are drawn side by side.
  WaterfallOptions waterfall_options = {};
  int mask_bits = 0;  ///< Bits of the pixels of masks, which are drawn too; 0: none.
};

/// Levels of the calibrated model are decibels with gain by range, unless the receiver has applied such a gain.
/// @throws InputError for contradictory options.
[[nodiscard]] PictureStyle picture_style(const PictureOptions& options, EchoModel model,
                                         const ReceiverConfig& receiver);

/// The same for one sonar, whose counts are drawn if the options ask for them.
/// @throws InputError also if it has none.
[[nodiscard]] PictureStyle picture_style(const PictureOptions& options, EchoModel model, const ReceiverConfig& receiver,
                                         const SonarConfig& sonar);

/// What recordings of ROS messages hold.
struct MessageChoice {
  std::optional<double> fan_rate = {};  ///< MessageOptions::fan_rate.
  std::string start = {};               ///< MessageOptions::start_ns as text; "": not given.

  /// Names of the options that were given: "--fan-rate", "--start".
  [[nodiscard]] std::vector<std::string> given() const;
};

/// Adds the options.
/// @param where          Which files they act on, for the help: "in .mcap and .bag".
/// @param default_start  What time 0 is otherwise, for the help: "[1970]".
void add_message_choice(const Command& command, MessageChoice& choice, const std::string& where,
                        const std::string& default_start);

/// Messages with the colours of the style, its levels where it fixes them, and what was chosen.
[[nodiscard]] MessageOptions message_options(const PictureStyle& style, const MessageChoice& choice);

}  // namespace insonify
