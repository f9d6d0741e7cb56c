// mcap_tables.h -- presents an MCAP recording as the tables of an HDF5 recording.

#pragma once

#include "io/file/recorded_tables.h"
#include "io/file/sounding_columns.h"
#include "io/mcap/mcap_pings.h"

namespace insonify {

/// Tables `intensity`, `time`, `world_from_sonar`, `head_angle` of a scanning sonar, those of the soundings of a
/// multibeam, and the axes; the names of the
/// scene's instances and materials if the file has them, but no ground truth, which is not in messages. Attributes and
/// settings come from the file's metadata.
class McapTables : public RecordedTables {
 public:
  /// @throws Error as McapPings does.
  McapTables(const std::filesystem::path& path, const std::string& sonar);

  /// Those of the sonar and its receiver.
  [[nodiscard]] nlohmann::json settings() const override;
  [[nodiscard]] SonarConfig sonar_config() const override { return pings_.source().sonar; }
  [[nodiscard]] ReceiverConfig receiver_config() const override { return pings_.source().receiver; }
  [[nodiscard]] std::vector<std::byte> row(const RecordedTable& table, std::uint64_t ping) const override;
  void read(const RecordedTable& table, NumberType type, std::span<const TableSlice> slices,
            std::span<std::byte> bytes) const override;

 private:
  void add_tables();
  void add_names();
  [[nodiscard]] std::span<const SoundingColumn> columns() const;

  McapPings pings_;
};

/// Metadata of the run: version, model, engine, seed, and the text of the scenario.
/// @throws Error with the path for a file not made by insonify.
[[nodiscard]] nlohmann::json mcap_run_facts(const McapReader& file, const std::filesystem::path& path);

/// Description of a sonar's levels: "levels from -100 to -40 dB in steps of 0.00092 dB ...".
[[nodiscard]] std::string levels_text(const MessageLevels& levels, int bits);

}  // namespace insonify
