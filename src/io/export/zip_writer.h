// zip_writer.h -- writes a zip archive by minizip, entry by entry, each of any size (zip64).

#pragma once

#include <minizip/zip.h>

#include <cstddef>
#include <span>
#include <string>

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
  void check(int error) const;

  UnfinishedFile* file_;
  bool compress_;
  zipFile zip_;
};

}  // namespace insonify
