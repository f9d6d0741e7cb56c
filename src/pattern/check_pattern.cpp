// check_pattern.cpp -- SurveyPattern::validate(): what a survey needs to be told, and what is told twice.

#include <fmt/format.h>

#include "insonify/error.h"
#include "insonify/pattern.h"

namespace insonify {
namespace {

// Checks that one of two keys is given.
void check_one_of(const std::string& object, std::string_view key, bool has_key, std::string_view other, bool has_other,
                  std::string_view what) {
  if (has_key && has_other) {
    throw Error(object, key, fmt::format(" and {} both say {}; leave one out", other, what),
                {member_name(object, other)});
  }
  if (!has_key && !has_other) {
    throw Error(object, "", fmt::format(" must have {} or {}: {}", key, other, what));
  }
}

void check_point(const std::string& object, std::string_view key, const std::vector<double>& point) {
  if (!point.empty() && point.size() != 2) {
    throw Error(object, key, fmt::format(" has {} numbers, must have two: [x, y]", point.size()));
  }
}

}  // namespace

void SurveyPattern::validate(std::string_view object) const {
  check_fields(object, *this);
  const std::string name = member_name(object, "lines");
  check_point(name, "center", lines.center);
  check_point(name, "corner", lines.corner);
  check_one_of(name, "center", !lines.center.empty(), "corner", !lines.corner.empty(), "where the area is");
  check_one_of(name, "altitude", lines.altitude.has_value(), "height", lines.height.has_value(),
               "how high the vehicle is");
  if (lines.width > 0) {
    check_one_of(name, "spacing", lines.spacing.has_value(), "overlap", lines.overlap.has_value(),
                 "how far lines are apart");
  }
  if (lines.overlap && lines.height) {
    throw Error(name, "overlap", " needs altitude, since the swath depends on it; with height give spacing");
  }
}

}  // namespace insonify
