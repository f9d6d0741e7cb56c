// track_words.h -- the words of a trajectory file's lines, and what separates them.

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "insonify/log.h"

namespace insonify {

/// Time between KITTI's poses where no file says more [s].
inline constexpr double kKittiPeriod = 0.1;

/// A word of a line, and its column in the file, from 1.
struct TrackWord {
  std::string text;
  int column;
};

/// What separates words: a semicolon (numbers may then have decimal commas), a comma, a tab if each word has one (names
/// may then have blanks), or white space.
[[nodiscard]] char separator_of(std::string_view line);

/// The words of a line, without blanks and quotation marks around them.
[[nodiscard]] std::vector<TrackWord> track_words(std::string_view line, char separator);

/// A finite number; nothing for other words.
[[nodiscard]] std::optional<double> track_number(const std::string& word, char separator);

/// Times of KITTI's poses [s], from times.txt beside their file; empty without it, with a warning.
/// @throws Error for a word that is not a number.
[[nodiscard]] std::vector<double> kitti_times(const std::filesystem::path& poses, const Log& log);

}  // namespace insonify
