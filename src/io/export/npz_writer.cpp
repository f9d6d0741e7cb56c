// npz_writer.cpp -- writes ZIP entries by minizip, and the headers of .npy arrays.

#include "io/export/npz_writer.h"

#include <fmt/format.h>
#include <minizip/ioapi.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

#include "io/export/export_format.h"

namespace insonify {
namespace {

// The header of an .npy array, version 1.0: magic, length, and a Python dictionary of type and shape, filled up to a
// multiple of 64 bytes.
// @param type  NumPy's name: "<f4".
std::string numpy_header(const std::string& type, const std::vector<std::uint64_t>& shape) {
  std::string lengths;
  for (const std::uint64_t length : shape) {
    lengths += fmt::format("{}, ", length);
  }
  std::string text = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}), }}", type, lengths);
  constexpr std::size_t kStart = 10;
  constexpr std::size_t kAlignment = 64;
  text.resize((kStart + text.size() + kAlignment) / kAlignment * kAlignment - kStart, ' ');
  text.back() = '\n';
  std::string header = "\x93NUMPY";
  header += '\1';
  header += '\0';
  header += static_cast<char>(text.size() % 256);
  header += static_cast<char>(text.size() / 256);
  return header + text;
}

}  // namespace

ZipWriter::ZipWriter(UnfinishedFile& file, bool compress) : file_(&file), compress_(compress) {
  zlib_filefunc64_def functions;
  fill_fopen64_filefunc(&functions);
  functions.opaque = &file;
  functions.zopen64_file = [](void* opened, const void*, int) -> void* {
    return fdopen(dup(static_cast<UnfinishedFile*>(opened)->descriptor()), "w+b");
  };
  zip_ = zipOpen2_64("", APPEND_STATUS_CREATE, nullptr, &functions);
  check(zip_ == nullptr ? ZIP_ERRNO : ZIP_OK);
}

ZipWriter::~ZipWriter() {
  if (zip_ != nullptr) {
    zipClose(zip_, nullptr);
  }
}

void ZipWriter::begin(const std::string& name) {
  constexpr uLong kReadableFile = 0100644U << 16U;
  constexpr uLong kMadeByUnix = 3U << 8U | 45U;    // 45: with zip64.
  constexpr uLong kUtf8 = 1U << 11U;               // Flag: names are UTF-8.
  constexpr int kLevel = 1, kRaw = 0, kZip64 = 1;  // Higher levels of compression gain little.
  zip_fileinfo about{};
  about.dosDate = (1U << 5U | 1U) << 16U;  // 1 January 1980: the same bytes at any date.
  about.external_fa = kReadableFile;
  check(zipOpenNewFileInZip4_64(zip_, name.c_str(), &about, nullptr, 0, nullptr, 0, nullptr, compress_ ? Z_DEFLATED : 0,
                                kLevel, kRaw, -MAX_WBITS, DEF_MEM_LEVEL, Z_DEFAULT_STRATEGY, nullptr, 0, kMadeByUnix,
                                kUtf8, kZip64));
}

void ZipWriter::add(std::span<const std::byte> bytes) {
  constexpr std::size_t kPart = std::size_t{1} << 30;  // minizip counts in 32 bits.
  for (; !bytes.empty(); bytes = bytes.subspan(std::min(kPart, bytes.size()))) {
    check(zipWriteInFileInZip(zip_, bytes.data(), static_cast<unsigned>(std::min(kPart, bytes.size()))));
  }
}

void ZipWriter::end() {
  check(zipCloseFileInZip(zip_));
}

void ZipWriter::finish() {
  check(zipClose(std::exchange(zip_, nullptr), nullptr));
  check(fsync(file_->descriptor()));
}

void ZipWriter::check(int error) const {
  if (error != ZIP_OK) {
    file_->fail_by_errno();
  }
}

void add_array(ZipWriter& zip, const std::string& name, const std::string& type,
               const std::vector<std::uint64_t>& shape) {
  zip.begin(name + ".npy");
  const std::string header = numpy_header(type, shape);
  zip.add(std::as_bytes(std::span(header)));
}

void add_texts(ZipWriter& zip, const std::string& name, const std::vector<std::string>& texts, bool single) {
  const UnicodeTable table = unicode_table(texts);
  add_array(zip, name, table.type, single ? std::vector<std::uint64_t>() : std::vector<std::uint64_t>{texts.size()});
  zip.add(table.bytes);
  zip.end();
}

}  // namespace insonify
