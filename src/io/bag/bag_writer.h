// bag_writer.h -- writes a bag of ROS 1: connections, and messages in chunks with indexes.

#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "io/file/unfinished_file.h"

namespace insonify {

/// A file of version 2.0 (wiki.ros.org/Bags/Format/2.0) with uncompressed chunks. It is written beside `path` and
/// renamed when closed; without close() it is removed.
class BagWriter {
 public:
  /// @param path  An existing file is replaced.
  /// @throws Error with the path when the file cannot be made.
  explicit BagWriter(std::filesystem::path path);

  /// The number of a new connection, or of the existing one with the same topic and type.
  /// @param md5  Of the definition, 32 hexadecimal digits.
  /// @throws Error if the topic has another type.
  std::uint32_t add_connection(const std::string& topic, const std::string& type, const std::string& md5,
                               const std::string& definition);

  /// @param time_ns  When the message was received; 0, which bags do not allow, becomes 1.
  /// @throws Error with the path when the disk is full; as all here.
  void add(std::uint64_t time_ns, std::uint32_t connection, std::span<const std::byte> message);

  /// Writes pending messages and the index, flushes everything to disk and renames the file to `path`.
  void close();

 private:
  struct Connection {
    std::string topic, type, md5, definition;
  };
  struct Entry {
    std::uint64_t time = 0;    // As bags hold it: seconds below, nanoseconds above.
    std::uint32_t offset = 0;  // In its chunk.
  };
  struct ChunkFacts {
    std::uint64_t position = 0, first = 0, last = 0;  // Times as above.
    std::map<std::uint32_t, std::uint32_t> counts;    // Messages of each connection.
  };

  void put_connection(std::vector<std::byte>& into, std::uint32_t connection) const;
  void put_bag_header(std::vector<std::byte>& into, std::uint64_t index_position) const;
  void write_chunk();
  void write(std::span<const std::byte> bytes, std::uint64_t at);
  void append(std::span<const std::byte> bytes);

  std::filesystem::path path_;
  UnfinishedFile out_;
  std::uint64_t end_ = 0;  // Bytes written.
  std::vector<Connection> connections_;
  std::size_t written_ = 0;  // Connections in chunks so far.
  std::vector<std::byte> chunk_;
  std::map<std::uint32_t, std::vector<Entry>> entries_;  // Messages of the chunk, by connection.
  std::uint64_t first_ns_ = 0, last_ns_ = 0;             // Times of the chunk's first and last message [ns].
  std::vector<ChunkFacts> chunks_;
};

}  // namespace insonify
