// validators.h -- checks of command-line values, with messages in the library's style. CLI11's own say "Value 0 not in
// range 1 to 9".

#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "insonify/field.h"
#include "insonify/survey/geographic.h"

namespace insonify {

/// What a value on the command line may be.
struct Check {
  std::function<std::string(const std::string& text)> fault = {};  ///< Says what would be valid; "" for a valid text.
  std::vector<std::string> choices = {};                           ///< All valid texts, where they are few words.
};

[[nodiscard]] Check whole_number(std::uint64_t least, std::uint64_t most);
[[nodiscard]] Check number_within(const Limits& limits);
[[nodiscard]] Check one_of(std::vector<std::string> words);
/// One or more of them, with commas between.
[[nodiscard]] Check some_of(std::vector<std::string> words);

/// A folder that is there.
[[nodiscard]] Check existing_folder();

/// @param example  An example of what is to be named, for the message.
[[nodiscard]] Check not_empty(const char* example);

/// Accepts what parsed_levels() does.
[[nodiscard]] Check levels();

/// Darkest and brightest level of "LOW:HIGH" [dB]; none if the text is not two increasing numbers within 400 dB.
[[nodiscard]] std::optional<std::pair<double, double>> parsed_levels(const std::string& text);

/// Accepts what parsed_origin() does.
[[nodiscard]] Check origin();

/// Latitude and longitude of "48.45,-68.83" [deg]; none if the text is not two numbers.
[[nodiscard]] std::optional<GeographicPoint> parsed_origin(const std::string& text);

}  // namespace insonify
