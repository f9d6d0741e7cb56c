// validators.cpp -- each returns "" for a valid value, else what would be valid.

#include "console/validators.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

namespace insonify {
namespace {

constexpr std::string_view kChoices = "one of ";

}  // namespace

CLI::Validator whole_number(std::uint64_t least, std::uint64_t most) {
  const auto check = [=](const std::string& text) {
    std::uint64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool good = error == std::errc() && end == text.data() + text.size() && number >= least && number <= most;
    return good ? std::string() : fmt::format("{} must be a whole number, from {} to {}", text, least, most);
  };
  return CLI::Validator(check, "");
}

CLI::Validator number_within(const Limits& limits) {
  const auto check = [=](const std::string& text) {
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool good = error == std::errc() && end == text.data() + text.size() && limits.allow(number);
    return good ? std::string() : fmt::format("{} must be a number, {}", text, limits.text());
  };
  return CLI::Validator(check, "");
}

CLI::Validator not_empty(const char* example) {
  const auto check = [=](const std::string& text) {
    return text.empty() ? fmt::format("must not be empty: name {}", example) : std::string();
  };
  return CLI::Validator(check, "");
}

CLI::Validator one_of(std::vector<std::string> words) {
  // choices_of() reads the words from the validator's name, which no message shows.
  const std::string name = fmt::format("{}{}", kChoices, fmt::join(words, " "));
  const auto check = [words = std::move(words)](const std::string& text) {
    const bool good = std::ranges::find(words, text) != words.end();
    return good ? std::string() : fmt::format("{} must be {}", text, fmt::join(words, " or "));
  };
  return CLI::Validator(check, "", name);
}

std::vector<std::string> choices_of(CLI::Option& option) {
  try {
    const std::string name = option.get_validator(0)->get_name();
    return name.starts_with(kChoices) ? CLI::detail::split(name.substr(kChoices.size()), ' ')
                                      : std::vector<std::string>();
  } catch (const CLI::OptionNotFound&) {
    return {};  // No validator at all.
  }
}

}  // namespace insonify
