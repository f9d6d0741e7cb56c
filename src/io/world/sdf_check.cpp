// sdf_check.cpp -- counts numbers, links and names.

#include "io/world/sdf_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "insonify/error.h"
#include "insonify/printable.h"

namespace insonify {
namespace {

// Numbers that an element of a shape holds.
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

// How many numbers an element must hold; 0 for one that holds none.
std::size_t numbers_wanted(const XmlTag& tag, const XmlTag& parent) {
  if (tag.name == "pose") {
    const auto format = tag.attributes.find("rotation_format");
    const bool quaternion = format != tag.attributes.end() && format->second == "quat_xyzw";
    return quaternion ? kNumbersOfQuaternionPose : kNumbersOfPose;
  }
  const auto entry = kNumbers.find({parent.name, tag.name});
  return entry == kNumbers.end() ? 0 : entry->second;
}

// More numbers than needed do no harm: Gazebo's own worlds have planes with three sizes.
void check_numbers(const XmlTag& tag, const XmlTag& parent, const std::string& text, const std::string& shown) {
  const std::size_t wanted = numbers_wanted(tag, parent);
  const std::string content = wanted > 0 ? content_of(tag, text) : "";
  if (wanted == 0 || (content.empty() && tag.name == "pose")) {
    return;
  }
  std::istringstream words(content);
  std::size_t found = 0;
  for (std::string word; words >> word; ++found) {
    if (!is_finite_number(word)) {
      throw Error(
          fmt::format("{}<{}> = '{}' must be {}", tag.where(shown), tag.name, printable(content), in_words(wanted)));
    }
  }
  if (found < wanted) {
    throw Error(
        fmt::format("{}<{}> = '{}' must be {}", tag.where(shown), tag.name, printable(content), in_words(wanted)));
  }
}

// libsdformat crashes on these.
void check_include_part(const XmlTag& tag, const XmlTag& parent, const std::string& text, const std::string& shown) {
  static const std::set<std::string> kParts = {"name", "static", "placement_frame"};
  if (parent.name == "include" && kParts.contains(tag.name) && content_of(tag, text).empty()) {
    throw Error(fmt::format("{}<{}> of an include is empty", tag.where(shown), tag.name));
  }
}

void check_links(const std::vector<XmlTag>& tags, std::size_t model, const std::string& text,
                 const std::string& shown) {
  if (tags[model].name != "model" || tags[tags[model].parent].name == "state") {
    return;
  }
  for (std::size_t i = model + 1; i < tags.size() && tags[i].begin < tags[model].end; ++i) {
    if (tags[i].parent != static_cast<int>(model)) {
      continue;
    }
    const std::string& part = tags[i].name;
    const std::string is_static = part == "static" ? content_of(tags[i], text) : "";
    if (part == "link" || part == "model" || part == "include" || is_static == "true" || is_static == "1") {
      return;
    }
  }
  throw Error(fmt::format("{}model '{}' must have a link, or be static", tags[model].where(shown),
                          printable(tags[model].attribute("name"))));
}

void check_name(const std::vector<XmlTag>& tags, std::size_t tag, const std::string& shown) {
  static const std::set<std::string> kNamed = {"model", "link", "joint", "frame", "visual", "collision"};
  const XmlTag& own = tags[tag];
  if (!kNamed.contains(own.name) || own.attribute("name").empty() || tags[own.parent].name == "state") {
    return;
  }
  for (std::size_t i = own.parent; i < tag; ++i) {
    if (tags[i].parent == own.parent && tags[i].name == own.name &&
        tags[i].attribute("name") == own.attribute("name")) {
      throw Error(fmt::format("{}{} '{}' has the name of the one of line {}", own.where(shown), own.name,
                              printable(own.attribute("name")), tags[i].line));
    }
  }
}

}  // namespace

std::string content_of(const XmlTag& tag, const std::string& text) {
  return xml_decode(text.substr(tag.content_begin, tag.content_end - tag.content_begin));
}

void check_sdf_tag(const std::vector<XmlTag>& tags, std::size_t tag, const std::string& text,
                   const std::string& shown) {
  const XmlTag& parent = tags[tags[tag].parent];
  check_include_part(tags[tag], parent, text, shown);
  check_numbers(tags[tag], parent, text, shown);
  check_links(tags, tag, text, shown);
  check_name(tags, tag, shown);
}

}  // namespace insonify
