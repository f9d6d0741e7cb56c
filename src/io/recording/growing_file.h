// growing_file.h -- an HDF5 file to which rows are added, and which is whole at every moment.

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "io/file/file_lock.h"
#include "io/file/hdf5.h"
#include "io/file/unfinished_file.h"
#include "io/recording/chunk_index.h"
#include "io/recording/growing_dataset.h"
#include "io/recording/growing_image.h"
#include "io/recording/hdf5_header.h"

namespace insonify {

struct GrowingFileOptions {
  int threads = 1;       ///< Threads that compress rows; 0 for as many as there are processors.
  bool replace = false;  ///< Whether an existing file is replaced.
};

/// Datasets of one length in one file; a row of each is a ping. HDF5 makes the file in memory, without rows. From then
/// on plain writes suffice: of that file, of rows and their index, and of a few bytes that append a new row to every
/// dataset at once. So a process killed at any moment leaves a readable file with every row whose append() had
/// returned, and no partial rows (docs/design/recording.md).
///
/// Chunks have checksums: those of one row with it, those of several small rows once they are full, or at close().
///
/// The file is as large as its rows; while it grows it ends a few rows later, in a hole.
///
/// It is made as an UnfinishedFile beside `path`, and renamed as soon as it is ready for its first row if there is no
/// file at `path`, so that it can be read while it grows. An existing file stays until close() replaces it; without
/// close() the new one stays beside it if it has rows.
class GrowingFile {
 public:
  /// Until it is closed no other GrowingFile can replace it (file_lock.h).
  /// @param describe  Called with the open file to add everything that does not grow.
  /// @throws Error with the path if the file cannot be made, or exists and may not be replaced.
  GrowingFile(std::filesystem::path path, const std::vector<GrowingDataset>& datasets,
              const std::function<void(hid_t file)>& describe, const GrowingFileOptions& options = {});
  /// Closes without reporting errors and without replacing an existing file.
  ~GrowingFile();
  GrowingFile(GrowingFile&& other) noexcept;
  GrowingFile& operator=(GrowingFile&&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// Current path of the file: path(), or a file beside it until it replaces an existing one.
  [[nodiscard]] const std::filesystem::path& place() const { return is_beside() ? out_->unfinished() : path_; }
  [[nodiscard]] std::uint64_t count() const { return count_; }

  /// Adds one row to every dataset. `rows` has one entry per dataset, in order, each of row_bytes().
  /// @throws Error if the disk is full (the file is then unchanged), and if somebody has removed, replaced
  /// or moved the file.
  void append(std::span<const std::span<const std::byte>> rows);

  /// Flushes everything to disk, renames the file to its final path and closes it; nothing can be added afterwards.
  /// @throws Error for a failure of the system, or if the file no longer exists.
  void close();

 private:
  // How one dataset grows.
  struct Growth {
    explicit Growth(const GrowingDataset& dataset);

    std::uint64_t row_bytes, chunk_rows;
    GrowthFields fields = {};
    std::uint64_t chunk = 0, next_chunk = 0;  // Address of the last one, now and with the row that is being added.
    ChunkIndex index, next_index;             // Likewise.
    std::optional<ChunkFilter> filter = {};
    std::span<const std::byte> stored = {};  // The row that is being added, perhaps compressed.
    std::uint32_t checksum = 0;              // The chunk's, where it is of one row.
    std::vector<std::byte> rows = {};        // Those of the last chunk, where it has several.

    // The mask of all filters, which a chunk of several rows skips until it is full.
    [[nodiscard]] std::uint32_t all_filters() const { return filter ? 2 * ChunkFilter::kBoth + 1 : 1; }
  };

  void find_fields(std::span<const std::byte> image, std::span<const std::uint64_t> headers);
  void set_fields(std::uint64_t count);
  [[nodiscard]] bool is_beside() const { return out_ && !out_->unfinished().empty(); }
  void check_is_there() const;
  [[nodiscard]] bool add_row(Growth& growth, std::uint64_t& end);
  [[nodiscard]] bool add_to_rows(Growth& growth, std::uint64_t& end);
  [[nodiscard]] bool seal(Growth& growth, std::uint64_t& end);
  void seal_last_chunks();
  [[nodiscard]] bool write_row(std::span<const std::span<const std::byte>> rows, std::uint64_t& end);
  [[nodiscard]] bool set_end(std::uint64_t end);
  [[nodiscard]] bool reserve(std::uint64_t end);
  [[nodiscard]] bool write_pieces() const;
  [[nodiscard]] bool finish();

  std::filesystem::path path_, absolute_;  // As given; absolute path of the file.
  std::unique_ptr<UnfinishedFile> out_;    // Null when closed.
  std::unique_ptr<WriteMark> earlier_;     // On the file that is to be replaced; null if there was none.
  std::vector<Growth> growths_;
  std::unique_ptr<Workers> workers_;      // Where anything is compressed.
  std::uint64_t count_ = 0;               // Rows.
  std::uint64_t end_ = 0, reserved_ = 0;  // Bytes in use, and where the file ends.

  std::uint64_t state_address_ = 0;            // In the file.
  GrowingState state_ = GrowingState::kWhole;  // That it is ended with.

  FilePieces pieces_;                    // Nodes of indices that are to be written.
  std::uint64_t fields_begin_ = 0;       // In the file, of ...
  std::vector<std::byte> fields_bytes_;  // ... the bytes in the file from the first field to the last.
};

}  // namespace insonify
