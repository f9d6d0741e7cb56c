// zip_writer.h -- writes a zip archive, entry by entry, each of any size (zip64).
// Why not libminizip: docs/design/libraries.md.

#pragma once

#include <zlib.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/file/unfinished_file.h"

namespace insonify {

class ZipWriter {
 public:
  /// @param file  Must outlive this.
  ZipWriter(UnfinishedFile& file, bool compress);
  ~ZipWriter();
  ZipWriter(const ZipWriter&) = delete;
  ZipWriter& operator=(const ZipWriter&) = delete;

  /// Begin an entry, write its bytes in parts, and end it. All throw Error if the disk is full.
  void begin(const std::string& name);
  void add(std::span<const std::byte> bytes);
  void end();

  /// Writes the archive's directory and flushes everything to disk.
  void finish();

 private:
  struct Entry {
    std::string name;
    std::uint64_t offset = 0, stored = 0, size = 0;  // [bytes]
    std::uint32_t crc = 0;
  };
  void put_at(std::uint64_t offset, std::span<const std::byte> bytes);
  void deflate_rest(int flush);

  UnfinishedFile* file_;
  bool compress_;
  std::uint64_t end_ = 0;
  std::vector<Entry> entries_;
  z_stream stream_ = {};
  std::vector<std::byte> packed_;
};

}  // namespace insonify
