// track_columns.h -- what the columns of a trajectory file are: by the names of its header, by a scenario, or by its
// format.

#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "insonify/files.h"

namespace insonify {

/// Numbers of a waypoint. Angles are either a unit quaternion, or roll, pitch and yaw in radians or in degrees.
enum TrackNumber { kTime, kX, kY, kZ, kQw, kQx, kQy, kQz, kRoll, kPitch, kYaw, kRollDeg, kPitchDeg, kYawDeg, kNumbers };
inline constexpr std::array<std::string_view, kNumbers> kTrackNames = {
    "time", "x", "y", "z", "qw", "qx", "qy", "qz", "roll", "pitch", "yaw", "roll_deg", "pitch_deg", "yaw_deg"};

/// Which number a column is, if any, and the factor that makes it one in SI units, or degrees.
struct TrackColumn {
  std::optional<TrackNumber> number = {};
  double factor = 1;
  std::string name = {};  ///< As in the file.
};

/// The columns of TUM files (scalar last), and of EuRoC's without a header.
[[nodiscard]] std::vector<TrackColumn> tum_columns();
[[nodiscard]] std::vector<TrackColumn> euroc_columns();

/// The columns of a header: "x", "position_x", "p_RS_R_x [m]", "timestamp [ns]" ...
/// @param given  Names, units and signs that a scenario gives, which come first.
/// @throws Error for a number that is given twice, an unknown unit, and a name of `given` that is not in the header.
[[nodiscard]] std::vector<TrackColumn> columns_of_header(const std::vector<std::string>& header,
                                                         const TrajectoryColumns& given);

/// Whether the words are likely a header: one of them is a name of the time, another of a coordinate.
[[nodiscard]] bool is_track_header(const std::vector<std::string>& words);

}  // namespace insonify
