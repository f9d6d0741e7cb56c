// recorded_tables.h -- everything that an HDF5 recording holds, by name: tables, lists of names, attributes, settings.

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "io/file/hdf5.h"

namespace insonify {

/// A table of numbers at the root of a recording.
struct RecordedTable {
  std::string name;
  std::string type;                ///< Of a value, as NumPy spells it: "<f4", "<c8", "<u2", "|u1", "<f8".
  std::size_t value_bytes = 0;     ///< [bytes]
  std::vector<std::uint64_t> row;  ///< Shape of a ping's row; of a table without pings, its whole shape.
  bool by_ping = false;            ///< Whether it has a row for each ping.
  std::vector<std::string> axes;   ///< Names of all axes; may be empty.
  nlohmann::json notes;            ///< `units`, `description`, `none`.

  [[nodiscard]] std::size_t row_bytes() const;
};

/// A list of texts at the root of a recording.
struct RecordedNames {
  std::string name;
  std::vector<std::string> texts;
};

class RecordedTables {
 public:
  /// @throws Error with the path for a file that is missing, is not HDF5 or has no dataset `intensity`.
  explicit RecordedTables(const std::filesystem::path& path);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// The open file.
  [[nodiscard]] hid_t file() const { return file_.get(); }
  [[nodiscard]] const std::vector<RecordedTable>& tables() const { return tables_; }
  [[nodiscard]] const std::vector<RecordedNames>& names() const { return names_; }

  /// Pings that all tables have.
  [[nodiscard]] std::uint64_t ping_count() const { return ping_count_; }

  /// Attributes of the file: an object of texts and numbers.
  [[nodiscard]] const nlohmann::json& attributes() const { return attributes_; }
  /// The group `settings`, as nested objects; {} where there is none.
  [[nodiscard]] nlohmann::json settings() const;
  /// An attribute that is a text; "" where it is missing.
  [[nodiscard]] std::string text(const std::string& attribute) const;

  /// One row of a table by ping, or a whole other table, little-endian.
  /// @param ping  Below ping_count(); of other tables 0.
  [[nodiscard]] std::vector<std::byte> row(const RecordedTable& table, std::uint64_t ping) const;

 private:
  void add_table(const std::string& name);

  std::filesystem::path path_;
  H5Handle file_;
  std::vector<RecordedTable> tables_;
  std::vector<RecordedNames> names_;
  std::uint64_t ping_count_ = 0;
  nlohmann::json attributes_;
};

}  // namespace insonify
