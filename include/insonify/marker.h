// marker.h -- named places of the world that an operator has marked, as recordings keep them.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "insonify/geometry.h"

namespace insonify {

struct Marker {
  std::string name;
  Vec3 position = Vec3::Zero();                ///< World frame [m].
  double time = 0;                             ///< Of the ping on which it was set [s].
  std::string sonar;                           ///< Whose ping that is.
  std::uint64_t ping = 0;                      ///< Its number.
  std::optional<double> range = std::nullopt;  ///< Slant range on that ping [m]; none where the operator's program did
                                               ///< not write one.
  std::string side = "";                       ///< "port" or "starboard" of a side-scan sonar, else empty.
};

/// A marker in a recording: a JSON object {"name", "position": [x, y, z], "time", "sonar", "ping"}, with
/// "range" and "side" where it has them.
[[nodiscard]] std::string marker_text(const Marker& marker);

/// @throws Error for a text that is not one of marker_text().
[[nodiscard]] Marker marker_from_text(std::string_view text);

/// The same for lists.
[[nodiscard]] std::vector<std::string> marker_texts(const std::vector<Marker>& markers);
[[nodiscard]] std::vector<Marker> markers_from_texts(const std::vector<std::string>& texts);

}  // namespace insonify
