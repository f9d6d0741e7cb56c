// altitudes.h -- options for pictures of side-scan lines: where altitudes come from, and how a waterfall is drawn.

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "console/command.h"
#include "insonify/recorded_pings.h"
#include "insonify/waterfall.h"

namespace insonify {

struct LineOptions {
  std::string altitude = "tracked";         ///< tracked, stored, true or metres.
  std::optional<double> first_return = {};  ///< BottomTrackOptions::first_return_angle [deg].
  bool normalised = false;                  ///< See AngleGain.
};

/// Adds --altitude, --first-return and --normalise.
void add_line_options(const Command& command, LineOptions& options);

[[nodiscard]] BottomTrackOptions bottom_options(const LineOptions& options);

/// The altitudes of a recording's pings that the options ask for [m]; empty: to be tracked.
/// @param sonar  Name; "" for the only one.
/// @throws InputError where the recording has no such altitudes.
[[nodiscard]] std::vector<double> altitudes_of(const LineOptions& options, const RecordedPings& pings,
                                               const std::filesystem::path& file, const std::string& sonar);

}  // namespace insonify
