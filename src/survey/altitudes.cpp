// altitudes.cpp -- completes lists of altitudes.

#include "survey/altitudes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "insonify/error.h"
#include "survey/checks.h"

namespace insonify {

std::vector<double> altitudes_for_all(const std::vector<double>& given, std::size_t pings, const SonarConfig& sonar) {
  if (given.size() != 1 && given.size() != pings) {
    throw Error(fmt::format("{}: there are {} altitudes for {} pings; there must be one for all or one for each",
                            sonar.name, given.size(), pings));
  }
  const auto known = std::ranges::find_if(given, [](double altitude) { return !std::isnan(altitude); });
  double altitude = known == given.end() ? std::nan("") : *known;
  std::vector<double> altitudes;
  for (std::size_t ping = 0; ping < pings; ++ping) {
    const double own = given[given.size() == 1 ? 0 : ping];
    altitude = std::isnan(own) ? altitude : own;
    check_altitude(altitude);
    altitudes.push_back(altitude);
  }
  return altitudes;
}

std::vector<double> usable_altitudes(std::vector<double> tracked, const SonarConfig& sonar) {
  std::ranges::for_each(tracked, [&](double& altitude) { altitude = std::max(altitude, sonar.bin_length()); });
  return tracked;
}

}  // namespace insonify
