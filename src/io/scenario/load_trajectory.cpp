// load_trajectory.cpp -- waypoints from the rows of a text: CSV, TUM, EuRoC, KITTI.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/log_line.h"
#include "base/names.h"
#include "insonify/files.h"
#include "insonify/printable.h"
#include "io/file/input_file.h"
#include "io/scenario/track_columns.h"
#include "io/scenario/track_words.h"

namespace insonify {
namespace {

constexpr std::size_t kKittiNumbers = 12;  // A matrix of 3 x 4, without a time.

class TrajectoryReader {
 public:
  TrajectoryReader(const std::filesystem::path& path, const TrajectoryColumns& given, const Log& log)
      : path_(path), given_(given), log_(log), text_(read_text(path)) {}

  Trajectory read() {
    std::string_view rest = text_;
    rest.remove_prefix(rest.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0);
    while (!rest.empty()) {
      const std::size_t end = std::min(rest.find('\n'), rest.size());
      ++line_;
      std::string_view line = rest.substr(0, end);
      line.remove_suffix(line.ends_with('\r') ? 1 : 0);
      take(line);
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    if (trajectory_.waypoints.empty()) {
      throw Error(fmt::format("{}: holds no waypoints", path_.string()));
    }
    report();
    return std::move(trajectory_);
  }

 private:
  [[nodiscard]] Place place(int column = 1) const { return {path_.string(), line_, column}; }

  void take(std::string_view line) {
    const std::size_t first = line.find_first_not_of(" \t");
    if (first == std::string_view::npos) {
      return;
    }
    if (columns_.empty()) {
      begin(line, line[first] == '#' || line[first] == '%');
    } else if (line[first] != '#') {
      add_waypoint(track_words(line, separator_));
    }
  }

  // The first lines say what the columns are: a header, which may be a comment, or the number of values.
  void begin(std::string_view line, bool is_comment) {
    separator_ = separator_of(line);
    const std::vector<TrackWord> words = track_words(line, separator_);
    std::vector<std::string> texts;
    for (const TrackWord& word : words) {
      texts.push_back(word.text);
    }
    if (is_comment && texts.size() > 1 && texts[0].find_first_not_of("#%") == std::string::npos) {
      texts.erase(texts.begin());  // A mark by itself.
    }
    if (is_comment && !is_track_header(texts)) {
      return;
    }
    if (is_comment || !track_number(texts[0], separator_)) {
      read_header(words, texts);
      return;
    }
    constexpr double kNanoseconds = 1e15;  // No time in seconds is so long.
    if (texts.size() == kKittiNumbers) {
      columns_.resize(kKittiNumbers);
      times_ = kitti_times(path_, log_);
    } else if (track_number(texts[0], separator_) > kNanoseconds) {
      columns_ = euroc_columns();
    } else if (ending_of(path_) == ".csv" && given_.empty()) {
      read_header(words, texts);
      return;
    } else {
      columns_ = tum_columns();
    }
    if (!given_.empty()) {
      throw Error("`columns` needs a header that names the columns of the file").at(place());
    }
    for (std::size_t i = columns_.size(); i < texts.size(); ++i) {
      columns_.push_back({.name = fmt::format("column {}", i + 1)});
    }
    add_waypoint(words);
  }

  void read_header(const std::vector<TrackWord>& words, const std::vector<std::string>& texts) {
    try {
      columns_ = columns_of_header(texts, given_);
    } catch (const Error& error) {
      throw error.at(place());
    }
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const auto is_same = [&](const TrackColumn& other) { return other.number == columns_[i].number; };
      if (columns_[i].number && std::any_of(columns_.begin(), columns_.begin() + static_cast<long>(i), is_same)) {
        throw Error(fmt::format("{} is given twice", kTrackNames[*columns_[i].number])).at(place(words[i].column));
      }
    }
    const int quaternion = count({kQw, kQx, kQy, kQz}), radians = count({kRoll, kPitch, kYaw}),
              degrees = count({kRollDeg, kPitchDeg, kYawDeg});
    if (count({kTime, kX, kY, kZ}) < 4 || quaternion % 4 != 0 || radians % 3 != 0 || degrees % 3 != 0 ||
        (quaternion > 0) + (radians > 0) + (degrees > 0) > 1) {
      throw Error(fmt::format("the columns are {}; they must be time, x, y, z and, for the orientation, either qw, qx, "
                              "qy, qz or roll, pitch, yaw [rad] or roll_deg, pitch_deg, yaw_deg",
                              printable(fmt::format("{}", fmt::join(texts, ", ")), kLongestName)))
          .at(place());
    }
  }

