// mcap_writer.h -- writes an MCAP file: channels, and messages in compressed chunks with indexes and checksums.

#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "io/file/file_lock.h"
#include "io/file/unfinished_file.h"
#include "io/mcap/mcap_bytes.h"

namespace insonify {

/// A file of profile "ros2" whose messages are CDR with schemas "ros2msg". Messages collect in a chunk, which is
/// compressed and written at once when it is large, and at the latest kLongestChunk after its first message, by a
/// thread of its own: a process that is killed loses no more than that.
///
/// The file is made beside `path`, as an UnfinishedFile. If nothing is at `path`, it goes there at once. A file that is
/// there already stays until close(); without close() the new one stays beside it if it has messages.
///
/// Where the disk is full the file still ends as it should if that has room: of the chunk that did not fit it has the
/// first pings, and metadata say why it ends (mcap_metadata::kEnd).
class McapWriter {
 public:
  static constexpr std::chrono::milliseconds kLongestChunk{500};

  /// @param only_whole  Stay beside `path` until close() in any case, and be removed without; chunks end by their size
  ///                    alone, so that the same messages are the same bytes.
  /// @throws Error with the path when the file cannot be made, or is there and may not be replaced.
  McapWriter(std::filesystem::path path, const std::string& library, bool replace, bool only_whole = false);
  /// Finishes the file without reporting errors and without replacing an earlier one.
  ~McapWriter();
  McapWriter(const McapWriter&) = delete;
  McapWriter& operator=(const McapWriter&) = delete;

  /// Texts about the file, which readers find without reading messages. Before the first message.
  void add_metadata(const std::string& name, const std::map<std::string, std::string>& texts);

  /// The number of a new channel; of the one that there is where topic and type are the same.
  /// @throws Error where the topic has another type.
  std::uint16_t add_channel(const std::string& topic, const std::string& type, const std::string& definition);

  struct Message {
    std::uint16_t channel = 0;
    std::vector<std::byte> bytes = {};
  };

  /// Adds messages that come into the file together, in one chunk: those about one ping.
  /// @param time_ns  Their time, for log and publication.
  /// @throws Error when the disk is full, from then on; the file then holds what was written before.
  void add(std::uint64_t time_ns, std::span<const Message> messages);

  /// Writes what is left, the index and the end, has the system put all on the disk and puts the file in its place.
  void close();

  /// Where the file is now.
  [[nodiscard]] const std::filesystem::path& place() const { return is_beside() ? out_->unfinished() : path_; }

 private:
  using Clock = std::chrono::steady_clock;
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

  // What the file holds, and what its summary will tell of it.
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
  void write_pings(std::size_t count);
  void save_what_fits();
  void put_metadata(const std::string& name, const std::map<std::string, std::string>& texts);
  void write_summary();
  void write(std::span<const std::byte> bytes);
  void finish();
  void write_chunks_in_time();
  void stop_thread();
  [[noreturn]] void fail(const std::string& what) const;

  std::filesystem::path path_, absolute_;
  std::unique_ptr<UnfinishedFile> out_;  // Null when closed.
  std::unique_ptr<WriteMark> earlier_;   // On the file that is to be replaced.
  bool only_whole_ = false;
  Written written_;
  std::string full_disk_;  // The system's reason, once the disk was full.

  std::vector<Schema> schemas_;
  std::vector<Channel> channels_;
  std::size_t told_schemas_ = 0, told_channels_ = 0;  // In chunks so far.
  McapBytes chunk_;
  std::map<std::uint16_t, std::vector<IndexEntry>> chunk_index_;
  std::vector<std::size_t> ping_ends_;  // Where in the chunk what belongs together ends.
  Clock::time_point chunk_begun_;

  std::mutex mutex_;
  std::condition_variable changed_;
  bool stopping_ = false;
  std::exception_ptr failure_;  // That ended writing.
  std::thread thread_;
};

}  // namespace insonify
