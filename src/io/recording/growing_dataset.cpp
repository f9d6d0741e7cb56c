// growing_dataset.cpp -- sizes of chunks; shuffles bytes, then compresses them with zlib.

#include "io/recording/growing_dataset.h"

#include <zlib.h>

#include <algorithm>
#include <new>

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

struct ChunkFilter::Deflater {
  z_stream stream = {};
};

void ChunkFilter::End::operator()(Deflater* deflater) const {
  deflateEnd(&deflater->stream);
  delete deflater;
}

ChunkFilter::ChunkFilter(std::size_t element_size) : element_size_(element_size), deflater_(new Deflater) {
  if (deflateInit(&deflater_->stream, kLevel) != Z_OK) {
    throw std::bad_alloc();
  }
}

std::span<const std::byte> ChunkFilter::compress(std::span<const std::byte> values) {
  // All first bytes, then all second bytes ...: those of neighbouring values are more alike than those of one value.
  shuffled_.resize(values.size());
  const std::size_t count = values.size() / element_size_;
  for (std::size_t byte = 0; byte < element_size_; ++byte) {
    for (std::size_t i = 0; i < count; ++i) {
      shuffled_[byte * count + i] = values[i * element_size_ + byte];
    }
  }
  z_stream& stream = deflater_->stream;
  deflateReset(&stream);
  deflated_.resize(values.size());
  stream.next_in = reinterpret_cast<Bytef*>(shuffled_.data());
  stream.avail_in = static_cast<uInt>(shuffled_.size());
  stream.next_out = reinterpret_cast<Bytef*>(deflated_.data());
  stream.avail_out = static_cast<uInt>(deflated_.size());
  if (deflate(&stream, Z_FINISH) != Z_STREAM_END) {
    return {};  // They do not fit into less.
  }
  return {deflated_.data(), deflated_.size() - stream.avail_out};
}

}  // namespace insonify