  void add_waypoint(const std::vector<TrackWord>& words) {
    if (words.size() != columns_.size() && !has_spare(words.size())) {
      const char other = separator_of(text_.substr(0, text_.find('\n')));
      throw Error(fmt::format("has {} values, must have {}: {}{}", words.size(), columns_.size(), column_names(),
                              words.size() == 1 && other != separator_ ? "; are they separated otherwise?" : ""))
          .at(place());
    }
    Waypoint waypoint = is_kitti() ? kitti_waypoint(words) : named_waypoint(words);
    try {
      check_fields("", waypoint);
    } catch (const Error& error) {
      throw error.at(place());
    }
    if (!trajectory_.waypoints.empty() && waypoint.time == trajectory_.waypoints.back().time) {
      ++equal_times_;
      return;
    }
    if (!trajectory_.waypoints.empty() && waypoint.time < trajectory_.waypoints.back().time) {
      throw Error(fmt::format("time = {} s must be greater than the one before it, {} s", waypoint.time,
                              trajectory_.waypoints.back().time))
          .at(place());
    }
    trajectory_.waypoints.push_back(waypoint);
  }

  // Whether all numbers are there, though not all columns that are not read.
  [[nodiscard]] bool has_spare(std::size_t count) const {
    return !is_kitti() &&
           std::none_of(columns_.begin() + static_cast<long>(std::min(count, columns_.size())), columns_.end(),
                        [](const TrackColumn& column) { return column.number.has_value(); }) &&
           count < columns_.size();
  }

  [[nodiscard]] bool is_kitti() const { return columns_.size() == kKittiNumbers && count({kTime}) == 0; }

  [[nodiscard]] Waypoint named_waypoint(const std::vector<TrackWord>& words) {
    std::array<double, kNumbers> values{};
    for (std::size_t i = 0; i < words.size(); ++i) {
      if (const auto column = columns_[i].number) {
        values[*column] = number(words[i], kTrackNames[*column]) * columns_[i].factor;
      }
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
      largest_turn_ = std::max(largest_turn_, waypoint.orientation.cwiseAbs().maxCoeff());
    }
    return waypoint;
  }

  [[nodiscard]] Waypoint kitti_waypoint(const std::vector<TrackWord>& words) {
    Eigen::Matrix<double, 3, 4> matrix;
    for (int i = 0; i < static_cast<int>(kKittiNumbers); ++i) {
      matrix(i / 4, i % 4) = number(words[static_cast<std::size_t>(i)], "the matrix");
    }
    const std::size_t row = kitti_rows_++;
    if (!times_.empty() && row >= times_.size()) {
      throw Error(fmt::format("times.txt has {} times, fewer than there are matrices", times_.size())).at(place());
    }
    Waypoint waypoint;
    waypoint.time = times_.empty() ? static_cast<double>(row) * kKittiPeriod : times_[row];
    waypoint.position = matrix.col(3);
    const Eigen::Matrix3d turn = matrix.leftCols<3>();
    constexpr double kTolerance = 0.01;
    if (!((turn * turn.transpose() - Eigen::Matrix3d::Identity()).norm() < kTolerance) || turn.determinant() < 0) {
      throw Error("the matrix does not turn: its rows must be orthogonal, of norm 1").at(place());
    }
    waypoint.orientation = rpy_from_orientation(Eigen::Quaterniond(turn).normalized());
    return waypoint;
  }

