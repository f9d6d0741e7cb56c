// track_words.cpp -- cuts lines of trajectory files into words.

#include "io/scenario/track_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/log_line.h"
#include "insonify/error.h"
#include "insonify/printable.h"
#include "io/file/input_file.h"

namespace insonify {
namespace {

std::vector<TrackWord> words_by_space(std::string_view line) {
  std::vector<TrackWord> words;
  for (std::size_t at = 0; (at = line.find_first_not_of(" \t", at)) != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(" \t", at), line.size());
    words.push_back({std::string(line.substr(at, end - at)), static_cast<int>(at) + 1});
    at = end;
  }
  return words;
}

std::vector<TrackWord> words_by(char separator, std::string_view line) {
  std::vector<TrackWord> words;
  for (std::size_t at = 0; at <= line.size();) {
    const std::size_t end = std::min(line.find(separator, at), line.size());
    const std::size_t first = std::min(line.find_first_not_of(" \t", at), end);
    const std::size_t last = line.find_last_not_of(" \t", end - (end > 0 ? 1 : 0));
    const std::size_t length = first < end && last != std::string_view::npos && last >= first ? last - first + 1 : 0;
    std::string_view text = line.substr(first, length);
    if (text.size() > 1 && text.front() == '"' && text.back() == '"') {  // Some programs quote numbers too.
      text = text.substr(1, text.size() - 2);
    }
    words.push_back({std::string(text), static_cast<int>(first) + 1});
    at = end + 1;
  }
  if (words.size() > 1 && words.back().text.empty()) {  // A separator at the end of the line.
    words.pop_back();
  }
  return words;
}

}  // namespace

char separator_of(std::string_view line) {
  constexpr long kLeastTabs = 3;
  const auto has = [&](char c) { return line.find(c) != std::string_view::npos; };
  return has(';') ? ';' : has(',') ? ',' : std::ranges::count(line, '\t') >= kLeastTabs ? '\t' : ' ';
}

std::vector<TrackWord> track_words(std::string_view line, char separator) {
  return separator == ' ' ? words_by_space(line) : words_by(separator, line);
}

std::optional<double> track_number(const std::string& word, char separator) {
  std::string text = word;
  if (separator == ';') {
    std::ranges::replace(text, ',', '.');
  }
  text.erase(0, text.size() > 1 && text.front() == '+' && text[1] != '-' ? 1 : 0);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_number = error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
  return is_number ? std::optional(value) : std::nullopt;
}

std::vector<double> kitti_times(const std::filesystem::path& poses, const Log& log) {
  const std::filesystem::path file = poses.parent_path() / "times.txt";
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) {
    log_line(log, Severity::kWarning,
             fmt::format("{}: matrices of KITTI, without a times.txt beside it: they are taken {} s apart",
                         poses.string(), kKittiPeriod));
    return {};
  }
  std::string text = read_text(file);
  std::ranges::replace(text, '\n', ' ');
  std::ranges::replace(text, '\r', ' ');
  std::vector<double> times;
  for (const TrackWord& word : words_by_space(text)) {
    const std::optional<double> time = track_number(word.text, ' ');
    if (!time) {
      throw Error(fmt::format("{}: \"{}\" must be a number", file.string(), printable(word.text)));
    }
    times.push_back(*time);
  }
  return times;
}

}  // namespace insonify
