// zip_archive.h -- entries of a ZIP archive, each unpacked as a whole. By minizip.

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace insonify {

class ZipArchive {
 public:
  /// Lists the entries.
  /// @throws Error with the path for what is not a whole archive, and for more than 10 000 entries.
  explicit ZipArchive(const std::filesystem::path& path);
  ~ZipArchive();
  ZipArchive(const ZipArchive&) = delete;
  ZipArchive& operator=(const ZipArchive&) = delete;

  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }

  /// The first bytes of an entry, at most `most`.
  [[nodiscard]] std::string head(const std::string& name, std::size_t most) const;

  /// An entry behind its first `skip` bytes, which must hold `count` bytes; its checksum is compared.
  /// @throws Error with the path and its name.
  [[nodiscard]] std::vector<std::byte> read(const std::string& name, std::uint64_t skip, std::uint64_t count) const;

 private:
  void open(const std::string& name) const;
  [[noreturn]] void fail(const std::string& name, const std::string& what) const;

  std::filesystem::path path_;
  void* zip_ = nullptr;
  std::vector<std::string> names_;
};

}  // namespace insonify
