// levels.h -- the value of --levels: the darkest and the brightest level of a picture.

#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <utility>

namespace insonify {

/// Lowest and highest level of "LOW:HIGH" [dB]; none if the text is not two increasing numbers within 400 dB.
[[nodiscard]] std::optional<std::pair<double, double>> parsed_levels(const std::string& text);

/// Accepts what parsed_levels() does.
[[nodiscard]] CLI::Validator levels();

}  // namespace insonify
