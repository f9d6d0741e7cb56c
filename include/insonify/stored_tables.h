// stored_tables.h -- reads blocks of any table of a recording (HDF5, MCAP): intensity, ground truth, axes, names.

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace insonify {

/// Type of a table's numbers, as returned by StoredTables::read().
enum class NumberType { kFloat32, kFloat64, kUint8, kUint16, kInt64 };

/// Size of a number [bytes].
[[nodiscard]] std::size_t size_of(NumberType type);

/// A table of numbers in a recording. docs/reference/recording.md lists those that insonify writes.
struct StoredTable {
  std::string name;                        ///< "instance"
  NumberType type = NumberType::kFloat32;  ///< Type in the file, or the next larger one.
  std::vector<std::uint64_t> shape;        ///< Length of each axis, at least one axis.
  bool by_ping = false;                    ///< Whether the first axis is the ping.
  std::string unit, description;           ///< "": unknown.
};

/// The values `start`, `start + step` ... of an axis, `count` of them.
struct TableSlice {
  std::uint64_t start = 0;
  std::uint64_t count = 0;
  std::uint64_t step = 1;  ///< >= 1.
};

/// The tables of one sonar's recording, read on demand: those at the root of an HDF5 file; of an MCAP
/// file intensity, time, world_from_sonar, head_angle of a scanning sonar, soundings of a multibeam, and the axes. MCAP
/// has no ground truth.
///
/// A recording that is still being written has the pings that all tables had when it was opened.
class StoredTables {
 public:
  /// @param sonar  Name of the sonar; "" for the only one.
  /// @throws Error with the path for a file that is missing or not a recording, and for an unknown sonar.
  explicit StoredTables(const std::filesystem::path& path, const std::string& sonar = "");
  ~StoredTables();
  StoredTables(StoredTables&&) noexcept;
  StoredTables& operator=(StoredTables&&) noexcept;

  /// Tables of numbers, in alphabetical order.
  [[nodiscard]] const std::vector<StoredTable>& tables() const;

  /// The table of that name, or null.
  [[nodiscard]] const StoredTable* find(const std::string& name) const;

  /// Reads a block of a table, row-major, and nothing else (compressed files and MCAP: only its
  /// chunks).
  /// @param slices  One for each axis.
  /// @param bytes   Receives the values: product of the counts times size_of(table.type).
  /// @throws Error with the path if a slice exceeds the table or the file cannot be read.
  void read(const StoredTable& table, std::span<const TableSlice> slices, std::span<std::byte> bytes) const;

  /// A list of texts, such as instance_names; empty if the file does not have it.
  [[nodiscard]] std::vector<std::string> texts(const std::string& name) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace insonify
