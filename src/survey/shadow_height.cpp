// shadow_height.cpp -- similar triangles between sonar, top of an object and end of its shadow.

#include "insonify/survey/shadow_height.h"

#include <fmt/format.h>

#include <cmath>

#include "insonify/error.h"
#include "survey/checks.h"

namespace insonify {
namespace {

double on_bed(double slant, double altitude) {
  return std::sqrt(slant * slant - altitude * altitude);
}

}  // namespace

double height_from_shadow(double altitude, double begin, double end) {
  check_altitude(altitude);
  if (!(begin > altitude) || !(end >= begin) || !std::isfinite(end)) {
    throw Error(
        fmt::format("a shadow from {} m to {} m of slant range must begin beyond the altitude, {} m, and end "
                    "behind its beginning",
                    begin, end, altitude));
  }
  return altitude * (1 - on_bed(begin, altitude) / on_bed(end, altitude));
}

double height_from_highlight(double altitude, double top, double end) {
  check_altitude(altitude);
  if (!(top > 0) || !(end >= top) || !(end > altitude) || !std::isfinite(end)) {
    throw Error(
        fmt::format("a highlight at {} m and a shadow that ends at {} m: the end must lie behind the highlight "
                    "and beyond the altitude, {} m",
                    top, end, altitude));
  }
  return altitude * (end - top) / end;
}

double shadow_length(double altitude, double height, double ground_range) {
  check_altitude(altitude);
  if (!(height >= 0) || !(height < altitude)) {
    throw Error(fmt::format("height = {} m must be at least 0 m and less than the altitude, {} m", height, altitude));
  }
  if (!(ground_range > 0) || !std::isfinite(ground_range)) {
    throw Error(fmt::format("ground_range = {} m must be greater than 0 m", ground_range));
  }
  return height * ground_range / (altitude - height);
}

}  // namespace insonify
