// mcap_reader.h -- reads MCAP files written by McapWriter, also those of killed runs.

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace insonify {

class McapReader {
 public:
  struct Entry {
    std::uint64_t time = 0;    // [ns]
    std::size_t chunk = 0;     // Index of its chunk ...
    std::uint64_t offset = 0;  // ... and the offset of its record in the uncompressed chunk.
  };

  /// Reads the file's records, without the messages.
  /// @throws Error with the path for a file that is missing, not MCAP or has broken records.
  explicit McapReader(const std::filesystem::path& path);

  /// Whether the file has its end record, which those of killed runs lack.
  [[nodiscard]] bool is_whole() const { return whole_; }

  /// Metadata by name.
  [[nodiscard]] const std::map<std::string, std::map<std::string, std::string>>& metadata() const { return metadata_; }

  /// Topics with their types.
  [[nodiscard]] const std::map<std::string, std::string>& topics() const { return topics_; }

  /// Messages of a topic in file order; empty for an unknown topic.
  [[nodiscard]] const std::vector<Entry>& messages(const std::string& topic) const;

  /// One message.
  /// @throws Error for a chunk whose checksum is wrong.
  [[nodiscard]] std::vector<std::byte> read(const Entry& entry) const;

 private:
  struct Chunk {
    std::uint64_t at = 0, packed = 0, size = 0;  // Place and bytes of its compressed records; bytes of them unpacked.
    std::uint32_t crc = 0;
  };

  void read_records();
  void read_chunk(std::uint64_t at, std::uint64_t length);
  void read_index(const std::vector<std::byte>& bytes);
  void read_channels();
  [[nodiscard]] std::vector<std::byte> bytes_at(std::uint64_t place, std::uint64_t count) const;
  [[nodiscard]] const std::vector<std::byte>& unpacked(std::size_t chunk) const;
  [[noreturn]] void fail(const std::string& what) const;

  std::filesystem::path path_;
  mutable std::ifstream file_;
  std::uint64_t size_ = 0;  // [bytes]
  bool whole_ = false;
  std::map<std::string, std::map<std::string, std::string>> metadata_;
  std::vector<Chunk> chunks_;
  std::map<std::uint16_t, std::string> schemas_, channels_;  // Names of types; topics.
  std::map<std::string, std::string> topics_;
  std::map<std::uint16_t, std::vector<Entry>> entries_;
  mutable std::size_t unpacked_chunk_ = static_cast<std::size_t>(-1);  // Which one is kept.
  mutable std::vector<std::byte> unpacked_;
};

}  // namespace insonify
