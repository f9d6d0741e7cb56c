// growing_dataset.h -- a dataset that grows ping by ping: its layout, and compression of its chunks.

#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "io/file/hdf5.h"

namespace insonify {

/// A dataset that grows along its first axis. Its chunks have checksums (fletcher32).
struct GrowingDataset {
  std::string name;              ///< At the root of the file.
  hid_t type = H5I_INVALID_HID;  ///< Type of one value in the file, such as H5T_IEEE_F32LE.
  std::vector<hsize_t> row;      ///< Shape of one row; empty for a single value.
  bool compress = false;         ///< Whether rows of at least 512 bytes are compressed.

  [[nodiscard]] std::uint64_t row_bytes() const;

  /// Rows per chunk. A compressed chunk has a single row, since a chunk is compressed as a whole.
  [[nodiscard]] std::uint64_t chunk_rows() const;
  [[nodiscard]] std::vector<std::uint64_t> chunk_shape() const;
  [[nodiscard]] bool is_filtered() const;
};

/// Compresses the chunks of one dataset, in a form that every HDF5 library reads.
class ChunkFilter {
 public:
  /// As in a dataset's filter pipeline: shuffle is filter 0, deflate filter 1; fletcher32 follows them.
  static constexpr unsigned kBoth = 3;

  /// Level of deflate. Higher levels cost much time and save little (docs/design/recording.md).
  static constexpr int kLevel = 1;

  /// @param element_size  [bytes]
  explicit ChunkFilter(std::size_t element_size);

  /// Allocates nothing for as many bytes as before.
  /// @return  The compressed bytes, valid until the next call; none if they would not be fewer.
  [[nodiscard]] std::span<const std::byte> compress(std::span<const std::byte> values);

 private:
  struct Deflater;
  struct End {
    void operator()(Deflater* deflater) const;
  };
  std::size_t element_size_;
  std::vector<std::byte> shuffled_, deflated_;
  std::unique_ptr<Deflater, End> deflater_;
};

}  // namespace insonify
