// npz_writer.h -- arrays of a NumPy archive, each an entry of a ZIP file.

#pragma once

#include <minizip/zip.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/file/unfinished_file.h"

namespace insonify {

/// A ZIP archive, entry by entry. All functions throw Error if the disk is full.
class ZipWriter {
 public:
  /// @param file  Must outlive this.
  ZipWriter(UnfinishedFile& file, bool compress);
  ~ZipWriter();
  ZipWriter(const ZipWriter&) = delete;
  ZipWriter& operator=(const ZipWriter&) = delete;

  // Begin an entry, write its bytes in parts, and end it.
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

/// Begins the entry of an array; its bytes are to be added, and the entry ended.
/// @param type  NumPy's name: "<f4".
void add_array(ZipWriter& zip, const std::string& name, const std::string& type,
               const std::vector<std::uint64_t>& shape);

/// A list of texts, or one text without axes, as a whole entry.
void add_texts(ZipWriter& zip, const std::string& name, const std::vector<std::string>& texts, bool single);

}  // namespace insonify
