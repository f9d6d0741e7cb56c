// zip_writer.cpp -- records of the zip format (PKWARE's APPNOTE.TXT 6.3): sizes are in zip64 fields throughout.

#include "io/export/zip_writer.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <type_traits>

#include "io/file/write_at.h"

namespace insonify {
namespace {

constexpr std::uint16_t kZipVersion = 45;  // That zip64 needs.
constexpr std::uint16_t kStored = 0, kDeflated = 8;
constexpr std::uint16_t kUtf8 = 1U << 11U;      // Flag: names are UTF-8.
constexpr std::uint16_t kDay = (1U << 5U) | 1;  // 1 January 1980: the same bytes at any date.
constexpr std::uint16_t kInZip64 = 0xffff;
constexpr std::uint32_t kInZip64Size = 0xffffffff;
constexpr int kDeflateLevel = 1;  // Compression level of deflate, 1..9: higher ones gain little.

// Numbers one after the other, little-endian.
class Fields {
 public:
  template <typename Number>
  Fields& put(Number value) {
    static_assert(std::is_unsigned_v<Number>);
    const auto bytes = std::as_bytes(std::span(&value, 1));
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    return *this;
  }
  Fields& put(std::string_view text) {
    const auto bytes = std::as_bytes(std::span(text));
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    return *this;
  }
  [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
};

}  // namespace

ZipWriter::ZipWriter(UnfinishedFile& file, bool compress) : file_(&file), compress_(compress), packed_(1U << 18U) {
  constexpr int kRaw = -MAX_WBITS;  // Without zlib's own header.
  constexpr int kMemory = 8;
  if (deflateInit2(&stream_, kDeflateLevel, Z_DEFLATED, kRaw, kMemory, Z_DEFAULT_STRATEGY) != Z_OK) {
    throw std::bad_alloc();
  }
}

ZipWriter::~ZipWriter() {
  deflateEnd(&stream_);
}

void ZipWriter::put_at(std::uint64_t offset, std::span<const std::byte> bytes) {
  if (!write_at(file_->descriptor(), offset, bytes)) {
    file_->fail_by_errno();
  }
  end_ = std::max(end_, offset + bytes.size());
}

void ZipWriter::begin(const std::string& name) {
  entries_.push_back({.name = name, .offset = end_});
  const Fields zip64 =
      Fields().put(std::uint16_t{1}).put(std::uint16_t{16}).put(std::uint64_t{0}).put(std::uint64_t{0});
  Fields head;
  head.put(std::uint32_t{0x04034b50}).put(kZipVersion).put(kUtf8).put(compress_ ? kDeflated : kStored);
  head.put(std::uint16_t{0}).put(kDay).put(std::uint32_t{0}).put(kInZip64Size).put(kInZip64Size);
  head.put(static_cast<std::uint16_t>(name.size())).put(static_cast<std::uint16_t>(zip64.bytes().size()));
  head.put(std::string_view(name));
  put_at(end_, head.bytes());
  put_at(end_, zip64.bytes());
  deflateReset(&stream_);
}

void ZipWriter::deflate_rest(int flush) {
  int state = Z_OK;
  do {
    stream_.next_out = reinterpret_cast<Bytef*>(packed_.data());
    stream_.avail_out = static_cast<uInt>(packed_.size());
    state = deflate(&stream_, flush);
    const std::size_t count = packed_.size() - stream_.avail_out;
    put_at(end_, std::span(packed_).first(count));
    entries_.back().stored += count;
  } while (stream_.avail_out == 0 || (flush == Z_FINISH && state == Z_OK));
}

void ZipWriter::add(std::span<const std::byte> bytes) {
  Entry& entry = entries_.back();
  entry.crc =
      static_cast<std::uint32_t>(crc32_z(entry.crc, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
  entry.size += bytes.size();
  if (!compress_) {
    put_at(end_, bytes);
    entry.stored += bytes.size();
    return;
  }
  constexpr std::size_t kPart = std::size_t{1} << 30;  // zlib counts in 32 bits.
  for (; !bytes.empty(); bytes = bytes.subspan(std::min(kPart, bytes.size()))) {
    // zlib only reads from it.
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(bytes.data()));
    stream_.avail_in = static_cast<uInt>(std::min(kPart, bytes.size()));
    deflate_rest(Z_NO_FLUSH);
  }
}

void ZipWriter::end() {
  if (compress_) {
    stream_.avail_in = 0;
    deflate_rest(Z_FINISH);
  }
  const Entry& entry = entries_.back();
  constexpr std::uint64_t kCrcField = 14, kNameField = 30, kZip64Head = 4;
  put_at(entry.offset + kCrcField, Fields().put(entry.crc).bytes());
  put_at(entry.offset + kNameField + entry.name.size() + kZip64Head,
         Fields().put(entry.size).put(entry.stored).bytes());
}

void ZipWriter::finish() {
  const std::uint64_t directory = end_;
  for (const Entry& entry : entries_) {
    Fields fields;
    fields.put(std::uint32_t{0x02014b50}).put(kZipVersion).put(kZipVersion).put(kUtf8);
    fields.put(compress_ ? kDeflated : kStored).put(std::uint16_t{0}).put(kDay).put(entry.crc);
    fields.put(kInZip64Size).put(kInZip64Size).put(static_cast<std::uint16_t>(entry.name.size()));
    fields.put(std::uint16_t{28}).put(std::uint16_t{0}).put(std::uint16_t{0}).put(std::uint16_t{0});
    constexpr std::uint32_t kReadableFile = 0100644U << 16U;
    fields.put(kReadableFile).put(kInZip64Size).put(std::string_view(entry.name));
    fields.put(std::uint16_t{1}).put(std::uint16_t{24}).put(entry.size).put(entry.stored).put(entry.offset);
    put_at(end_, fields.bytes());
  }
  const std::uint64_t end_of_directory = end_;
  const std::uint64_t count = entries_.size();
  Fields fields;
  fields.put(std::uint32_t{0x06064b50}).put(std::uint64_t{44}).put(kZipVersion).put(kZipVersion);
  fields.put(std::uint32_t{0}).put(std::uint32_t{0}).put(count).put(count);
  fields.put(end_of_directory - directory).put(directory);
  fields.put(std::uint32_t{0x07064b50}).put(std::uint32_t{0}).put(end_of_directory).put(std::uint32_t{1});
  fields.put(std::uint32_t{0x06054b50}).put(std::uint16_t{0}).put(std::uint16_t{0}).put(kInZip64).put(kInZip64);
  fields.put(kInZip64Size).put(kInZip64Size).put(std::uint16_t{0});
  put_at(end_, fields.bytes());
  if (fsync(file_->descriptor()) != 0) {
    file_->fail_by_errno();
  }
}

}  // namespace insonify