  // Normalises quaternions that were written with few digits.
  [[nodiscard]] Vec3 angles_of(const Eigen::Quaterniond& quaternion) const {
    constexpr double kTolerance = 0.01;
    if (!(std::abs(quaternion.norm() - 1) <= kTolerance)) {
      throw Error(fmt::format("the norm of qw, qx, qy, qz is {:.4g}, must be 1", quaternion.norm())).at(place());
    }
    return rpy_from_orientation(quaternion.normalized());
  }

  [[nodiscard]] double number(const TrackWord& word, std::string_view name) const {
    const std::optional<double> value = track_number(word.text, separator_);
    if (!value) {
      throw Error(fmt::format("{} = \"{}\" must be a number", name, printable(word.text))).at(place(word.column));
    }
    return *value;
  }

  void report() const {
    std::vector<std::string> unread;
    const std::vector<std::string> known(kTrackNames.begin(), kTrackNames.end());
    for (const TrackColumn& column : columns_) {
      if (!column.number && !is_kitti()) {
        const bool is_known = std::ranges::count(known, column.name) > 0;  // But `columns` says that it is another.
        const std::string nearest = is_known ? "" : suggestion(column.name, known);  // "; did you mean yaw?"
        unread.push_back(printable(column.name) + (nearest.empty() ? "" : " (" + nearest.substr(2) + ")"));
      }
    }
    if (!unread.empty()) {
      log_line(log_, Severity::kWarning,
               fmt::format("{}: columns that are not read: {}", path_.string(), fmt::join(unread, ", ")));
    }
    constexpr double kMostTurns = 20;  // [rad] A heading that is not wrapped may be beyond one turn.
    if (largest_turn_ > kMostTurns) {
      log_line(log_, Severity::kWarning,
               fmt::format("{}: has an angle of {:.4g} rad; in degrees the columns are roll_deg, pitch_deg, yaw_deg",
                           path_.string(), largest_turn_));
    }
    if (equal_times_ > 0) {
      log_line(log_, Severity::kWarning,
               fmt::format("{}: {} left out, with the time of the one before", path_.string(),
                           counted(equal_times_, "row")));
    }
  }

  [[nodiscard]] bool has(TrackNumber number) const { return count({number}) > 0; }
  [[nodiscard]] int count(std::initializer_list<TrackNumber> numbers) const {
    return static_cast<int>(std::ranges::count_if(columns_, [&](const TrackColumn& column) {
      return column.number && std::ranges::count(numbers, *column.number) > 0;
    }));
  }
  [[nodiscard]] std::string column_names() const {
    std::vector<std::string> names;
    for (const TrackColumn& column : columns_) {
      names.push_back(printable(column.name));
    }
    return is_kitti() ? "a matrix of 3 x 4" : fmt::format("{}", fmt::join(names, ", "));
  }

  std::filesystem::path path_;
  const TrajectoryColumns& given_;
  const Log& log_;
  std::string text_;
  char separator_ = ' ';
  int line_ = 0;
  std::vector<TrackColumn> columns_;
  std::vector<double> times_;  // [row] Times of KITTI's poses [s].
  std::size_t kitti_rows_ = 0, equal_times_ = 0;
  double largest_turn_ = 0;  // [rad]
  Trajectory trajectory_;
};

}  // namespace

Trajectory load_trajectory(const std::filesystem::path& path, const TrajectoryColumns& columns, const Log& log) {
  const std::string ending = ending_of(path);
  if (ending != ".csv" && ending != ".tum" && ending != ".txt" && ending != ".kitti") {
    throw Error(fmt::format("{}: is not a trajectory: CSV ends in .csv, TUM in .tum or .txt, KITTI in .txt or .kitti",
                            path.string()));
  }
  return TrajectoryReader(path, columns, log).read();
}

}  // namespace insonify
