// bag_metadata.cpp -- the few elements of ISO 19139 that place a grid, found without an XML library.

#include "io/grid/bag_metadata.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <string_view>
#include <vector>

namespace insonify {
namespace {

struct Element {
  std::string_view attributes;
  std::string_view content;
};

std::string without_comments(std::string xml) {
  for (std::size_t start = xml.find("<!--"); start != std::string::npos; start = xml.find("<!--", start)) {
    const std::size_t end = xml.find("-->", start);
    xml.erase(start, end == std::string::npos ? end : end + 3 - start);
  }
  return xml;
}

// A tag "<ns:name attributes>", "</ns:name>" or "<ns:name/>".
struct Tag {
  std::string_view name;  // Without its namespace.
  std::string_view attributes;
  bool closes = false;
  bool is_empty = false;
  std::size_t start = 0, end = 0;  // In the text.
};

std::optional<Tag> next_tag(std::string_view xml, std::size_t from) {
  Tag tag;
  tag.start = xml.find('<', from);
  const std::size_t close = tag.start == xml.npos ? xml.npos : xml.find('>', tag.start);
  if (close == xml.npos) {
    return std::nullopt;
  }
  tag.end = close + 1;
  std::string_view inside = xml.substr(tag.start + 1, close - tag.start - 1);
  tag.closes = inside.starts_with('/');
  inside.remove_prefix(tag.closes ? 1 : 0);
  tag.is_empty = inside.ends_with('/');
  inside.remove_suffix(tag.is_empty ? 1 : 0);
  const std::size_t name_end = std::min(inside.find_first_of(" \t\r\n"), inside.size());
  tag.name = inside.substr(0, name_end);
  tag.name.remove_prefix(tag.name.find(':') == xml.npos ? 0 : tag.name.find(':') + 1);
  tag.attributes = inside.substr(name_end);
  return tag;
}

// The outermost elements of that name, in order.
std::vector<Element> find_all(std::string_view xml, std::string_view name) {
  std::vector<Element> found;
  int depth = 0;
  Tag opened;
  for (std::optional<Tag> tag = next_tag(xml, 0); tag; tag = next_tag(xml, tag->end)) {
    if (tag->name != name || tag->is_empty) {
      continue;
    }
    if (!tag->closes && depth++ == 0) {
      opened = *tag;
    } else if (tag->closes && depth > 0 && --depth == 0) {
      found.push_back({opened.attributes, xml.substr(opened.end, tag->start - opened.end)});
    }
  }
  return found;
}

Element find_first(std::string_view xml, std::string_view name) {
  const std::vector<Element> found = find_all(xml, name);
  return found.empty() ? Element() : found.front();
}

// What stands between tags, in lower case and without white space at its ends.
std::string text_of(std::string_view xml) {
  std::string text;
  std::size_t at = 0;
  for (std::optional<Tag> tag = next_tag(xml, 0); tag; tag = next_tag(xml, tag->end)) {
    text += std::string(xml.substr(at, tag->start - at)) + ' ';
    at = tag->end;
  }
  text += xml.substr(at);
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  const std::size_t last = text.find_last_not_of(" \t\r\n");
  return first == std::string::npos ? "" : text.substr(first, last + 1 - first);
}

// Numbers between whatever else there is: commas, blanks.
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

void read_dimensions(std::string_view xml, BagMetadata& metadata) {
  for (const Element& dimension : find_all(xml, "MD_Dimension")) {
    const std::string name = text_of(find_first(dimension.content, "dimensionName").content);
    const std::string_view resolution = find_first(dimension.content, "resolution").content;
    const std::optional<double> spacing = positive_number(text_of(resolution));
    if (name == "row") {
      metadata.spacing_y = spacing;
    } else if (name == "column") {
      metadata.spacing_x = spacing;
    }
    if (find_first(resolution, "Measure").attributes.find("deg") != std::string_view::npos) {
      metadata.is_geographic = true;
    }
  }
}

void read_corners(std::string_view xml, BagMetadata& metadata) {
  const std::vector<double> corners = numbers_of(text_of(find_first(xml, "cornerPoints").content));
  if (corners.size() == 4) {
    metadata.south_west = Vec3(corners[0], corners[1], 0);
    metadata.north_east = Vec3(corners[2], corners[3], 0);
  }
}

// The first reference system is the horizontal one. It is told as well-known text, as a word or as a number of EPSG's.
void read_reference_system(std::string_view xml, BagMetadata& metadata) {
  const std::string code = text_of(find_first(find_first(xml, "referenceSystemInfo").content, "code").content);
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
  const std::string text = without_comments(xml);
  BagMetadata metadata;
  read_reference_system(text, metadata);
  read_dimensions(text, metadata);
  read_corners(text, metadata);
  return metadata;
}

}  // namespace insonify
