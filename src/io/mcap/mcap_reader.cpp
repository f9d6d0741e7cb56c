// mcap_reader.cpp -- follows the records of the data section; chunks are unpacked when a message of theirs is read.

#include "io/mcap/mcap_reader.h"

#include <fmt/format.h>
#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <cstring>
#include <span>

#include "insonify/error.h"
#include "io/file/input_file.h"
#include "io/mcap/mcap_bytes.h"

namespace insonify {
namespace {

constexpr std::uint64_t kMostUnpacked = std::uint64_t{1}
                                        << 30;  // Most bytes of a chunk; more would be a broken length [bytes].

// Numbers and texts of a record, one after the other.
class Fields {
 public:
  explicit Fields(std::span<const std::byte> bytes) : bytes_(bytes) {}

  template <typename Number>
  Number get() {
    Number value{};
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return value;
  }
  std::string text() {
    const auto bytes = take(get<std::uint32_t>());
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }
  std::map<std::string, std::string> texts() {
    Fields inner(take(get<std::uint32_t>()));
    std::map<std::string, std::string> found;
    while (!inner.bytes_.empty()) {
      std::string key = inner.text();
      found[key] = inner.text();
    }
    return found;
  }
  std::span<const std::byte> take(std::uint64_t count) {
    if (count > bytes_.size()) {
      throw Error("a record is shorter than what it holds");
    }
    const auto taken = bytes_.first(count);
    bytes_ = bytes_.subspan(count);
    return taken;
  }
  [[nodiscard]] std::size_t left() const { return bytes_.size(); }

 private:
  std::span<const std::byte> bytes_;
};

}  // namespace

McapReader::McapReader(const std::filesystem::path& path) : path_(path) {
  check_input_file(path);
  file_.rdbuf()->pubsetbuf(nullptr, 0);  // Else each head of a record would cost 8 KB.
  file_.open(path, std::ios::binary);
  size_ = std::filesystem::file_size(path);
  if (const auto start = size_ < kMcapMagic.size() ? std::vector<std::byte>() : bytes_at(0, kMcapMagic.size());
      start.empty() || std::memcmp(start.data(), kMcapMagic.data(), kMcapMagic.size()) != 0) {
    fail("is no MCAP file");
  }
  try {
    read_records();
    if (!chunks_.empty()) {
      read_channels();
    }
  } catch (const Error& error) {
    fail(error.what());
  }
}

void McapReader::fail(const std::string& what) const {
  throw Error(what.starts_with(path_.string()) ? what : fmt::format("{}: {}", path_.string(), what));
}

std::vector<std::byte> McapReader::bytes_at(std::uint64_t place, std::uint64_t count) const {
  if (place > size_ || count > size_ - place) {
    fail("ends too early");
  }
  std::vector<std::byte> bytes(count);
  file_.clear();
  file_.seekg(static_cast<std::streamoff>(place));
  if (!file_.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(count))) {
    fail("cannot be read");
  }
  return bytes;
}

// The head of a chunk of `length` bytes at `at`.
void McapReader::read_chunk(std::uint64_t at, std::uint64_t length) {
  constexpr std::uint64_t kChunkHead = 8 + 8 + 8 + 4 + 4 + 4 + 8;  // With a compression of four letters.
  const std::vector<std::byte> bytes = bytes_at(at, std::min(length, kChunkHead));
  Fields fields(bytes);
  Chunk chunk;
  (void)fields.take(16);  // Times.
  chunk.size = fields.get<std::uint64_t>();
  chunk.crc = fields.get<std::uint32_t>();
  const std::string compression = fields.text();
  if (compression != "zstd") {
    fail(fmt::format("its chunks are compressed by \"{}\", not by zstd as insonify does", compression));
  }
  chunk.packed = fields.get<std::uint64_t>();
  chunk.at = at + kChunkHead;
  if (chunk.packed != length - kChunkHead || chunk.size > kMostUnpacked) {
    fail("has a chunk of another length than it says");
  }
  chunks_.push_back(chunk);
}

