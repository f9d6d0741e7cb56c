// load_sound_speed_profile.cpp -- points of a sound-speed profile from the rows of a text: CSV, CARIS, Kongsberg.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "base/log_line.h"
#include "base/names.h"
#include "insonify/printable.h"
#include "insonify/sound_speed_files.h"
#include "io/file/input_file.h"
#include "io/file/xml_file.h"
#include "io/scenario/track_words.h"
#include "io/scenario/yaml_read.h"

namespace insonify {
namespace {

enum CastNumber { kDepth, kSpeed, kTemperature, kSalinity };

// A number of a cast: its name here, others that programs give its column, and those of its unit.
struct CastColumn {
  std::string_view name;
  std::array<std::string_view, 8> names;
  std::array<std::string_view, 8> units;
};
constexpr CastColumn kCastColumns[] = {
    {"depth", {"depth", "z", "depth_m"}, {"m"}},
    {"sound_speed",
     {"sound_speed", "speed", "sound speed", "sound velocity", "sound_velocity", "sv", "c", "velocity"},
     {"m/s", "m s^-1", "m s-1", "m/sec"}},
    {"temperature_c", {"temperature_c", "temperature", "temp", "t"}, {"degc", "c", "deg c", "°c", "celsius"}},
    {"salinity", {"salinity", "sal", "s", "practical salinity"}, {"psu", "pss", "pss-78", "ppt", "g/kg", "1"}}};

template <typename List>
bool lists(const List& list, std::string_view text) {
  return !text.empty() && std::ranges::find(list, text) != list.end();
}

class CastReader {
 public:
  CastReader(const std::filesystem::path& path, const Log& log) : path_(path), log_(log), text_(read_text(path)) {}

  std::vector<ProfilePoint> read() {
    std::string_view rest = text_;
    rest.remove_prefix(rest.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0);
    while (!rest.empty()) {
      const std::size_t end = std::min(rest.find('\n'), rest.size());
      ++line_;
      std::string_view line = rest.substr(0, end);
      line.remove_suffix(line.ends_with('\r') ? 1 : 0);
      if (const std::size_t first = line.find_first_not_of(" \t"); first != std::string_view::npos) {
        take(line, line[first]);
      }
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    if (points_.empty()) {
      throw Error(fmt::format("{}: holds no points of a sound-speed profile", path_.string()));
    }
    if (announced_ && *announced_ != points_.size()) {
      throw Error(fmt::format("has {} of the {} points that its first line says: the file is not whole", points_.size(),
                              *announced_))
          .at(place());
    }
    return std::move(points_);
  }

 private:
  [[nodiscard]] Place place(int column = 1) const { return {path_.string(), line_, column}; }

  void take(std::string_view line, char first) {
    if (first == '(' && columns_.empty()) {
      begin_kongsberg(line);
    } else if (first == '[' && columns_.empty()) {
      begin_caris(line);
    } else if (line.starts_with("Section") && is_caris_) {
      begin_section();
    } else if (first == '#' || (is_caris_ && sections_ == 0)) {
      return;  // A comment; the name that CARIS writes on its second line.
    } else if (columns_.empty()) {
      begin_columns(line);
    } else {
      add_point(track_words(line, separator_));
    }
  }

  void begin_caris(std::string_view line) {
    if (!lower_case(std::string(line)).starts_with("[svp_version_2]")) {
      throw Error(fmt::format("\"{}\" must be [SVP_VERSION_2]", printable(std::string(line), kLongestName)))
          .at(place());
    }
    is_caris_ = true;
    two_columns();
  }

  void begin_section() {
    if (++sections_ > 1) {
      throw Error("a second section begins here; a profile has one: give each cast a file of its own").at(place());
    }
  }

  // "( SoundVelocity 1.0 0 201203212242 22.5 -156.5 -1 0 0 MVS01_00000 P 0035 )"; the number of points is last.
  void begin_kongsberg(std::string_view line) {
    const std::vector<TrackWord> words = track_words(line, ' ');
    if (words.size() < 2 || words[1].text != "SoundVelocity") {
      throw Error("must begin with ( SoundVelocity").at(place());
    }
    if (words.back().text != ")") {
      throw Error("must end with )").at(place(words.back().column));
    }
    const std::string& last = words[words.size() - 2].text;
    std::size_t count = 0;
    const auto [end, error] = std::from_chars(last.data(), last.data() + last.size(), count);
    if (error == std::errc() && end == last.data() + last.size()) {
      announced_ = count;
    }
    two_columns();
  }

  void two_columns() {
    columns_ = {kDepth, kSpeed};
    more_columns_ = true;
  }

  // A header; or, but for CSV, the first of two columns of numbers.
  void begin_columns(std::string_view line) {
    separator_ = separator_of(line);
    const std::vector<TrackWord> words = track_words(line, separator_);
    if (ending_of(path_) != ".csv" && track_number(words[0].text, separator_)) {
      two_columns();
      add_point(words);
      return;
    }
    std::vector<std::string> names, unread;
    for (const TrackWord& word : words) {
      columns_.push_back(column_of(word));
      names.push_back(printable(word.text));
      if (!columns_.back()) {
        unread.push_back(names.back());
      }
    }
    if (!has(kDepth) || (!has(kSpeed) && !(has(kTemperature) && has(kSalinity)))) {
      throw Error(fmt::format("the columns are {}; they must be depth and speed, or depth, temperature and salinity",
                              printable(fmt::format("{}", fmt::join(names, ", ")), kLongestName)))
          .at(place());
    }
    if (!unread.empty()) {
      log_line(log_, Severity::kWarning,
               fmt::format("{}: columns that are not read: {}", path_.string(), fmt::join(unread, ", ")));
    }
  }

  // "Depth [m]" is the depth. Temperature and salinity beside a speed are not read.
  [[nodiscard]] std::optional<CastNumber> column_of(const TrackWord& word) const {
    const std::size_t open = std::min(word.text.find_first_of("[("), word.text.size());
    const std::size_t close = std::min(word.text.find_first_of("])", open), word.text.size());
    const std::string name = lower_case(without_outer_space(word.text.substr(0, open)));
    const std::string unit =
        open < close ? lower_case(without_outer_space(word.text.substr(open + 1, close - open - 1))) : "";
    for (int number = kDepth; number <= kSalinity; ++number) {
      const CastColumn& column = kCastColumns[number];
      if (!lists(column.names, name)) {
        continue;
      }
      if (!unit.empty() && !lists(column.units, unit)) {
        throw Error(fmt::format("{} in \"{}\" must be in {}", column.name, printable(unit), column.units[0]))
            .at(place(word.column));
      }
      if (has(static_cast<CastNumber>(number))) {
        throw Error(fmt::format("{} is given twice", column.name)).at(place(word.column));
      }
      return static_cast<CastNumber>(number);
    }
    return std::nullopt;
  }

  [[nodiscard]] bool has(CastNumber number) const {
    return std::ranges::find(columns_, std::optional(number)) != columns_.end();
  }

  void add_point(const std::vector<TrackWord>& words) {
    if (words.size() < columns_.size() || (words.size() > columns_.size() && !more_columns_)) {
      throw Error(fmt::format("has {}, must have {}", counted(words.size(), "value"), columns_.size())).at(place());
    }
    ProfilePoint point;
    int depth_column = 1;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (columns_[i]) {
        depth_column = *columns_[i] == kDepth ? words[i].column : depth_column;
        set(*columns_[i], words[i], point);
      }
    }
    with_place(place(), [&] { point.validate(""); });
    if (!points_.empty() && !(point.depth > points_.back().depth)) {
      throw Error(fmt::format("depth = {:.10g} m must be greater than the one before it, {:.10g} m", point.depth,
                              points_.back().depth))
          .at(place(depth_column));
    }
    check_gradient(point);
    points_.push_back(point);
  }

