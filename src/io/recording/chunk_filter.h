// chunk_filter.h -- compresses chunks as HDF5's filters shuffle and deflate do.

#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace insonify {

/// Compresses the chunks of one dataset, in a form that every HDF5 library reads.
class ChunkFilter {
 public:
  /// As in a dataset's filter pipeline: shuffle is filter 0, deflate filter 1.
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
