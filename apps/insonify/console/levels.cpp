// levels.cpp -- parses LOW:HIGH.

#include "console/levels.h"

#include <fmt/format.h>

#include <charconv>

namespace insonify {

std::optional<std::pair<double, double>> parsed_levels(const std::string& text) {
  constexpr double kMost = 400;  // [dB]
  std::pair<double, double> levels;
  const char* end = text.data() + text.size();
  const auto low = std::from_chars(text.data(), end, levels.first);
  if (low.ec != std::errc() || low.ptr == end || *low.ptr != ':') {
    return {};
  }
  const auto high = std::from_chars(low.ptr + 1, end, levels.second);
  const bool good = high.ec == std::errc() && high.ptr == end && levels.first >= -kMost && levels.second <= kMost &&
                    levels.first < levels.second;
  return good ? std::optional(levels) : std::nullopt;
}

CLI::Validator levels() {
  const auto check = [](const std::string& text) {
    return parsed_levels(text)
               ? std::string()
               : fmt::format("{} must be LOW:HIGH, two rising levels from -400 to 400 dB, as -90:-40", text);
  };
  return CLI::Validator(check, "");
}

}  // namespace insonify
