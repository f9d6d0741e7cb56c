// growing_file.h -- an HDF5 file to which rows are added, and which is whole at every moment.

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "io/file/hdf5.h"
#include "io/recording/hdf5_header.h"

namespace insonify {

/// A dataset that grows along its first axis.
struct GrowingDataset {
  std::string name;              ///< At the root of the file.
  hid_t type = H5I_INVALID_HID;  ///< Of one value as it is stored, H5T_IEEE_F32LE or the like.
  std::vector<hsize_t> row;      ///< Shape of one row; empty for a single value.

  [[nodiscard]] std::uint64_t row_bytes() const;
};

/// Datasets of one length in one file; a row of each is a ping. HDF5 makes the file in memory, with room for all rows.
/// From then on plain writes do: of that file, of rows, and of a few bytes that make each new row a part of every
/// dataset at once. So a process that is killed at any moment leaves a file that opens as usual and holds every row
/// whose append() had returned, and no half rows (docs/design/recording.md).
///
/// The file takes space on the disk only as rows come, but its size is that of all rows from the start.
class GrowingFile {
 public:
  /// Makes the file beside `path` and puts it there once it is complete: a file of that name is replaced whole or not
  /// at all. Until it is closed no other GrowingFile can replace it (file_lock.h).
  /// @param capacity  Rows it has room for, >= 1.
  /// @param describe  Called with the open file to add whatever does not grow.
  /// @throws Error with the path when the file cannot be made.
  GrowingFile(std::filesystem::path path, std::vector<GrowingDataset> datasets, std::uint64_t capacity,
              const std::function<void(hid_t file)>& describe);
  /// Closes, saying nothing.
  ~GrowingFile();
  GrowingFile(GrowingFile&& other) noexcept;
  GrowingFile& operator=(GrowingFile&&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::uint64_t count() const { return count_; }
  [[nodiscard]] std::uint64_t capacity() const { return capacity_; }

  /// Adds one row to every dataset. `rows` has one entry a dataset, in their order, each of row_bytes().
  /// @throws Error when it is full or the disk is: the file then is what it was before; and when somebody has removed,
  /// replaced or moved the file.
  void append(std::span<const std::span<const std::byte>> rows);

  /// Has the system put everything on the disk and closes the file; nothing more can be added.
  /// @throws Error when the system could not, or when the file is no longer there.
  void close();

 private:
  void find_fields(std::span<const std::byte> image);
  std::uint64_t place_rows(std::span<std::byte> image);
  void set_count(std::uint64_t count);
  void check_is_there() const;
  [[nodiscard]] bool write_at(std::uint64_t offset, std::span<const std::byte> bytes) const;

  std::filesystem::path path_, place_;  // As it was given, and absolute.
  std::vector<GrowingDataset> datasets_;
  std::uint64_t capacity_ = 0, count_ = 0;
  int file_ = -1;

  std::vector<std::uint64_t> addresses_;  // Of each dataset's object header, then ...
  std::vector<std::uint64_t> data_;       // ... of its first row, in the file [bytes].
  std::vector<GrowthFields> fields_;
  std::uint64_t fields_begin_ = 0;       // In the file, of ...
  std::vector<std::byte> fields_bytes_;  // ... the bytes from the first field to the last, as they are there.
};

}  // namespace insonify
