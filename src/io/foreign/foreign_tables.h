// foreign_tables.h -- pings that an instrument or another program has stored, as the tables of a recording.

#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "io/file/recorded_tables.h"

namespace insonify {

/// Tables that a reader of one format fills in: `intensity` [ping, bin, beam], then by describe() the axes, times and
/// poses. Attributes tell what the format says besides:
///
/// - `format`: its name for users;
/// - `sonars`: the names of all in the file, where there may be several;
/// - `notes`: what was chosen or left out of the file, a list of texts;
/// - `assumed`: what the file does not say, with the value taken, a list of texts.
class ForeignTables : public RecordedTables {
 public:
  /// Reads the row of a ping; its size is that of the table's rows.
  using Read = std::function<std::vector<std::byte>(std::uint64_t ping)>;

  ForeignTables(std::filesystem::path path, const std::string& format, std::uint64_t ping_count);

  /// Adds a table. `axes` are empty for one without pings.
  void add(const std::string& name, const std::string& type, std::vector<std::uint64_t> row, bool by_ping,
           const std::string& unit, Read read);

  /// Adds a table with `width` numbers for each ping; nothing if there is one of that name, or they are not so many.
  void add_numbers(const std::string& name, const std::string& unit, std::uint64_t width, std::vector<double> numbers);

  /// Sets the sonar and adds azimuth and range, and time and world_from_sonar where they are missing: 0 s, and the
  /// origin of the world.
  void describe(const SonarConfig& sonar);

  /// Only the settings, such as those of a recording that insonify has exported, and times and poses.
  void set_settings(nlohmann::json settings);

  void note(const std::string& text) { attributes_["notes"].push_back(text); }
  void assume(const std::string& text) { attributes_["assumed"].push_back(text); }
  void set_attribute(const std::string& name, nlohmann::json value) { attributes_[name] = std::move(value); }

  [[nodiscard]] nlohmann::json settings() const override { return settings_; }
  [[nodiscard]] std::vector<std::byte> row(const RecordedTable& table, std::uint64_t ping) const override;
  void read(const RecordedTable& table, NumberType type, std::span<const TableSlice> slices,
            std::span<std::byte> bytes) const override;

 private:
  std::map<std::string, Read> reads_;
  nlohmann::json settings_ = nlohmann::json::object();
};

/// A sonar of an instrument: ranges from 0 m on, a fan of kAssumedAperture.
[[nodiscard]] SonarConfig foreign_sonar(const std::string& name, const std::string& model);

/// Sets the beams of a fan by their centres, falling from port [rad]. Where they cannot be those of a fan, evenly
/// spaced beams are assumed over what azimuth_aperture says.
void set_centres(SonarConfig& sonar, const std::vector<double>& centres, ForeignTables& tables);

/// Assumed of files that do not say: the length of a bin [m], the aperture of a fan [rad], sound speed [m/s].
inline constexpr double kAssumedBin = 0.01, kAssumedAperture = 2.0943951023931953, kAssumedSoundSpeed = 1500;

}  // namespace insonify
