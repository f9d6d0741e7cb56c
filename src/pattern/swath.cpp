// swath.cpp -- swaths of sonars, and the spacing of lines.

#include "pattern/swath.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "insonify/error.h"

namespace insonify {

std::optional<double> half_swath(const SonarConfig& sonar, double altitude) {
  if (!sonar.is_side_scan() && !sonar.is_multibeam()) {
    return std::nullopt;
  }
  const double reach = std::sqrt(std::max(0.0, sonar.max_range * sonar.max_range - altitude * altitude));
  return sonar.is_multibeam() ? std::min(reach, altitude * std::tan(0.5 * sonar.azimuth_aperture)) : reach;
}

const SonarConfig* swath_sonar(std::span<const SonarConfig> sonars) {
  const auto first =
      std::ranges::find_if(sonars, [](const SonarConfig& sonar) { return half_swath(sonar, 0).has_value(); });
  return first == sonars.end() ? nullptr : &*first;
}

namespace {

double spacing_by_overlap(const SurveyLines& lines, std::span<const SonarConfig> sonars) {
  const SonarConfig* sonar = swath_sonar(sonars);
  if (sonar == nullptr) {
    throw Error(
        "pattern.lines", "overlap",
        fmt::format(" = {:.4g} needs a sonar with a swath on both sides (type sss or mbes); give spacing instead",
                    *lines.overlap));
  }
  const double half = *half_swath(*sonar, *lines.altitude + sonar->position.z());
  if (!(half > 0)) {
    throw Error("pattern.lines", "altitude",
                fmt::format(" = {:.4g} m leaves {} no swath: its max_range is {:.4g} m", *lines.altitude, sonar->name,
                            sonar->max_range));
  }
  return 2 * half * (1 - *lines.overlap);
}

}  // namespace

double line_spacing(const SurveyLines& lines, std::span<const SonarConfig> sonars) {
  constexpr double kMostLines = 10'000;
  if (lines.width == 0) {
    return 1;
  }
  const double spacing = lines.overlap ? spacing_by_overlap(lines, sonars) : *lines.spacing;
  if (!(lines.width / spacing <= kMostLines)) {
    throw Error("pattern.lines", "width",
                fmt::format(" = {:.7g} m holds {:.4g} lines {:.4g} m apart; at most {:.0f}", lines.width,
                            std::ceil(lines.width / spacing), spacing, kMostLines));
  }
  return spacing;
}

}  // namespace insonify
