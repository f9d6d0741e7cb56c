// growing_rows.cpp -- writes a row of every dataset to where no reader looks yet.

#include <algorithm>
#include <bit>
#include <cassert>

#include "io/file/unfinished_file.h"
#include "io/recording/fletcher.h"
#include "io/recording/growing_file.h"

namespace insonify {
namespace {

static_assert(std::endian::native == std::endian::little, "rows are written as they lie in memory");

// Chunks begin at multiples of this, so that a program that maps the file may read them in place.
constexpr std::uint64_t kDataAlignment = 64;

std::span<const std::byte> bytes_of(const std::uint32_t& number) {
  return std::as_bytes(std::span(&number, 1));
}

std::uint64_t aligned(std::uint64_t position) {
  return (position + kDataAlignment - 1) / kDataAlignment * kDataAlignment;
}

}  // namespace

// Ends the file at least one row after `end`, or there if the disk has no more room. HDF5 reads the end of a file when
// it opens it, and looks for the rows a moment later: by then there may be one more, which must lie before that end.
// The unwritten rest takes no space on disk.
bool GrowingFile::reserve(std::uint64_t end) {
  constexpr std::uint64_t kRowsAhead = 3;
  constexpr std::uint64_t kNodes = 4;  // New places of an index with one row more: two on each level that is split.
  std::uint64_t row = 0;
  for (const Growth& growth : growths_) {
    row += growth.chunk_rows * growth.row_bytes + kChecksumBytes + kDataAlignment + kNodes * growth.index.node_bytes();
  }
  return end + row <= reserved_ || set_end(end + kRowsAhead * row) || end <= reserved_ || set_end(end);
}

// Writes a row of one dataset to where nobody looks yet, into the last chunk or into a new one at the end of the file,
// and works out the index with it.
bool GrowingFile::add_row(Growth& growth, std::uint64_t& end) {
  growth.next_chunk = growth.chunk;
  growth.next_index = growth.index;
  if (growth.chunk_rows > 1) {
    return add_to_rows(growth, end);
  }
  const std::uint64_t bytes = growth.stored.size() + kChecksumBytes;
  growth.next_chunk = aligned(end);
  end = growth.next_chunk + bytes;
  const bool smaller = growth.filter && growth.stored.size() < growth.row_bytes;
  growth.next_index.add({.first_row = count_,
                         .address = growth.next_chunk,
                         .bytes = static_cast<std::uint32_t>(bytes),
                         .skipped_filters = growth.filter && !smaller ? ChunkFilter::kBoth : 0},
                        end, pieces_);
  return write_at(out_->descriptor(), growth.next_chunk, growth.stored) &&
         write_at(out_->descriptor(), growth.next_chunk + growth.stored.size(), bytes_of(growth.checksum));
}

// The same for one of several rows of a chunk.
bool GrowingFile::add_to_rows(Growth& growth, std::uint64_t& end) {
  const std::uint64_t row_in_chunk = count_ % growth.chunk_rows;
  if (row_in_chunk == 0) {
    const std::uint64_t bytes = growth.chunk_rows * growth.row_bytes;
    growth.next_chunk = aligned(end);
    end = growth.next_chunk + bytes + kChecksumBytes;
    growth.next_index.add({.first_row = count_,
                           .address = growth.next_chunk,
                           .bytes = static_cast<std::uint32_t>(bytes),
                           .skipped_filters = growth.all_filters()},
                          end, pieces_);
  }
  growth.rows.resize(row_in_chunk * growth.row_bytes);
  growth.rows.insert(growth.rows.end(), growth.stored.begin(), growth.stored.end());
  return write_at(out_->descriptor(), growth.next_chunk + row_in_chunk * growth.row_bytes, growth.stored) &&
         (row_in_chunk + 1 < growth.chunk_rows || seal(growth, end));
}

// Gives the last chunk, of several rows, its checksum, with zeros for rows that it does not have.
bool GrowingFile::seal(Growth& growth, std::uint64_t& end) {
  const std::uint64_t written = growth.rows.size(), bytes = growth.chunk_rows * growth.row_bytes;
  std::vector<std::byte>& chunk = growth.rows;
  chunk.resize(bytes);
  const std::uint32_t checksum = fletcher32(chunk);
  const auto sum = bytes_of(checksum);
  chunk.insert(chunk.end(), sum.begin(), sum.end());
  growth.next_index.change_last(static_cast<std::uint32_t>(chunk.size()), 0, end, pieces_);
  return write_at(out_->descriptor(), growth.next_chunk + written, std::span(chunk).subspan(written));
}

// Where the disk has no room for that, they stay without checksums.
void GrowingFile::seal_last_chunks() {
  std::uint64_t end = end_;
  pieces_.clear();
  const bool sealed = std::ranges::all_of(growths_, [&](Growth& growth) {
    growth.next_chunk = growth.chunk;
    growth.next_index = growth.index;
    growth.rows.resize(count_ % growth.chunk_rows * growth.row_bytes);  // Without one that could not be written.
    return growth.rows.empty() || seal(growth, end);
  });
  if (!sealed || !write_pieces() || (end > reserved_ && !set_end(end))) {
    return;
  }
  set_fields(count_);
  if (write_at(out_->descriptor(), fields_begin_, fields_bytes_)) {
    for (Growth& growth : growths_) {
      std::swap(growth.index, growth.next_index);
    }
    end_ = end;
  }
}

// All of a row, but not yet as part of any dataset.
bool GrowingFile::write_row(std::span<const std::span<const std::byte>> rows, std::uint64_t& end) {
  const auto prepare = [&](int i, int) {
    Growth& growth = growths_[static_cast<std::size_t>(i)];
    growth.stored = rows[static_cast<std::size_t>(i)];
    assert(growth.stored.size() == growth.row_bytes);
    if (growth.filter) {
      const std::span<const std::byte> compressed = growth.filter->compress(growth.stored);
      growth.stored = compressed.empty() ? growth.stored : compressed;
    }
    growth.checksum = growth.chunk_rows == 1 ? fletcher32(growth.stored) : 0;
  };
  if (workers_) {
    workers_->for_each(static_cast<int>(rows.size()), prepare);
  } else {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      prepare(static_cast<int>(i), 0);
    }
  }
  pieces_.clear();
  return std::ranges::all_of(growths_, [&](Growth& growth) { return add_row(growth, end); }) && write_pieces() &&
         reserve(end);
}

}  // namespace insonify
