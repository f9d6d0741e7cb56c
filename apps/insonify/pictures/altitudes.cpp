// altitudes.cpp -- reads altitudes that an instrument has stored, or works them out of the ground truth.

#include "pictures/altitudes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "console/outcome.h"
#include "insonify/stored_tables.h"

namespace insonify {
namespace {

constexpr double kFarthest = 1e5;  // [m]

std::optional<double> metres_of(const std::string& text) {
  double metres = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), metres);
  const bool whole = error == std::errc() && end == text.data() + text.size();
  return whole && metres > 0 && metres <= kFarthest ? std::optional(metres) : std::nullopt;
}

std::vector<double> stored_altitudes(const RecordedPings& pings, const std::filesystem::path& file) {
  std::vector<double> altitudes;
  for (std::uint64_t ping = 0; ping < pings.ping_count(); ++ping) {
    altitudes.push_back(pings.altitude(ping).value_or(std::nan("")));
  }
  if (std::ranges::all_of(altitudes, [](double altitude) { return std::isnan(altitude); })) {
    throw InputError(fmt::format("{}: --altitude stored: there are none in it", file.string()));
  }
  return altitudes;
}

std::vector<double> true_altitudes(const RecordedPings& pings, const std::filesystem::path& file,
                                   const std::string& sonar) {
  const StoredTables tables(file, sonar);
  const StoredTable* const elevation = tables.find("elevation");
  if (elevation == nullptr) {
    throw InputError(fmt::format(
        "{}: --altitude true: there are no elevations in it; HDF5 recordings of a scenario with ground_truth: labels "
        "have them",
        file.string()));
  }
  const SonarConfig config = pings.sonar_config();
  std::vector<double> altitudes;
  for (std::uint64_t number = 0; number < pings.ping_count(); ++number) {
    Ping ping = pings.ping(number);
    ping.elevation.resize(ping.intensity.size());
    const std::array<TableSlice, 3> slices{{{number, 1}, {0, elevation->shape.at(1)}, {0, elevation->shape.at(2)}}};
    tables.read(*elevation, slices, std::as_writable_bytes(std::span(ping.elevation)));
    altitudes.push_back(altitude_by_truth(ping, config).value_or(std::nan("")));
  }
  return altitudes;
}

}  // namespace

void add_line_options(const Command& command, LineOptions& options) {
  const Check source = {
      [](const std::string& text) -> std::string {
        const bool word = text == "tracked" || text == "stored" || text == "true";
        return word || metres_of(text) ? "" : "must be tracked, stored, true or a height in metres above 0";
      },
      {}};
  command.option("--altitude", "SOURCE", &options.altitude,
                 "Height above the bed: tracked by the first return, stored with each ping, true (ground truth) or "
                 "metres [tracked]",
                 source);
  command.option("--first-return", "DEG", &options.first_return,
                 "Angle below the horizontal of the first return that is tracked, where beams do not reach straight "
                 "down [90]",
                 number_within(above_to(0, 90)));
  command.flag("--normalise,--normalize", &options.normalised, "Take out the mean level at each angle, on each side");
}

BottomTrackOptions bottom_options(const LineOptions& options) {
  BottomTrackOptions bottom;
  if (options.first_return) {
    bottom.first_return_angle = radians_from_degrees(*options.first_return);
  }
  return bottom;
}

std::vector<double> altitudes_of(const LineOptions& options, const RecordedPings& pings,
                                 const std::filesystem::path& file, const std::string& sonar) {
  if (options.altitude == "tracked") {
    return {};
  }
  return options.altitude == "stored" ? stored_altitudes(pings, file)
         : options.altitude == "true" ? true_altitudes(pings, file, sonar)
                                      : std::vector{metres_of(options.altitude).value_or(0)};
}

}  // namespace insonify