// Where the messages of a channel are in the last chunk.
void McapReader::read_index(const std::vector<std::byte>& bytes) {
  Fields fields(bytes);
  if (chunks_.empty()) {
    fail("has an index before its first chunk");
  }
  std::vector<Entry>& entries = entries_[fields.get<std::uint16_t>()];
  for (std::uint32_t count = fields.get<std::uint32_t>() / 16; count > 0; --count) {
    const auto time = fields.get<std::uint64_t>();
    entries.push_back({time, chunks_.size() - 1, fields.get<std::uint64_t>()});
  }
}

// Up to the end of the data, or of what a killed run has written.
void McapReader::read_records() {
  for (std::uint64_t at = kMcapMagic.size(); at + kMcapRecordHead <= size_;) {
    const std::vector<std::byte> start = bytes_at(at, kMcapRecordHead);
    Fields head(start);
    const auto op = static_cast<McapOp>(head.get<std::uint8_t>());
    const auto length = head.get<std::uint64_t>();
    at += kMcapRecordHead;
    if (length > size_ - at) {
      return;
    }
    if (op == McapOp::kDataEnd) {
      const auto end = bytes_at(size_ - kMcapMagic.size(), kMcapMagic.size());
      whole_ = std::memcmp(end.data(), kMcapMagic.data(), kMcapMagic.size()) == 0;
      return;
    }
    if (op == McapOp::kChunk) {
      read_chunk(at, length);
    } else if (op == McapOp::kMessageIndex) {
      read_index(bytes_at(at, length));
    } else if (op == McapOp::kMetadata) {
      const std::vector<std::byte> bytes = bytes_at(at, length);
      Fields fields(bytes);
      const std::string name = fields.text();
      metadata_[name] = fields.texts();
    }
    at += length;
  }
}

// Schemas and channels are at the start of the first chunk.
void McapReader::read_channels() {
  Fields records(unpacked(0));
  while (records.left() >= kMcapRecordHead) {
    const auto op = static_cast<McapOp>(records.get<std::uint8_t>());
    Fields fields(records.take(records.get<std::uint64_t>()));
    if (op == McapOp::kSchema) {
      const auto id = fields.get<std::uint16_t>();
      schemas_[id] = fields.text();
    } else if (op == McapOp::kChannel) {
      const auto id = fields.get<std::uint16_t>();
      const auto schema = fields.get<std::uint16_t>();
      channels_[id] = fields.text();
      topics_[channels_[id]] = schemas_[schema];
    }
  }
}

const std::vector<McapReader::Entry>& McapReader::messages(const std::string& topic) const {
  static const std::vector<Entry> kNone;
  for (const auto& [id, name] : channels_) {
    if (name == topic) {
      const auto found = entries_.find(id);
      return found == entries_.end() ? kNone : found->second;
    }
  }
  return kNone;
}

const std::vector<std::byte>& McapReader::unpacked(std::size_t index) const {
  if (unpacked_chunk_ != index) {
    const Chunk& chunk = chunks_.at(index);
    const std::vector<std::byte> packed = bytes_at(chunk.at, chunk.packed);
    unpacked_chunk_ = static_cast<std::size_t>(-1);
    if (ZSTD_getFrameContentSize(packed.data(), packed.size()) != chunk.size) {
      fail(fmt::format("chunk {} is damaged", index));
    }
    unpacked_.resize(chunk.size);
    const std::size_t size = ZSTD_decompress(unpacked_.data(), unpacked_.size(), packed.data(), packed.size());
    if (size != chunk.size ||
        crc32_z(0, reinterpret_cast<const Bytef*>(unpacked_.data()), unpacked_.size()) != chunk.crc) {
      fail(fmt::format("chunk {} is damaged", index));
    }
    unpacked_chunk_ = index;
  }
  return unpacked_;
}

std::vector<std::byte> McapReader::read(const Entry& entry) const {
  constexpr std::uint64_t kFields = 22;  // Bytes of a message before its data: channel, sequence, two times.
  const std::vector<std::byte>& records = unpacked(entry.chunk);
  try {
    if (entry.offset > records.size()) {
      fail("has an index that leads beyond its chunk");
    }
    Fields fields(std::span<const std::byte>(records).subspan(entry.offset));
    (void)fields.get<std::uint8_t>();
    Fields message(fields.take(fields.get<std::uint64_t>()));
    (void)message.take(kFields);
    const auto data = message.take(message.left());
    return {data.begin(), data.end()};
  } catch (const Error& error) {
    fail(error.what());
  }
}

}  // namespace insonify
