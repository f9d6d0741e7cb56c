// json_messages.h -- JSON texts to a page, and checked members of its messages.

#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "insonify/error.h"
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

/// A malformed message: it ends the connection. Invalid values are answered with an error instead.
class FormError : public Error {
 public:
  using Error::Error;
};

/// Reads a text with the members that the caller uses; `discarded` if it is not JSON.
/// @throws FormError if it is more than 32 brackets deep: values are copied and written by recursion.
[[nodiscard]] nlohmann::json parse_message(std::string_view text);

/// All functions here throw FormError for a missing key or a value of the wrong type.
[[nodiscard]] const nlohmann::json& member(const nlohmann::json& message, const char* key);
[[nodiscard]] std::string text_of(const nlohmann::json& message, const char* key);
[[nodiscard]] bool switch_of(const nlohmann::json& message, const char* key);
[[nodiscard]] double number_of(const nlohmann::json& message, const char* key);
[[nodiscard]] std::vector<std::string> texts_of(const nlohmann::json& message, const char* key);

/// A list of `count` numbers.
[[nodiscard]] Eigen::VectorXd numbers_of(const nlohmann::json& message, const char* key, int count);

}  // namespace insonify
