// track_columns.cpp -- names and units that programs give the columns of trajectories.

#include "io/scenario/track_columns.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <numbers>

#include "base/names.h"
#include "insonify/error.h"
#include "insonify/printable.h"
#include "io/file/xml_file.h"

namespace insonify {
namespace {

struct Unit {
  std::string_view name;
  double factor;  // To SI.
};
constexpr Unit kTrackUnits[] = {{"s", 1},
                                {"ms", 1e-3},
                                {"us", 1e-6},
                                {"ns", 1e-9},
                                {"m", 1},
                                {"cm", 1e-2},
                                {"mm", 1e-3},
                                {"km", 1e3},
                                {"ft", 0.3048},
                                {"rad", 1},
                                {"deg", std::numbers::pi / 180}};

// "p_RS_R_x [m]" gives "p_rs_r_x" and "m".
struct NameAndUnit {
  std::string name, unit;
};
NameAndUnit split_name(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of("#% \t"), text.size()));
  const std::size_t open = std::min(text.find_first_of("[("), text.size());
  const std::size_t close = std::min(text.find_first_of("])", open), text.size());
  return {lower_case(without_outer_space(text.substr(0, open))),
          open < text.size() ? without_outer_space(text.substr(open + 1, close - open - 1)) : ""};
}

std::optional<TrackNumber> number_named(const std::string& name) {
  static const std::map<std::string_view, TrackNumber> kOthers = {
      {"timestamp", kTime}, {"stamp", kTime}, {"t", kTime},      {"secs", kTime},
      {"sec", kTime},       {"w", kQw},       {"heading", kYaw}, {"heading_deg", kYawDeg}};
  if (const auto* found = std::ranges::find(kTrackNames, name); found != kTrackNames.end()) {
    return static_cast<TrackNumber>(found - kTrackNames.begin());
  }
  if (const auto found = kOthers.find(name); found != kOthers.end()) {
    return found->second;
  }
  constexpr std::string_view kPositions[] = {"p_rs_r_", "position_", "position.", "pos_", "p_", "p", "t", "t_"};
  constexpr std::string_view kTurns[] = {"q_rs_", "orientation_", "orientation.", "quaternion_", "quat_", "q_"};
  const char axis = name.empty() ? ' ' : name.back();
  const std::string start = name.substr(0, std::max<std::size_t>(name.size(), 1) - 1);
  if (axis >= 'x' && axis <= 'z' && std::ranges::count(kPositions, start) > 0) {
    return static_cast<TrackNumber>(kX + (axis - 'x'));
  }
  if ((axis == 'w' || (axis >= 'x' && axis <= 'z')) && std::ranges::count(kTurns, start) > 0) {
    return axis == 'w' ? kQw : static_cast<TrackNumber>(kQx + (axis - 'x'));
  }
  return std::nullopt;
}

// A roll in degrees is roll_deg.
TrackColumn column_of(TrackNumber number, const std::string& unit, double sign, const std::string& name) {
  if (number >= kRoll && number <= kYaw && unit == "deg") {
    return {static_cast<TrackNumber>(number + (kRollDeg - kRoll)), sign, name};
  }
  const auto* found = std::ranges::find(kTrackUnits, unit, &Unit::name);
  if (unit.empty() || unit == "1" || number >= kRollDeg) {
    return {number, sign, name};
  }
  if (found == std::end(kTrackUnits)) {
    throw Error(fmt::format("\"{}\" is not a unit of {}; there are s, ms, us, ns, m, cm, mm, km, ft, rad, deg",
                            printable(unit), kTrackNames[number]));
  }
  return {number, sign * found->factor, name};
}

std::vector<TrackColumn> numbered(const std::vector<TrackNumber>& numbers) {
  std::vector<TrackColumn> columns;
  for (const TrackNumber number : numbers) {
    columns.push_back({number, 1, std::string(kTrackNames[number])});
  }
  return columns;
}

}  // namespace

std::vector<TrackColumn> tum_columns() {
  return numbered({kTime, kX, kY, kZ, kQx, kQy, kQz, kQw});
}

std::vector<TrackColumn> euroc_columns() {
  std::vector<TrackColumn> columns = numbered({kTime, kX, kY, kZ, kQw, kQx, kQy, kQz});
  columns[0].factor = 1e-9;
  return columns;
}

std::vector<TrackColumn> columns_of_header(const std::vector<std::string>& header, const TrajectoryColumns& given) {
  std::vector<TrackColumn> columns(header.size());
  const auto is_given = [&](TrackNumber number) { return given.contains(std::string(kTrackNames[number])); };
  for (std::size_t i = 0; i < header.size(); ++i) {
    const auto [name, unit] = split_name(header[i]);
    columns[i].name = name;
    if (const auto number = number_named(name); number && !is_given(*number)) {
      columns[i] = column_of(*number, unit, 1, name);
    }
  }
  for (const auto& [number_name, wanted] : given) {
    const auto* number = std::ranges::find(kTrackNames, number_name);
    if (number == kTrackNames.end()) {
      throw Error(fmt::format("\"{}\" is not a number of a waypoint; there are {}", printable(number_name),
                              fmt::join(kTrackNames, ", ")));
    }
    const std::string name = split_name(wanted.name.empty() ? number_name : wanted.name).name;
    const auto found = std::ranges::find_if(
        header, [&](const std::string& word) { return split_name(word).name == name || word == wanted.name; });
    if (found == header.end()) {
      throw Error(fmt::format("there is no column \"{}\" for {}; there are {}", printable(wanted.name), number_name,
                              printable(fmt::format("{}", fmt::join(header, ", ")), kLongestName)));
    }
    const std::string unit = wanted.unit.empty() ? split_name(*found).unit : wanted.unit;
    columns[static_cast<std::size_t>(found - header.begin())] =
        column_of(static_cast<TrackNumber>(number - kTrackNames.begin()), unit, wanted.sign, name);
  }
  return columns;
}

bool is_track_header(const std::vector<std::string>& words) {
  const auto names = [&](TrackNumber number) {
    return std::ranges::any_of(words,
                               [&](const std::string& word) { return number_named(split_name(word).name) == number; });
  };
  return names(kTime) && names(kX) && names(kY);
}

}  // namespace insonify
