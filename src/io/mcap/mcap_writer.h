// mcap_writer.h -- writes an MCAP file: channels, and messages in compressed chunks with indexes and checksums.

#pragma once

#include <cstdint>
#include <exception>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "io/file/file_lock.h"
#include "io/file/unfinished_file.h"
#include "io/mcap/mcap_bytes.h"

namespace insonify {

/// A file of profile "ros2" whose messages are CDR with schemas "ros2msg". Messages collect in a chunk, which is
/// compressed and written when it has 64 KiB, as a ping of most sonars has, or messages of half a second of their own
/// times: a killed process loses no more than that. So the same messages give the same bytes, however long they take.
///
/// The file is made as an UnfinishedFile beside `path`, and renamed at once if there is no file at `path`. An existing
/// file stays until close(); without close() the new one stays beside it if it has messages.
///
/// If the disk is full, the file is still closed properly if that fits: it has the first pings of the last chunk, and
/// metadata with the reason for its end (mcap_metadata::kEnd).
class McapWriter {
 public:
  static constexpr std::uint64_t kLongestChunkNs = 500'000'000;

  /// @param only_whole  Always stay beside `path` until close(), and be removed without it.
  /// @throws Error with the path if the file cannot be made, or exists and may not be replaced.
  McapWriter(std::filesystem::path path, const std::string& library, bool replace, bool only_whole = false);
  /// Finishes the file without reporting errors and without replacing an existing one.
  ~McapWriter();
  McapWriter(const McapWriter&) = delete;
  McapWriter& operator=(const McapWriter&) = delete;

  /// Adds metadata, which readers find without reading messages. To be called before the first message.
  void add_metadata(const std::string& name, const std::map<std::string, std::string>& texts);

  /// The number of a new channel, or of the existing one with the same topic and type.
  /// @throws Error if the topic has another type.
  std::uint16_t add_channel(const std::string& topic, const std::string& type, const std::string& definition);

  struct Message {
    std::uint16_t channel = 0;
    std::vector<std::byte> bytes = {};
  };

  /// Adds messages that must be in one chunk: those of one ping.
  /// @param time_ns  Their time, for log and publication.
  /// @throws Error once the disk is full; the file then holds the messages written before.
  void add(std::uint64_t time_ns, std::span<const Message> messages);

  /// Writes pending messages, index and end, flushes everything to disk and renames the file to `path`.
  void close();

  /// Ends writing and removes the file. For one that was not begun properly.
  void discard();

  /// The file's current path.
  [[nodiscard]] const std::filesystem::path& place() const { return is_beside() ? out_->unfinished() : path_; }

 private:
  struct Channel {
    std::uint16_t schema = 0;
    std::string topic;
    std::uint32_t next_sequence = 0;
  };
  struct Schema {
    std::string name, definition;
  };
  struct IndexEntry {
    std::uint64_t time = 0, offset = 0;
  };

  // Contents of the file, for its summary.
  struct Written {
    std::uint64_t bytes = 0;
    std::uint32_t crc = 0;                      // CRC-32 of all of them.
    McapBytes chunk_indexes, metadata_indexes;  // Records for the summary.
    std::uint32_t chunks = 0, metadata = 0;     // How many.
    std::uint64_t messages = 0;
    std::map<std::uint16_t, std::uint64_t> by_channel;
    std::uint64_t first_time = 0, last_time = 0;
  };

  [[nodiscard]] bool is_beside() const { return out_ && !out_->unfinished().empty(); }
  void put_schema(McapBytes& into, std::size_t index) const;
  void put_channel(McapBytes& into, std::size_t index) const;
  void check_open() const;
  void begin_chunk();
  void put_message(std::uint64_t time_ns, const Message& message);
  void write_chunk();
  [[nodiscard]] std::map<std::uint16_t, std::vector<IndexEntry>> index_up_to(std::size_t bytes) const;
  void write_pings(std::size_t count);
  void save_what_fits();
  void put_metadata(const std::string& name, const std::map<std::string, std::string>& texts);
  void put_statistics(McapBytes& summary) const;
  void write_summary();
  void write(std::span<const std::byte> bytes);
  void finish();
  [[noreturn]] void fail(const std::string& what) const;

  std::filesystem::path path_, absolute_;
  std::unique_ptr<UnfinishedFile> out_;  // Null when closed.
  std::unique_ptr<WriteMark> earlier_;   // On the file that is to be replaced.
  bool only_whole_ = false;
  Written written_;
  std::string full_disk_;  // The system's reason, once the disk was full.

  std::vector<Schema> schemas_;
  std::vector<Channel> channels_;
  std::size_t written_schemas_ = 0, written_channels_ = 0;  // In chunks so far.
  McapBytes chunk_;
  std::map<std::uint16_t, std::vector<IndexEntry>> chunk_index_;
  std::vector<std::size_t> ping_ends_;  // Where in the chunk what belongs together ends.
  std::uint64_t chunk_begun_ns_ = 0;    // Time of its first message.
  std::exception_ptr failure_;          // That ended writing.
};

}  // namespace insonify
