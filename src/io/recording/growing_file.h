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
#include "io/recording/chunk_filter.h"
#include "io/recording/chunk_index.h"
#include "io/recording/growing_dataset.h"
#include "io/recording/growing_image.h"
#include "io/recording/hdf5_header.h"

namespace insonify {

struct GrowingFileOptions {
  int threads = 1;       ///< Threads that compress rows; 0 for as many as there are processors.
  bool replace = false;  ///< Whether a file may be there already.
};

/// Datasets of one length in one file; a row of each is a ping. HDF5 makes the file in memory, without rows. From then
/// on plain writes do: of that file, of rows and of the index that says where they are, and of a few bytes that make
/// each new row a part of every dataset at once. So a process that is killed at any moment leaves a file that opens as
/// usual and holds every row whose append() had returned, and no half rows (docs/design/recording.md).
///
/// The file is as large as the rows that it holds; while it grows it ends a few rows later, in a hole.
///
/// It is made beside `path`, as an UnfinishedFile. If nothing is at `path`, it goes there as soon as it is ready for
/// its first row, so that it can be read while it grows. A file that is there already stays until close(), which puts
/// the new one in its place; without close() the new one stays beside it if it has rows.
class GrowingFile {
 public:
  /// Until it is closed no other GrowingFile can take its place (file_lock.h).
  /// @param describe  Called with the open file to add whatever does not grow.
  /// @throws Error with the path when the file cannot be made, or is there and may not be replaced.
  GrowingFile(std::filesystem::path path, const std::vector<GrowingDataset>& datasets,
              const std::function<void(hid_t file)>& describe, const GrowingFileOptions& options = {});
  /// Closes without reporting errors and without replacing an earlier file.
  ~GrowingFile();
  GrowingFile(GrowingFile&& other) noexcept;
  GrowingFile& operator=(GrowingFile&&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// Where the file is now: path(), or beside it until it replaces an earlier file.
  [[nodiscard]] const std::filesystem::path& place() const { return is_beside() ? out_->unfinished() : path_; }
  [[nodiscard]] std::uint64_t count() const { return count_; }

  /// Adds one row to every dataset. `rows` has one entry a dataset, in their order, each of row_bytes().
  /// @throws Error when the disk is full: the file then is what it was before; and when somebody has removed, replaced
  /// or moved the file.
  void append(std::span<const std::span<const std::byte>> rows);

  /// Has the system put everything on the disk, puts the file in its place and closes it; nothing more can be added.
  /// @throws Error when the system could not, or when the file is no longer there.
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
  };

  void find_fields(std::span<const std::byte> image, std::span<const std::uint64_t> headers);
  void set_fields(std::uint64_t count);
  [[nodiscard]] bool is_beside() const { return out_ && !out_->unfinished().empty(); }
  void check_is_there() const;
  [[nodiscard]] bool add_row(Growth& growth, std::uint64_t& end);
  [[nodiscard]] bool write_row(std::span<const std::span<const std::byte>> rows, std::uint64_t& end);
  [[nodiscard]] bool set_end(std::uint64_t end);
  [[nodiscard]] bool reserve(std::uint64_t end);
  [[nodiscard]] bool write_pieces() const;
  [[nodiscard]] bool finish();

  std::filesystem::path path_, absolute_;  // As it was given; absolute path of where the file is.
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
  std::vector<std::byte> fields_bytes_;  // ... the bytes from the first field to the last, as they are there.
};

}  // namespace insonify
