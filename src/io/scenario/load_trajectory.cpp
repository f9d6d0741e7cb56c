// load_trajectory.cpp -- waypoints from a CSV or a TUM file.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "base/names.h"
#include "insonify/files.h"
#include "insonify/printable.h"
#include "io/file/input_file.h"

namespace insonify {
namespace {

// Columns of a file. Angles are either a unit quaternion, or roll, pitch and yaw in radians or in degrees.
enum Column { kTime, kX, kY, kZ, kQw, kQx, kQy, kQz, kRoll, kPitch, kYaw, kRollDeg, kPitchDeg, kYawDeg, kColumns };
constexpr std::array<std::string_view, kColumns> kNames = {
    "time", "x", "y", "z", "qw", "qx", "qy", "qz", "roll", "pitch", "yaw", "roll_deg", "pitch_deg", "yaw_deg"};
const std::vector<Column> kTumColumns = {kTime, kX, kY, kZ, kQx, kQy, kQz, kQw};

// A word of a line, and its column in the file.
struct Word {
  std::string_view text;
  int column;
};

std::vector<Word> words_by_space(std::string_view line) {
  std::vector<Word> words;
  for (std::size_t at = 0; (at = line.find_first_not_of(" \t", at)) != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(" \t", at), line.size());
    words.push_back({line.substr(at, end - at), static_cast<int>(at) + 1});
    at = end;
  }
  return words;
}

std::vector<Word> words_by_comma(std::string_view line) {
  std::vector<Word> words;
  for (std::size_t at = 0; at <= line.size();) {
    const std::size_t end = std::min(line.find(',', at), line.size());
    const std::size_t first = std::min(line.find_first_not_of(" \t", at), end);
    const std::size_t last = line.find_last_not_of(" \t", end - (end > 0 ? 1 : 0));
    const std::size_t length = first < end && last != std::string_view::npos && last >= first ? last - first + 1 : 0;
    std::string_view text = line.substr(first, length);
    if (text.size() > 1 && text.front() == '"' && text.back() == '"') {  // Some programs quote numbers too.
      text = text.substr(1, text.size() - 2);
    }
    words.push_back({text, static_cast<int>(first) + 1});
    at = end + 1;
  }
  return words;
}

class TrajectoryReader {
 public:
  explicit TrajectoryReader(const std::filesystem::path& path)
      : path_(path), text_(read_text(path)), is_csv_(ending_of(path) == ".csv") {}

