// recorded_tables.h -- all contents of one sonar's recording by name, independent of its format.

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "insonify/receiver_config.h"
#include "insonify/sonar_config.h"
#include "insonify/stored_tables.h"

namespace insonify {

/// A table of numbers in a recording.
struct RecordedTable {
  std::string name;
  std::string type;                ///< Type of a value, as NumPy spells it: "<f4", "<c8", "<u2", "|u1", "<f8".
  std::size_t value_bytes = 0;     ///< [bytes]
  std::vector<std::uint64_t> row;  ///< Shape of one ping's row, or of the whole table if it has no pings.
  bool by_ping = false;            ///< Whether it has a row for each ping.
  std::vector<std::string> axes;   ///< Names of all axes; may be empty.
  nlohmann::json notes;            ///< `units`, `description`, `none`.
  bool checked = false;            ///< Whether it has checksums.

  [[nodiscard]] std::size_t row_bytes() const {
    return std::accumulate(row.begin(), row.end(), value_bytes, std::multiplies<>());
  }
};

/// A list of texts in a recording.
struct RecordedNames {
  std::string name;
  std::vector<std::string> texts;
};

/// A configuration as in recordings: words as texts, angles in radians, parts as objects; without absent members.
[[nodiscard]] nlohmann::json settings_json(ConstSettings settings);

/// The tables of one sonar, read on demand.
class RecordedTables {
 public:
  explicit RecordedTables(std::filesystem::path path) : path_(std::move(path)) {}
  virtual ~RecordedTables() = default;
  RecordedTables(const RecordedTables&) = delete;
  RecordedTables& operator=(const RecordedTables&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] const std::vector<RecordedTable>& tables() const { return tables_; }
  [[nodiscard]] const std::vector<RecordedNames>& names() const { return names_; }

  /// The table of that name; null if there is none.
  [[nodiscard]] const RecordedTable* find(const std::string& name) const;
  /// @throws Error if there is none.
  [[nodiscard]] const RecordedTable& table(const std::string& name) const;

  /// Number of pings in all tables.
  [[nodiscard]] std::uint64_t ping_count() const { return ping_count_; }

  /// Facts about the run and its sonar: an object of texts and numbers.
  [[nodiscard]] const nlohmann::json& attributes() const { return attributes_; }

  /// A text attribute; "" if it is missing.
  [[nodiscard]] std::string text(const std::string& attribute) const {
    const auto found = attributes_.find(attribute);
    return found != attributes_.end() && found->is_string() ? found->get<std::string>() : "";
  }

  /// State of an HDF5 file, a GrowingState; absent in files of old versions. Not in attributes(), since it does not
  /// describe the run.
  [[nodiscard]] std::optional<std::uint64_t> state() const { return state_; }

  /// The settings of the run, as nested objects; {} if there are none.
  [[nodiscard]] virtual nlohmann::json settings() const = 0;

  /// The settings of the sonar and of its receiver. Missing ones have their defaults.
  /// @throws Error with the path if there are none, or one is of the wrong type or out of its limits.
  [[nodiscard]] virtual SonarConfig sonar_config() const;
  [[nodiscard]] virtual ReceiverConfig receiver_config() const;

  /// One row of a table by ping, or a whole table without pings, little-endian.
  /// @param ping  Below ping_count(); 0 for tables without pings.
  [[nodiscard]] virtual std::vector<std::byte> row(const RecordedTable& table, std::uint64_t ping) const = 0;

  /// Reads a block of a table, row-major.
  /// @param type    Type to convert to; for complex numbers kFloat32, with the parts as the last axis.
  /// @param slices  One for each axis, inside the table.
  /// @param bytes   Receives the values: product of the counts times size_of(type).
  virtual void read(const RecordedTable& table, NumberType type, std::span<const TableSlice> slices,
                    std::span<std::byte> bytes) const = 0;

  /// All that is known without reading a table, for a process that reads them in another.
  [[nodiscard]] nlohmann::json summary() const;

 protected:
  /// read() for tables of types that NumberType has, by way of whole rows.
  void read_by_rows(const RecordedTable& table, std::span<const TableSlice> slices, std::span<std::byte> bytes) const;

  std::filesystem::path path_;
  std::vector<RecordedTable> tables_;
  std::vector<RecordedNames> names_;
  std::uint64_t ping_count_ = 0;
  nlohmann::json attributes_ = nlohmann::json::object();
  std::optional<std::uint64_t> state_;
};

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RecordedTable, name, type, value_bytes, row, by_ping, axes, notes, checked)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RecordedNames, name, texts)

}  // namespace insonify
