// bag_metadata.cpp -- finds the elements of ISO 19139 that give spacing, corners and reference system of a grid.

#include "io/grid/bag_metadata.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <pugixml.hpp>
#include <string_view>
#include <vector>

#include "io/file/xml_file.h"

namespace insonify {
namespace {

// Whether a node is an element of that name, in whatever namespace.
bool is_named(pugi::xml_node node, std::string_view name) {
  const std::string_view own = node.name();
  return node.type() == pugi::node_element && own.substr(own.find(':') + 1) == name;  // npos + 1 is 0.
}

pugi::xml_node find_first(pugi::xml_node inside, std::string_view name) {
  return inside.find_node([&](pugi::xml_node node) { return is_named(node, name); });
}

// All text below a node, in lower case and without white space at its ends.
std::string text_of(pugi::xml_node below) {
  std::string text;
  below.find_node([&](pugi::xml_node node) {
    text += node.value();  // "" for an element.
    text += ' ';
    return false;
  });
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return without_outer_space(text);
}

// All numbers in a text. Whatever separates them is skipped.
std::vector<double> numbers_of(const std::string& text) {
  std::vector<double> numbers;
  const char* end = text.data() + text.size();
  for (const char* at = text.data(); at < end;) {
    double value = 0;
    const auto [after, failure] = std::from_chars(at, end, value);
    if (failure == std::errc() && std::isfinite(value)) {
      numbers.push_back(value);
      at = after;
    } else {
      ++at;
    }
  }
  return numbers;
}

std::optional<double> positive_number(const std::string& text) {
  const std::vector<double> numbers = numbers_of(text);
  return !numbers.empty() && numbers.front() > 0 ? std::optional(numbers.front()) : std::nullopt;
}

void read_dimension(pugi::xml_node dimension, BagMetadata& metadata) {
  const std::string name = text_of(find_first(dimension, "dimensionName"));
  const pugi::xml_node resolution = find_first(dimension, "resolution");
  const std::optional<double> spacing = positive_number(text_of(resolution));
  if (name == "row") {
    metadata.spacing_y = spacing;
  } else if (name == "column") {
    metadata.spacing_x = spacing;
  }
  for (const pugi::xml_attribute attribute : find_first(resolution, "Measure").attributes()) {
    if (std::string_view(attribute.value()).find("deg") != std::string_view::npos) {
      metadata.is_geographic = true;
    }
  }
}

void read_corners(pugi::xml_node xml, BagMetadata& metadata) {
  const std::vector<double> corners = numbers_of(text_of(find_first(xml, "cornerPoints")));
  if (corners.size() == 4) {
    metadata.south_west = Vec3(corners[0], corners[1], 0);
    metadata.north_east = Vec3(corners[2], corners[3], 0);
  }
}

// The first reference system is the horizontal one. It is given as well-known text, as a word or as an EPSG code.
void read_reference_system(pugi::xml_node xml, BagMetadata& metadata) {
  const std::string code = text_of(find_first(find_first(xml, "referenceSystemInfo"), "code"));
  const auto begins_with_one_of = [&](const auto& words) {
    return std::ranges::any_of(words, [&](std::string_view word) { return code.starts_with(word); });
  };
  // WGS 84, NAD 83, ETRS 89, and WGS 84 in three dimensions.
  constexpr std::array<std::string_view, 8> kGeographic{"geog", "geodcrs", "geodetic", "4326",
                                                        "4269", "4258",    "4979",     "epsg:4326"};
  constexpr std::array<std::string_view, 4> kProjected{"proj", "utm", "mercator", "local_cs"};
  if (begins_with_one_of(kGeographic)) {
    metadata.is_geographic = true;
  } else if (begins_with_one_of(kProjected)) {
    metadata.is_geographic = false;
  }
}

}  // namespace

BagMetadata parse_bag_metadata(const std::string& xml) {
  // XML that is not well-formed is used up to its fault. The caller reports elements that are missing.
  pugi::xml_document text;
  text.load_string(xml.c_str());
  BagMetadata metadata;
  read_reference_system(text, metadata);
  text.find_node([&](pugi::xml_node node) {
    if (is_named(node, "MD_Dimension")) {
      read_dimension(node, metadata);
    }
    return false;
  });
  read_corners(text, metadata);
  return metadata;
}

}  // namespace insonify
