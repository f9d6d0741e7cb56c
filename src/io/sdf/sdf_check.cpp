// sdf_check.cpp -- checks the version of an SDF file, and the numbers, links and names of its elements.

#include "io/sdf/sdf_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <locale>
#include <map>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

#include "base/log_line.h"
#include "insonify/error.h"
#include "insonify/printable.h"

namespace insonify {
namespace {

// Numbers in an element of a shape.
const std::map<std::pair<std::string, std::string>, std::size_t> kNumbers = {
    {{"box", "size"}, 3},       {{"plane", "size"}, 2},     {{"plane", "normal"}, 3},      {{"sphere", "radius"}, 1},
    {{"cone", "radius"}, 1},    {{"cone", "length"}, 1},    {{"cylinder", "radius"}, 1},   {{"cylinder", "length"}, 1},
    {{"capsule", "radius"}, 1}, {{"capsule", "length"}, 1}, {{"ellipsoid", "radii"}, 3},   {{"mesh", "scale"}, 3},
    {{"heightmap", "size"}, 3}, {{"heightmap", "pos"}, 3},  {{"heightmap", "sampling"}, 1}};

constexpr std::size_t kNumbersOfPose = 6, kNumbersOfQuaternionPose = 7;

std::string in_words(std::size_t count) {
  return count == 1 ? "a finite number" : fmt::format("{} finite numbers", count);
}

bool is_finite_number(std::string_view word) {
  word.remove_prefix(word.starts_with('+') ? 1 : 0);
  double value = 0;
  const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), value);
  return failure == std::errc() && end == word.data() + word.size() && std::isfinite(value);
}

// Required number of numbers in an element; 0: none.
std::size_t numbers_wanted(pugi::xml_node element) {
  const std::string name = element.name();
  if (name == "pose") {
    const std::string_view format = element.attribute("rotation_format").value();
    return format == "quat_xyzw" ? kNumbersOfQuaternionPose : kNumbersOfPose;
  }
  const auto entry = kNumbers.find({element.parent().name(), name});
  return entry == kNumbers.end() ? 0 : entry->second;
}

// Extra numbers are accepted: Gazebo's own worlds have planes with three sizes.
void check_numbers(const XmlFile& file, pugi::xml_node element) {
  const std::size_t wanted = numbers_wanted(element);
  const std::string content = wanted > 0 ? xml_text(element) : "";
  if (wanted == 0 || (content.empty() && element.name() == std::string_view("pose"))) {
    return;
  }
  std::istringstream words(content);
  std::size_t found = 0;
  bool all_finite = true;
  for (std::string word; words >> word; ++found) {
    all_finite = all_finite && is_finite_number(word);
  }
  if (!all_finite || found < wanted) {
    throw SdfFault(fmt::format("{}<{}> = '{}' must be {}", file.where(element), element.name(), printable(content),
                               in_words(wanted)),
                   file, element);
  }
}

// libsdformat crashes on these.
void check_include_part(const XmlFile& file, pugi::xml_node element) {
  static const std::set<std::string_view> kParts = {"name", "static", "placement_frame"};
  if (element.parent().name() == std::string_view("include") && kParts.contains(element.name()) &&
      xml_text(element).empty()) {
    throw SdfFault(fmt::format("{}<{}> of an include is empty", file.where(element), element.name()), file, element);
  }
}

void check_links(const XmlFile& file, pugi::xml_node element) {
  if (element.name() != std::string_view("model") || element.parent().name() == std::string_view("state")) {
    return;
  }
  const std::string is_static = xml_text(element.child("static"));
  if (!element.child("link") && !element.child("model") && !element.child("include") && is_static != "true" &&
      is_static != "1") {
    throw SdfFault(fmt::format("{}model '{}' must have a link, or be static", file.where(element),
                               printable(element.attribute("name").value())),
                   file, element);
  }
}

void check_name(const XmlFile& file, pugi::xml_node element) {
  static const std::set<std::string_view> kNamed = {"model", "link", "joint", "frame", "visual", "collision"};
  const std::string_view name = element.attribute("name").value();
  if (!kNamed.contains(element.name()) || name.empty() || element.parent().name() == std::string_view("state")) {
    return;
  }
  for (const pugi::xml_node other : element.parent().children(element.name())) {
    if (other == element) {
      return;
    }
    if (other.attribute("name").value() == name) {
      throw SdfFault(fmt::format("{}{} '{}' has the name of the one of line {}", file.where(element), element.name(),
                                 printable(name), file.line_of(other)),
                     file, element);
    }
  }
}

