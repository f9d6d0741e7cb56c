// stonefish_element.cpp -- reads attributes with the checks that every number needs.

#include "io/stonefish/stonefish_element.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <sstream>
#include <string_view>
#include <vector>

#include "insonify/field.h"
#include "insonify/printable.h"

namespace insonify {
namespace {

// "pool.scn:3:5: static 'wall': <dimensions> radius"
std::string what_of(const StonefishElement& element, const char* child, const char* attribute) {
  const std::string tag = *child == '\0' ? "" : fmt::format("<{}> ", child);
  return fmt::format("{}: {}{}", element.what(), tag, attribute);
}

// Why a text with an unreplaced argument cannot be read, as the end of a message; "" if it has none.
std::string reason_unreadable(std::string_view text) {
  const auto has = [&](std::string_view what) { return text.find(what) != std::string_view::npos; };
  if (has("${")) {
    return ": formulas are not worked out, write the number";
  }
  if (has("$(find")) {
    return ": no such package above the scenario or in AMENT_PREFIX_PATH or ROS_PACKAGE_PATH";
  }
  if (!has("$(")) {
    return "";
  }
  const std::string_view call = text.substr(text.find("$(") + 2);
  const std::string_view inside = call.substr(0, call.find(')'));
  const std::string name = without_outer_space(inside.substr(std::min(inside.find(' '), inside.size())));
  return fmt::format(": has no value here; --set arguments.{}=... gives it one",
                     printable(name.substr(name.rfind('/') + 1)));
}

// The attribute's text, without anything left to replace.
std::string text_of(const StonefishElement& element, const char* child, const char* attribute) {
  const pugi::xml_node node = *child == '\0' ? element.node : element.node.child(child);
  if (!node) {
    throw Error(fmt::format("{}: <{}> is missing", element.what(), child));
  }
  const pugi::xml_attribute found = node.attribute(attribute);
  if (!found) {
    throw Error(what_of(element, child, attribute) + " is missing");
  }
  const std::string_view text = found.value();
  if (const std::string reason = reason_unreadable(text); !reason.empty()) {
    throw UnreadablePart(fmt::format("{} = '{}'", what_of(element, child, attribute), printable(text)), reason);
  }
  return std::string(text);
}

std::vector<double> numbers_of(const std::string& text) {
  std::vector<double> numbers;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const char* begin = word.c_str() + (word.front() == '+' ? 1 : 0);
    double number = 0;
    const auto [end, failure] = std::from_chars(begin, word.c_str() + word.size(), number);
    if (failure != std::errc() || end != word.c_str() + word.size() || !std::isfinite(number)) {
      return {};
    }
    numbers.push_back(number);
  }
  return numbers;
}

std::vector<double> numbers(const StonefishElement& element, const char* child, const char* attribute,
                            std::size_t count) {
  const std::string text = text_of(element, child, attribute);
  std::vector<double> read = numbers_of(text);
  if (read.size() != count) {
    throw Error(fmt::format("{} = '{}' must be {}", what_of(element, child, attribute), printable(text),
                            count == 1 ? "a number" : "three numbers"));
  }
  return read;
}

}  // namespace

std::string StonefishElement::what() const {
  const std::string shown = name().empty() ? fmt::format("<{}>", printable(node.name()))
                                           : fmt::format("{} '{}'", printable(node.name()), printable(name()));
  return file->where(node) + shown;
}

std::string stonefish_text(const StonefishElement& element, const char* child, const char* attribute) {
  std::string text = text_of(element, child, attribute);
  if (text.empty()) {
    throw Error(what_of(element, child, attribute) + " is empty");
  }
  return text;
}

double stonefish_number(const StonefishElement& element, const char* child, const char* attribute) {
  return numbers(element, child, attribute, 1).front();
}

double stonefish_number_or(const StonefishElement& element, const char* child, const char* attribute,
                           double otherwise) {
  return element.node.child(child).attribute(attribute) ? stonefish_number(element, child, attribute) : otherwise;
}

double stonefish_length(const StonefishElement& element, const char* child, const char* attribute) {
  const double length = stonefish_number(element, child, attribute);
  if (!(length > 0)) {
    throw Error(fmt::format("{} = {} m must be greater than 0 m", what_of(element, child, attribute), length));
  }
  return length;
}

Vec3 stonefish_vector(const StonefishElement& element, const char* child, const char* attribute) {
  const std::vector<double> read = numbers(element, child, attribute, 3);
  return {read[0], read[1], read[2]};
}

Pose stonefish_pose(const StonefishElement& element, const char* child) {
  const Vec3 position = stonefish_vector(element, child, "xyz");
  for (const double value : position) {
    if (!coordinate().allow(value)) {
      throw Error(fmt::format("{} = {} {} {} m must be {} m in each direction", what_of(element, child, "xyz"),
                              position.x(), position.y(), position.z(), coordinate().text()));
    }
  }
  const Vec3 rpy = stonefish_vector(element, child, "rpy");
  return {position, orientation_from_rpy(rpy.x(), rpy.y(), rpy.z())};
}

Pose up_from_down() {
  return {Vec3::Zero(), Eigen::Quaterniond(0, 1, 0, 0)};
}

}  // namespace insonify
