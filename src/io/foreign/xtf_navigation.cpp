// xtf_navigation.cpp -- latitude, longitude, depth and attitude of XTF pings as poses in a world around the first.

#include "io/foreign/xtf_navigation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <optional>

#include "insonify/printable.h"
#include "insonify/survey/geographic.h"

namespace insonify {
namespace {

constexpr double kFarthest = 1e7;  // Of coordinates [m].

template <typename Number>
double finite_at(std::span<const std::uint8_t> head, std::size_t at) {
  Number number{};
  std::memcpy(&number, head.data() + at, sizeof number);
  return std::isfinite(number) && std::abs(number) <= static_cast<Number>(kFarthest) ? static_cast<double>(number) : 0;
}

// Fills in places that are missing; @return how many.
std::size_t fill_places(std::vector<XtfFix>& fixes) {
  std::size_t missing = 0;
  const auto last = std::ranges::find_if(fixes.rbegin(), fixes.rend(), &XtfFix::has_place);
  const XtfFix* next = last == fixes.rend() ? nullptr : &*last;
  for (auto fix = fixes.rbegin(); fix != fixes.rend() && next != nullptr; ++fix) {
    if (fix->has_place()) {
      next = &*fix;
    } else {
      const double altitude = fix->altitude, sound_speed = fix->sound_speed;
      *fix = *next;
      fix->altitude = altitude;
      fix->sound_speed = sound_speed;
      ++missing;
    }
  }
  return missing;
}

void append_pose(std::vector<double>& numbers, const XtfFix& fix, const Vec3& place) {
  const double yaw = radians_from_degrees(90 - fix.heading);  // x east, y north.
  const Eigen::Quaterniond turn =
      orientation_from_rpy(radians_from_degrees(fix.roll), radians_from_degrees(-fix.pitch), yaw);
  numbers.insert(numbers.end(), {place.x(), place.y(), -fix.depth, turn.w(), turn.x(), turn.y(), turn.z()});
}

}  // namespace

XtfFix xtf_fix(std::span<const std::uint8_t> head) {
  return {.y = finite_at<double>(head, 160),
          .x = finite_at<double>(head, 168),
          .depth = finite_at<float>(head, 192),
          .altitude = finite_at<float>(head, 196),
          .pitch = finite_at<float>(head, 204),
          .roll = finite_at<float>(head, 208),
          .heading = finite_at<float>(head, 212),
          .sound_speed = finite_at<float>(head, 32)};
}

double xtf_sound_speed(const XtfFix& fix) {
  constexpr double kLeast = 1300, kMost = 1700;
  for (const double speed : {fix.sound_speed, 2 * fix.sound_speed}) {
    if (speed >= kLeast && speed <= kMost) {
      return speed;
    }
  }
  return std::numeric_limits<double>::quiet_NaN();
}

void add_navigation(ForeignTables& tables, std::vector<XtfFix> fixes, bool degrees) {
  std::vector<double> sound_speeds;
  std::ranges::transform(fixes, std::back_inserter(sound_speeds), xtf_sound_speed);
  if (std::ranges::any_of(sound_speeds, [](double speed) { return !std::isnan(speed); })) {
    tables.add_numbers("sound_speed", "m/s", 1, std::move(sound_speeds));
  }
  const std::size_t missing = fill_places(fixes);
  const XtfFix& first = fixes.front();
  const GeographicPoint origin{first.y, first.x};
  degrees = degrees && std::abs(first.y) <= 89 && std::abs(first.x) <= 180 && first.has_place();
  const std::optional<LocalGrid> grid = degrees ? std::optional<LocalGrid>(origin) : std::nullopt;
  std::vector<double> poses, altitudes;
  for (const XtfFix& fix : fixes) {
    append_pose(poses, fix, grid ? grid->local({fix.y, fix.x}) : Vec3(fix.x - first.x, fix.y - first.y, 0));
    altitudes.push_back(fix.altitude);
  }
  tables.add_numbers("world_from_sonar", "m m m 1 1 1 1", 7, std::move(poses));
  if (std::ranges::any_of(altitudes, [](double altitude) { return altitude > 0; })) {
    tables.add_numbers("altitude", "m", 1, std::move(altitudes));
  }
  if (degrees) {
    tables.set_attribute("origin", {origin.latitude, origin.longitude});
  }
  if (missing > 0) {
    tables.note(fmt::format("{} without a position: that of the next is taken", counted(missing, "ping")));
  }
}

}  // namespace insonify