// The element without which a file may be read that has a fault in this one. A shape or a place that cannot be read
// must not become a default.
pugi::xml_node element_to_leave_out(pugi::xml_node element) {
  static const std::set<std::string_view> kPlaced = {"visual",  "collision", "link", "model",
                                                     "include", "frame",     "joint"};
  const auto is = [](pugi::xml_node node, const char* name) { return node.name() == std::string_view(name); };
  bool says_where_or_what = is(element, "pose");
  for (pugi::xml_node node = element; node && !is(node, "sdf") && !is(node, "world"); node = node.parent()) {
    says_where_or_what = says_where_or_what || is(node, "geometry");
    if (kPlaced.contains(node.name()) && (node == element || says_where_or_what)) {
      return node;
    }
  }
  return is(element, "sdf") || is(element, "world") ? pugi::xml_node() : element;
}

// Versions of SDF that libsdformat 12 supports.
constexpr std::pair kOldest{1, 4}, kNewest{1, 9};

}  // namespace

SdfFault::SdfFault(const std::string& message, const XmlFile& file, pugi::xml_node element)
    : Error(message), place_to_leave_out(element ? file.where(element_to_leave_out(element)) : "") {}

void warn_of_sdf_turn(const XmlFile& file, pugi::xml_node element, const Log& log) {
  if (element.name() != std::string_view("pose") || element.attribute("degrees").as_bool() ||
      numbers_wanted(element) != kNumbersOfPose) {
    return;
  }
  constexpr double kMostTurn = 20;  // [rad]
  std::istringstream words(xml_text(element));
  words.imbue(std::locale::classic());
  std::vector<double> numbers(kNumbersOfPose, 0.0);
  for (double& number : numbers) {
    words >> number;
  }
  const double largest = std::max({std::abs(numbers[3]), std::abs(numbers[4]), std::abs(numbers[5])});
  if (largest > kMostTurn) {
    log_line(
        log, Severity::kWarning,
        fmt::format("{}<pose> turns by {:.4g} rad; in degrees it needs degrees='true'", file.where(element), largest));
  }
}

bool complete_sdf_pose(const XmlFile& file, pugi::xml_node element, const Log& log) {
  const std::string content = xml_text(element);
  if (element.name() != std::string_view("pose") || content.empty()) {
    return false;
  }
  constexpr std::string_view kNoTurn[] = {"0", "0", "0", "0", "0", "0", "1"};  // The quaternion has its scalar last.
  const std::size_t wanted = numbers_wanted(element);
  std::istringstream words(content);
  std::size_t found = 0;
  for (std::string word; words >> word; ++found) {
    if (!is_finite_number(word)) {
      return false;
    }
  }
  if (found >= wanted) {
    return false;
  }
  std::string completed = content;
  for (std::size_t i = found; i < wanted; ++i) {
    completed.append(" ").append(kNoTurn[i]);
  }
  log_line(log, Severity::kWarning,
           fmt::format("{}<pose> = '{}' has {} of {} numbers: it is read as '{}'", file.where(element),
                       printable(content), found, wanted, printable(completed)));
  element.remove_children();
  return element.text().set(completed.c_str());
}

void check_sdf_element(const XmlFile& file, pugi::xml_node element) {
  check_include_part(file, element);
  check_numbers(file, element);
  check_links(file, element);
  check_name(file, element);
}

void check_sdf_version(const XmlFile& file, const Log& log) {
  const pugi::xml_node root = file.root();
  const std::string where = file.where(root);
  const std::string_view name = root.name();
  if (name != "sdf") {
    throw Error(fmt::format("{}the root element is <{}>, not <sdf>{}", where, printable(name),
                            name == "robot" ? "; 'gz sdf -p' or 'ign sdf -p' turns URDF into SDF" : ""));
  }
  if (!root.attribute("version")) {
    throw Error(where + "<sdf> has no version, 1.4 to 1.9 are read");
  }
  const std::string version = root.attribute("version").value();
  int major = 0, minor = 0, length = 0;
  if (std::sscanf(version.c_str(), "%d.%d%n", &major, &minor, &length) != 2 ||
      length != static_cast<int>(version.size())) {
    throw Error(fmt::format("{}SDF version '{}' is not two numbers, 1.4 to 1.9 are read", where, printable(version)));
  }
  const auto number = std::pair(major, minor);
  if (number < kOldest) {
    log_line(log, Severity::kWarning,
             fmt::format("{}SDF version {} is older than {}.{}, the oldest that is known to be read right", where,
                         printable(version), kOldest.first, kOldest.second));
  } else if (number > kNewest) {
    log_line(log, Severity::kWarning,
             fmt::format("{}SDF version {} is newer than {}.{} and read as that; new features are ignored", where,
                         printable(version), kNewest.first, kNewest.second));
  }
}

}  // namespace insonify
