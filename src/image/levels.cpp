// levels.cpp -- what is displayed: counts, or intensities that cover many decades, with gain over range and full scale.

#include <fmt/format.h>

#include <algorithm>

#include "insonify/error.h"
#include "insonify/picture.h"

namespace insonify {

void Display::validate() const {
  check_fields("display", *this);
}

Ping raised_by_range(Ping ping, const SonarConfig& sonar, double decibels_per_decade) {
  for (int bin = 0; bin < ping.bin_count; ++bin) {
    const auto gain = static_cast<float>(std::pow(sonar.bin_range(bin), decibels_per_decade / 10));
    const auto row = ping.intensity.begin() + static_cast<std::ptrdiff_t>(ping.index(bin, 0));
    std::for_each(row, row + ping.beam_count, [gain](float& intensity) { intensity *= gain; });
  }
  return ping;
}

Display usual_display(EchoModel model, const ReceiverConfig& receiver) {
  Display display;
  if (model == EchoModel::kCalibrated) {
    const bool raised = receiver.time_varied_gain || !receiver.gain_ranges.empty();
    display.scale = Scale::kDecibel;
    display.of_source = true;
    display.raised_per_decade = raised ? 0 : kShownGainPerDecade;
  }
  return display;
}

Display counts_display(const SonarConfig& sonar) {
  Display display;
  display.of_counts = true;
  display.full_scale = (1 << sonar.bits) - 1;
  return display;
}

Ping counts_as_intensities(Ping ping) {
  if (ping.counts.size() != ping.intensity.size()) {
    throw Error(fmt::format("ping {} has no counts; receiver.counts: true adds them (calibrated)", ping.number));
  }
  std::ranges::copy(ping.counts, ping.intensity.begin());
  return ping;
}

std::vector<float> intensities_to_fit(const Ping& ping, const SonarConfig& sonar) {
  int first = 0;
  while (first < ping.bin_count && sonar.bin_range(first) < sonar.dead_range) {
    ++first;
  }
  const std::size_t begin = first < ping.bin_count ? ping.index(first, 0) : 0;
  return {ping.intensity.begin() + static_cast<std::ptrdiff_t>(begin), ping.intensity.end()};
}

double fitting_full_scale(std::vector<float> intensities) {
  std::erase_if(intensities, [](float value) { return !(value > 0); });
  if (intensities.empty()) {
    return 1;
  }
  constexpr double kMostBeyondDb = 25;  // So that the main lobe of a point is brighter than its side lobes.
  const double most_beyond = std::pow(10, kMostBeyondDb / 10);
  const double loudest = *std::ranges::max_element(intensities);
  const auto last = intensities.begin() + static_cast<std::ptrdiff_t>((intensities.size() - 1) * 999 / 1000);
  std::ranges::nth_element(intensities, last);
  return std::pow(10.0, std::ceil(2 * std::log10(std::max(double{*last}, loudest / most_beyond))) / 2);
}

}  // namespace insonify
