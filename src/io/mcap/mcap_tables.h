// mcap_tables.h -- an MCAP recording of insonify's as the tables that an HDF5 recording of the same sonar has.

#pragma once

#include "io/file/recorded_tables.h"
#include "io/mcap/mcap_pings.h"

namespace insonify {

/// Tables `intensity`, `time`, `world_from_sonar`, `head_angle` of a scanning sonar, and the axes; the names of the
/// scene's instances and materials, where the file has them, but no ground truth, which messages do not tell.
/// Attributes and settings are those that the file's metadata have.
class McapTables : public RecordedTables {
 public:
  /// @throws Error as McapPings does.
  McapTables(const std::filesystem::path& path, const std::string& sonar);

  /// Those of the sonar and its receiver.
  [[nodiscard]] nlohmann::json settings() const override;
  [[nodiscard]] std::vector<std::byte> row(const RecordedTable& table, std::uint64_t ping) const override;
  void read(const RecordedTable& table, NumberType type, std::span<const TableSlice> slices,
            std::span<std::byte> bytes) const override;

 private:
  void add_tables();
  void add_names();

  McapPings pings_;
};

/// What the metadata of the run tell: version, model, engine, seed, and the text of the scenario.
/// @throws Error with the path for a file that insonify has not made.
[[nodiscard]] nlohmann::json mcap_run_facts(const McapReader& file, const std::filesystem::path& path);

/// How a sonar's levels are told: "levels from -100 to -40 dB in steps of 0.00092 dB ...".
[[nodiscard]] std::string levels_text(const MessageLevels& levels, int bits);

}  // namespace insonify
