// ros_name.h -- names of sonars that are valid in ROS topics and frames.

#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "base/utf8.h"

namespace insonify {

/// ASCII letters, digits and `_`; any other character or invalid byte becomes `_`, and a name that begins with a digit
/// gets one in front. "" becomes "sonar".
[[nodiscard]] inline std::string ros_name(std::string_view name) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  std::string result;
  while (!name.empty()) {
    const char32_t c = take_code_point(name);
    const bool allowed = (c >= U'a' && c <= U'z') || (c >= U'A' && c <= U'Z') || (c >= U'0' && c <= U'9');
    result += allowed ? static_cast<char>(c) : '_';
  }
  if (result.empty()) {
    return "sonar";
  }
  return is_digit(result.front()) ? "_" + result : result;
}

/// Unique names of several sonars: a name that is valid in ROS is unchanged; of others with the same result the second
/// gets the suffix `_2`, the third `_3` ...
[[nodiscard]] inline std::vector<std::string> ros_names(const std::vector<std::string>& names) {
  std::vector<std::string> results(names.size()), taken;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (ros_name(names[i]) == names[i]) {
      results[i] = names[i];
      taken.push_back(names[i]);
    }
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (results[i].empty()) {
      results[i] = ros_name(names[i]);
      for (int number = 2; std::ranges::find(taken, results[i]) != taken.end(); ++number) {
        results[i] = ros_name(names[i]) + "_" + std::to_string(number);
      }
      taken.push_back(results[i]);
    }
  }
  return results;
}

}  // namespace insonify
