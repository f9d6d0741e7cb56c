// validators.cpp -- each returns "" for a valid value, else what would be valid.

#include "console/validators.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <sstream>

#include "insonify/printable.h"

namespace insonify {
namespace {

// The number that a whole text is; none for any other text.
template <typename Number>
std::optional<Number> number_of(const std::string& text) {
  Number number = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && rest == end ? std::optional(number) : std::nullopt;
}

}  // namespace

Check whole_number(std::uint64_t least, std::uint64_t most) {
  return {[=](const std::string& text) {
    const auto number = number_of<std::uint64_t>(text);
    return number && *number >= least && *number <= most
               ? std::string()
               : fmt::format("{} must be a whole number, from {} to {}", text, least, most);
  }};
}

Check number_within(const Limits& limits) {
  return {[=](const std::string& text) {
    const auto number = number_of<double>(text);
    return number && limits.allow(*number) ? std::string()
                                           : fmt::format("{} must be a number, {}", text, limits.text());
  }};
}

Check one_of(std::vector<std::string> words) {
  const auto fault = [words](const std::string& text) {
    return std::ranges::find(words, text) != words.end() ? std::string()
                                                         : fmt::format("{} must be {}", text, fmt::join(words, " or "));
  };
  return {fault, std::move(words)};
}

Check some_of(std::vector<std::string> words) {
  const auto fault = [words](const std::string& text) {
    std::istringstream parts(text);
    bool good = !text.empty() && text.back() != ',';
    for (std::string part; good && std::getline(parts, part, ',');) {
      good = std::ranges::find(words, part) != words.end();
    }
    return good ? std::string() : fmt::format("{} must be {}, or several with commas", text, fmt::join(words, " or "));
  };
  return {fault, std::move(words)};
}

Check existing_folder() {
  return {[](const std::string& text) {
    std::error_code ignored;
    return std::filesystem::is_directory(text, ignored) ? std::string() : fmt::format("{} must be a folder", text);
  }};
}

Check not_empty(const char* example) {
  return {[=](const std::string& text) {
    return text.empty() ? fmt::format("must not be empty: name {}", example) : std::string();
  }};
}

std::optional<std::pair<double, double>> parsed_levels(const std::string& text) {
  constexpr double kMost = 400;  // [dB]
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) {
    return {};
  }
  const auto low = number_of<double>(text.substr(0, colon)), high = number_of<double>(text.substr(colon + 1));
  const bool good = low && high && *low >= -kMost && *high <= kMost && *low < *high;
  return good ? std::optional(std::pair(*low, *high)) : std::nullopt;
}

Check levels() {
  return {[](const std::string& text) {
    return parsed_levels(text)
               ? std::string()
               : fmt::format("{} must be LOW:HIGH, two rising levels from -400 to 400 dB, as -90:-40", text);
  }};
}

std::optional<GeographicPoint> parsed_origin(const std::string& text) {
  GeographicPoint origin;
  const char* const end = text.data() + text.size();
  const auto latitude = std::from_chars(text.data(), end, origin.latitude);
  if (latitude.ec != std::errc() || latitude.ptr == end || *latitude.ptr != ',') {
    return std::nullopt;
  }
  const auto longitude = std::from_chars(latitude.ptr + 1, end, origin.longitude);
  return longitude.ec == std::errc() && longitude.ptr == end ? std::optional(origin) : std::nullopt;
}

Check origin() {
  return {[](const std::string& text) {
    return parsed_origin(text)
               ? std::string()
               : fmt::format("{} must be a latitude and a longitude in degrees, such as 48.45,-68.83", printable(text));
  }};
}

}  // namespace insonify
