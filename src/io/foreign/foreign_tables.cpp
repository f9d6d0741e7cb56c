// foreign_tables.cpp -- serves tables by the functions that read their rows.

#include "io/foreign/foreign_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>

#include "insonify/error.h"

namespace insonify {
namespace {

std::vector<std::byte> bytes_of_numbers(std::span<const double> numbers) {
  const auto bytes = std::as_bytes(numbers);
  return {bytes.begin(), bytes.end()};
}

}  // namespace

ForeignTables::ForeignTables(std::filesystem::path path, const std::string& format, std::uint64_t ping_count)
    : RecordedTables(std::move(path)) {
  ping_count_ = ping_count;
  attributes_["format"] = format;
}

void ForeignTables::add(const std::string& name, const std::string& type, std::vector<std::uint64_t> row, bool by_ping,
                        const std::string& unit, Read read) {
  tables_.push_back({.name = name,
                     .type = type,
                     .value_bytes = static_cast<std::size_t>(type[2] - '0'),
                     .row = std::move(row),
                     .by_ping = by_ping,
                     .axes = {},
                     .notes = {{"units", unit}}});
  std::ranges::sort(tables_, {}, &RecordedTable::name);
  reads_[name] = std::move(read);
}

void ForeignTables::add_numbers(const std::string& name, const std::string& unit, std::uint64_t width,
                                std::vector<double> numbers) {
  if (find(name) != nullptr || numbers.size() != ping_count_ * width) {
    return;
  }
  std::vector<std::uint64_t> row;
  if (width > 1) {
    row.push_back(width);
  }
  add(name, "<f8", row, true, unit, [width, numbers = std::move(numbers)](std::uint64_t ping) {
    return bytes_of_numbers(std::span<const double>(numbers).subspan(ping * width, width));
  });
}

void ForeignTables::describe(const SonarConfig& sonar) {
  set_attribute("sonar", sonar.name);
  set_attribute("sonar_model", sonar.model);
  set_settings({{"sonar", settings_json(sonar)}, {"receiver", nlohmann::json::object()}});
  const auto add_axis = [&](const char* name, const char* unit, const std::vector<double>& centres) {
    if (find(name) == nullptr) {
      add(name, "<f8", {centres.size()}, false, unit,
          [centres](std::uint64_t) { return bytes_of_numbers(std::span<const double>(centres)); });
    }
  };
  std::vector<double> azimuths, ranges;
  for (int beam = 0; beam < sonar.beam_count; ++beam) {
    azimuths.push_back(sonar.beam_azimuth(beam));
  }
  for (int bin = 0; bin < sonar.bin_count; ++bin) {
    ranges.push_back(sonar.bin_range(bin));
  }
  add_axis("azimuth", "rad", azimuths);
  add_axis("range", "m", ranges);
}

void ForeignTables::set_settings(nlohmann::json settings) {
  settings_ = std::move(settings);
  static constexpr std::array<double, 1> kBegin = {0};
  static constexpr std::array<double, 7> kOrigin = {0, 0, 0, 1, 0, 0, 0};
  if (find("time") == nullptr) {
    add("time", "<f8", {}, true, "s", [](std::uint64_t) { return bytes_of_numbers(std::span<const double>(kBegin)); });
  }
  if (find("world_from_sonar") == nullptr) {
    add("world_from_sonar", "<f8", {kOrigin.size()}, true, "m m m 1 1 1 1",
        [](std::uint64_t) { return bytes_of_numbers(std::span<const double>(kOrigin)); });
  }
}

std::vector<std::byte> ForeignTables::row(const RecordedTable& table, std::uint64_t ping) const {
  return reads_.at(table.name)(ping);
}

void ForeignTables::read(const RecordedTable& table, NumberType /*type: that of the table*/,
                         std::span<const TableSlice> slices, std::span<std::byte> bytes) const {
  read_by_rows(table, slices, bytes);
}

SonarConfig foreign_sonar(const std::string& name, const std::string& model) {
  SonarConfig sonar;
  sonar.name = name;
  sonar.model = model;
  sonar.min_range = 0;
  sonar.azimuth_aperture = kAssumedAperture;
  return sonar;
}

void set_centres(SonarConfig& sonar, const std::vector<double>& centres, ForeignTables& tables) {
  sonar.beam_count = static_cast<int>(centres.size());
  if (centres.size() == 1) {
    sonar.beam_azimuths = centres;
    return;
  }
  const double even = sonar.azimuth_aperture;
  sonar.beam_azimuths = centres;
  const bool falls = std::ranges::adjacent_find(centres, std::less_equal<>()) == centres.end();
  if (falls && sonar.bearings().extent() <= 2 * std::numbers::pi) {
    sonar.azimuth_aperture = sonar.bearings().extent();
    return;
  }
  sonar.beam_azimuths.clear();
  sonar.azimuth_aperture = even;
  tables.assume(fmt::format("its bearings are not those of a fan, {:.4g} deg are assumed", degrees_from_radians(even)));
}

}  // namespace insonify