  void check_gradient(const ProfilePoint& point) const {
    if (points_.empty()) {
      return;
    }
    const double gradient = (point.speed() - points_.back().speed()) / (point.depth - points_.back().depth);
    if (std::abs(gradient) > kSteepestProfile) {
      throw Error(
          fmt::format("sound speed changes by {:.4g} m/s in each metre from the row before; must be at most {} m/s",
                      gradient, kSteepestProfile))
          .at(place());
    }
  }

  void set(CastNumber number, const TrackWord& word, ProfilePoint& point) const {
    const std::optional<double> value = track_number(word.text, separator_);
    if (!value) {
      throw Error(fmt::format("{} = \"{}\" must be a number", kCastColumns[number].name, printable(word.text)))
          .at(place(word.column));
    }
    if (number == kDepth) {
      point.depth = *value;
    } else if (number == kSpeed) {
      point.sound_speed = *value;
    } else {
      (number == kTemperature ? point.temperature_c : point.salinity) = *value;
    }
  }

  std::filesystem::path path_;
  const Log& log_;
  std::string text_;
  char separator_ = ' ';
  int line_ = 0, sections_ = 0;
  bool is_caris_ = false;
  bool more_columns_ = false;  // Whether a row may have more values than columns_.
  std::vector<std::optional<CastNumber>> columns_;
  std::optional<std::size_t> announced_;  // Number of points by the first line.
  std::vector<ProfilePoint> points_;
};

}  // namespace

std::vector<ProfilePoint> load_sound_speed_profile(const std::filesystem::path& path, const Log& log) {
  const std::string ending = ending_of(path);
  if (ending != ".csv" && ending != ".svp" && ending != ".asvp") {
    throw Error(fmt::format("{}: is not a sound-speed profile: CSV ends in .csv, CARIS in .svp, Kongsberg in .asvp",
                            path.string()));
  }
  return CastReader(path, log).read();
}

}  // namespace insonify
