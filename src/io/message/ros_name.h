// ros_name.h -- names of sonars as ROS allows them in topics and frames.

#pragma once

#include <string>
#include <string_view>

namespace insonify {

/// ASCII letters, digits and `_`; anything else becomes `_`, one for each byte, and a name that begins with a digit
/// gets one in front. "" becomes "sonar".
[[nodiscard]] inline std::string ros_name(std::string_view name) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  std::string result;
  for (const char c : name) {
    result += (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || is_digit(c) ? c : '_';
  }
  if (result.empty()) {
    return "sonar";
  }
  return is_digit(result.front()) ? "_" + result : result;
}

}  // namespace insonify
