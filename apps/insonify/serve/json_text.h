// json_text.h -- JSON values and texts of the viewer's messages.

#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "insonify/geometry.h"

namespace insonify {

using Json = nlohmann::ordered_json;  ///< Members in the order in which they were added.

/// The text of a message. Names come from files and may be invalid UTF-8: invalid bytes become U+FFFD.
[[nodiscard]] inline std::string dumped(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// [x, y, z]
[[nodiscard]] inline Json listed(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

/// [w, x, y, z]
[[nodiscard]] inline Json listed(const Eigen::Quaterniond& q) {
  return {q.w(), q.x(), q.y(), q.z()};
}

}  // namespace insonify
