// growing_dataset.h -- layout of a dataset that grows ping by ping.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/file/hdf5.h"

namespace insonify {

/// A dataset that grows along its first axis.
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

}  // namespace insonify