  Trajectory read() {
    if (!is_csv_) {
      columns_ = kTumColumns;
    }
    std::string_view rest = text_;
    if (rest.starts_with("\xef\xbb\xbf")) {  // Byte-order mark.
      rest.remove_prefix(3);
    }
    while (!rest.empty()) {
      const std::size_t end = std::min(rest.find('\n'), rest.size());
      ++line_;
      take(rest.substr(0, end));
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    if (trajectory_.waypoints.empty()) {
      throw Error(fmt::format("{}: holds no waypoints", path_.string()));
    }
    return std::move(trajectory_);
  }

 private:
  [[nodiscard]] Place place(int column = 1) const { return {path_.string(), line_, column}; }

  void take(std::string_view line) {
    if (line.ends_with('\r')) {
      line.remove_suffix(1);
    }
    if (const std::size_t first = line.find_first_not_of(" \t");
        first == std::string_view::npos || line[first] == '#') {
      return;
    }
    const std::vector<Word> words = is_csv_ ? words_by_comma(line) : words_by_space(line);
    if (columns_.empty()) {
      read_header(words);
      return;
    }
    if (words.size() != columns_.size()) {
      throw Error(fmt::format("has {} values, must have {}: {}", words.size(), columns_.size(), column_names()))
          .at(place());
    }
    add_waypoint(words);
  }

  void read_header(const std::vector<Word>& words) {
    const std::vector<std::string> known(kNames.begin(), kNames.end());
    for (const Word& word : words) {
      const auto name = std::ranges::find(kNames, word.text);
      if (name == kNames.end()) {
        const std::string nearest = suggestion(word.text, known), hint = nearest.empty() ? "." : nearest;
        throw Error(fmt::format("\"{}\" is not a column of a trajectory{} There are {}", printable(word.text), hint,
                                fmt::join(kNames, ", ")))
            .at(place(word.column));
      }
      const auto column = static_cast<Column>(name - kNames.begin());
      if (has(column)) {
        throw Error(fmt::format("{} is given twice", word.text)).at(place(word.column));
      }
      columns_.push_back(column);
    }
    const int quaternion = count({kQw, kQx, kQy, kQz}), radians = count({kRoll, kPitch, kYaw}),
              degrees = count({kRollDeg, kPitchDeg, kYawDeg});
    if (count({kTime, kX, kY, kZ}) < 4 || quaternion % 4 != 0 || radians % 3 != 0 || degrees % 3 != 0 ||
        (quaternion > 0) + (radians > 0) + (degrees > 0) > 1) {
      throw Error(fmt::format("the columns are {}; they must be time, x, y, z and, for the orientation, either qw, qx, "
                              "qy, qz or roll, pitch, yaw [rad] or roll_deg, pitch_deg, yaw_deg",
                              column_names()))
          .at(place());
    }
  }

  void add_waypoint(const std::vector<Word>& words) {
    std::array<double, kColumns> values{};
    for (std::size_t i = 0; i < words.size(); ++i) {
      values[columns_[i]] = number(words[i], kNames[columns_[i]]);
    }
    Waypoint waypoint;
    waypoint.time = values[kTime];
    waypoint.position = {values[kX], values[kY], values[kZ]};
    if (has(kQw)) {
      waypoint.orientation = angles_of(Eigen::Quaterniond(values[kQw], values[kQx], values[kQy], values[kQz]));
    } else if (has(kRollDeg)) {
      waypoint.orientation = {radians_from_degrees(values[kRollDeg]), radians_from_degrees(values[kPitchDeg]),
                              radians_from_degrees(values[kYawDeg])};
    } else {
      waypoint.orientation = {values[kRoll], values[kPitch], values[kYaw]};
    }
    try {
      check_fields("", waypoint);
    } catch (const Error& error) {
      throw error.at(place());
    }
    if (!trajectory_.waypoints.empty() && waypoint.time <= trajectory_.waypoints.back().time) {
      throw Error(fmt::format("time = {:.10g} s must be greater than the one before it, {:.10g} s", waypoint.time,
                              trajectory_.waypoints.back().time))
          .at(place());
    }
    trajectory_.waypoints.push_back(waypoint);
  }

  // Normalises quaternions that were written with few digits.
  [[nodiscard]] Vec3 angles_of(const Eigen::Quaterniond& quaternion) const {
    constexpr double kTolerance = 0.01;
    if (!(std::abs(quaternion.norm() - 1) <= kTolerance)) {
      throw Error(fmt::format("the norm of qw, qx, qy, qz is {:.4g}, must be 1", quaternion.norm())).at(place());
    }
    return rpy_from_orientation(quaternion.normalized());
  }

  [[nodiscard]] double number(const Word& word, std::string_view name) const {
    std::string_view text = word.text;
    if (text.size() > 1 && text.front() == '+' && text[1] != '-') {
      text.remove_prefix(1);
    }
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
      throw Error(fmt::format("{} = \"{}\" must be a number", name, printable(word.text))).at(place(word.column));
    }
    return value;
  }

  [[nodiscard]] bool has(Column column) const { return std::ranges::find(columns_, column) != columns_.end(); }
  [[nodiscard]] int count(std::initializer_list<Column> columns) const {
    return static_cast<int>(std::ranges::count_if(columns, [&](Column column) { return has(column); }));
  }
  [[nodiscard]] std::string column_names() const {
    std::vector<std::string_view> names;
    for (const Column column : columns_) {
      names.push_back(kNames[column]);
    }
    return fmt::format("{}", fmt::join(names, ", "));
  }

  std::filesystem::path path_;
  std::string text_;
  bool is_csv_;
  int line_ = 0;
  std::vector<Column> columns_;
  Trajectory trajectory_;
};

}  // namespace

Trajectory load_trajectory(const std::filesystem::path& path) {
  const std::string ending = ending_of(path);
  if (ending != ".csv" && ending != ".tum" && ending != ".txt") {
    throw Error(fmt::format("{}: is not a trajectory: CSV ends in .csv, TUM in .tum or .txt", path.string()));
  }
  return TrajectoryReader(path).read();
}

}  // namespace insonify
