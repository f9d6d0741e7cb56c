// mcap_writer_file.cpp -- writes the parts of an McapWriter's file: metadata, chunks and summary.

#include <fmt/format.h>
#include <unistd.h>
#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <cerrno>
#include <limits>
#include <system_error>

#include "insonify/error.h"
#include "io/file/unfinished_file.h"
#include "io/mcap/mcap_metadata.h"
#include "io/mcap/mcap_writer.h"

namespace insonify {
namespace {

constexpr int kZstdLevel = 1;  // The fastest of the ordinary levels.
constexpr std::string_view kCompression = "zstd";

std::uint32_t crc_of(std::span<const std::byte> bytes, std::uint32_t before = 0) {
  return static_cast<std::uint32_t>(crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

std::vector<std::byte> compressed(std::span<const std::byte> bytes) {
  std::vector<std::byte> result(ZSTD_compressBound(bytes.size()));
  const std::size_t size = ZSTD_compress(result.data(), result.size(), bytes.data(), bytes.size(), kZstdLevel);
  if (ZSTD_isError(size) != 0) {
    throw Error(fmt::format("zstd cannot compress {} bytes: {}", bytes.size(), ZSTD_getErrorName(size)));
  }
  result.resize(size);
  return result;
}

}  // namespace

// Appends to the file.
void McapWriter::write(std::span<const std::byte> bytes) {
  if (!is_still_there(out_->descriptor(), absolute_)) {
    fail("no longer exists: it was removed, moved or replaced while it was being written");
  }
  if (!write_at(out_->descriptor(), written_.bytes, bytes)) {
    const int error = errno;
    const std::string reason = std::generic_category().message(error);
    // No part of it remains.
    [[maybe_unused]] const int cut = ftruncate(out_->descriptor(), static_cast<off_t>(written_.bytes));
    if (error == ENOSPC || error == EDQUOT || error == EFBIG) {
      full_disk_ = reason;
    }
    fail("cannot write: " + reason);
  }
  written_.crc = crc_of(bytes, written_.crc);
  written_.bytes += bytes.size();
}

void McapWriter::put_metadata(const std::string& name, const std::map<std::string, std::string>& texts) {
  McapBytes bytes;
  bytes.record(McapOp::kMetadata, [&] { bytes.put(std::string_view(name), texts); });
  const std::uint64_t start = written_.bytes;
  write(bytes.bytes());
  written_.metadata_indexes.record(McapOp::kMetadataIndex, [&] {
    written_.metadata_indexes.put(start, static_cast<std::uint64_t>(bytes.size()), std::string_view(name));
  });
  ++written_.metadata;
}

// If the disk is full, writes the part of the chunk that fits, and the end of the file.
void McapWriter::write_chunk() {
  if (chunk_index_.empty() || ping_ends_.empty()) {  // Not a part of a ping that could not be added.
    return;
  }
  try {
    write_pings(ping_ends_.size());
  } catch (const Error& error) {
    if (!only_whole_ && !full_disk_.empty()) {
      save_what_fits();
    }
    const bool some = !only_whole_ && written_.messages > 0;
    failure_ = std::make_exception_ptr(
        Error(error.what() + std::string(some ? "; what was written before stays readable" : "")));
    std::rethrow_exception(failure_);
  }
  chunk_.clear();
  chunk_index_.clear();
  ping_ends_.clear();
}

// Entries of the messages within the first `bytes` of the chunk.
std::map<std::uint16_t, std::vector<McapWriter::IndexEntry>> McapWriter::index_up_to(std::size_t bytes) const {
  std::map<std::uint16_t, std::vector<IndexEntry>> index;
  for (const auto& [channel, entries] : chunk_index_) {
    for (const IndexEntry& entry : entries) {
      if (entry.offset < bytes) {
        index[channel].push_back(entry);
      }
    }
  }
  return index;
}

// A chunk of the first pings and its indexes go to the file in one piece.
void McapWriter::write_pings(std::size_t count) {
  const std::span<const std::byte> records = chunk_.bytes().first(ping_ends_[count - 1]);
  const std::map<std::uint16_t, std::vector<IndexEntry>> index = index_up_to(records.size());
  std::uint64_t first = std::numeric_limits<std::uint64_t>::max(), last = 0;
  for (const auto& [channel, entries] : index) {
    for (const IndexEntry& entry : entries) {
      first = std::min(first, entry.time);
      last = std::max(last, entry.time);
    }
  }
  const std::vector<std::byte> packed = compressed(records);
  McapBytes bytes;
  bytes.record(McapOp::kChunk, [&] {
    bytes.put(first, last, static_cast<std::uint64_t>(records.size()), crc_of(records), kCompression,
              static_cast<std::uint64_t>(packed.size()));
    bytes.append(packed);
  });
  const std::size_t chunk_length = bytes.size();
  const std::uint64_t chunk_start = written_.bytes;
  std::map<std::uint16_t, std::uint64_t> offsets;
  for (const auto& [channel, entries] : index) {
    offsets[channel] = chunk_start + bytes.size();
    bytes.record(McapOp::kMessageIndex, [&, id = channel, &list = entries] {
      bytes.put(id, static_cast<std::uint32_t>(list.size() * sizeof(IndexEntry)));
      bytes.append(std::as_bytes(std::span(list)));
    });
  }
  write(bytes.bytes());
  written_.chunk_indexes.record(McapOp::kChunkIndex, [&] {
    written_.chunk_indexes.put(first, last, chunk_start, static_cast<std::uint64_t>(chunk_length));
    written_.chunk_indexes.put_map(offsets);
    written_.chunk_indexes.put(static_cast<std::uint64_t>(bytes.size() - chunk_length), kCompression,
                               static_cast<std::uint64_t>(packed.size()), static_cast<std::uint64_t>(records.size()));
  });
  ++written_.chunks;
  written_.first_time = written_.messages == 0 ? first : std::min(written_.first_time, first);
  written_.last_time = std::max(written_.last_time, last);
  for (const auto& [channel, entries] : index) {
    written_.by_channel[channel] += entries.size();
    written_.messages += entries.size();
  }
}

// As many pings of the chunk as leave room for the end of the file; none if not even that fits.
void McapWriter::save_what_fits() {
  const Written before = written_;
  for (std::size_t count = ping_ends_.size(); count-- > 0;) {
    try {
      if (count > 0) {
        write_pings(count);
      }
      put_metadata(mcap_metadata::kEnd, {{mcap_metadata::kReason, full_disk_}});
      write_summary();
      return;
    } catch (const Error&) {
      written_ = before;
      [[maybe_unused]] const int cut = ftruncate(out_->descriptor(), static_cast<off_t>(before.bytes));
    }
  }
}

void McapWriter::put_statistics(McapBytes& summary) const {
  std::map<std::uint16_t, std::uint64_t> counts = written_.by_channel;
  for (std::size_t i = 0; i < written_channels_; ++i) {
    counts.try_emplace(static_cast<std::uint16_t>(i), 0);
  }
  summary.record(McapOp::kStatistics, [&] {
    summary.put(written_.messages, static_cast<std::uint16_t>(written_schemas_),
                static_cast<std::uint32_t>(written_channels_));
    summary.put(std::uint32_t{0});  // Attachments.
    summary.put(written_.metadata, written_.chunks, written_.first_time, written_.last_time);
    summary.put_map(counts);
  });
}

void McapWriter::write_summary() {
  McapBytes data_end;
  data_end.record(McapOp::kDataEnd, [&] { data_end.put(written_.crc); });
  write(data_end.bytes());

  const std::uint64_t start = written_.bytes;
  McapBytes summary;
  McapBytes offsets;
  const auto group = [&](McapOp op, auto&& put_group) {
    const std::size_t begin = summary.size();
    put_group();
    if (summary.size() > begin) {
      offsets.record(McapOp::kSummaryOffset, [&] {
        offsets.put(static_cast<std::uint8_t>(op), start + begin, static_cast<std::uint64_t>(summary.size() - begin));
      });
    }
  };
  group(McapOp::kSchema, [&] {
    for (std::size_t i = 0; i < written_schemas_; ++i) {
      put_schema(summary, i);
    }
  });
  group(McapOp::kChannel, [&] {
    for (std::size_t i = 0; i < written_channels_; ++i) {
      put_channel(summary, i);
    }
  });
  group(McapOp::kStatistics, [&] { put_statistics(summary); });
  group(McapOp::kChunkIndex, [&] { summary.append(written_.chunk_indexes.bytes()); });
  group(McapOp::kMetadataIndex, [&] { summary.append(written_.metadata_indexes.bytes()); });
  const std::uint64_t offsets_start = start + summary.size();
  summary.append(offsets.bytes());
  // The footer's checksum covers the summary and the footer up to itself.
  McapBytes footer;
  constexpr std::uint64_t kFooterContent = 20;
  footer.put(static_cast<std::uint8_t>(McapOp::kFooter), kFooterContent, start, offsets_start);
  summary.append(footer.bytes());
  summary.put(crc_of(summary.bytes()));
  summary.append(std::as_bytes(std::span(kMcapMagic)));
  write(summary.bytes());
}

}  // namespace insonify
