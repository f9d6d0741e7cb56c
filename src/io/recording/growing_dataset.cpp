#include "io/recording/growing_dataset.h"

#include <algorithm>

namespace insonify {
namespace {

// Small rows share a chunk of about this size [bytes]: each chunk costs some fifty bytes of index, and the last one
// takes its full size from its first row on.
constexpr std::uint64_t kSmallChunk = 4096;

// Rows below this are not worth compressing [bytes].
constexpr std::uint64_t kLeastCompressed = 512;

}  // namespace

std::uint64_t GrowingDataset::row_bytes() const {
  std::uint64_t bytes = H5Tget_size(type);
  for (const hsize_t length : row) {
    bytes *= length;
  }
  return bytes;
}

bool GrowingDataset::is_filtered() const {
  return compress && row_bytes() >= kLeastCompressed;
}

std::uint64_t GrowingDataset::chunk_rows() const {
  return is_filtered() ? 1 : std::max<std::uint64_t>(1, kSmallChunk / row_bytes());
}

std::vector<std::uint64_t> GrowingDataset::chunk_shape() const {
  std::vector<std::uint64_t> shape{chunk_rows()};
  shape.insert(shape.end(), row.begin(), row.end());
  return shape;
}

}  // namespace insonify
