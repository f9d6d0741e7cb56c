// bag_writer.cpp -- records of a bag: a header of named fields and data, each with its length before it.

#include "io/bag/bag_writer.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <string_view>
#include <utility>

#include "insonify/error.h"
#include "io/file/unfinished_file.h"

namespace insonify {
namespace {

constexpr std::string_view kStart = "#ROSBAG V2.0\n";
constexpr std::size_t kLargeChunk = 768 * 1024;  // As rosbag's own [bytes].
constexpr std::size_t kBagHeaderLength = 4096;   // Length of the first record: room to write it again.
constexpr std::uint64_t kNanoseconds = 1'000'000'000;

enum class Op : std::uint8_t { kMessage = 2, kBagHeader = 3, kIndex = 4, kChunk = 5, kChunkFacts = 6, kConnection = 7 };

std::uint64_t bag_time(std::uint64_t time_ns) {
  return (time_ns / kNanoseconds) | (time_ns % kNanoseconds) << 32U;
}

template <typename Value>
std::string_view bytes_of(const Value& value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

void append_to(std::vector<std::byte>& into, std::string_view text) {
  const auto bytes = std::as_bytes(std::span(text.data(), text.size()));
  into.insert(into.end(), bytes.begin(), bytes.end());
}

using Fields = std::vector<std::pair<std::string_view, std::string_view>>;

void append_header(std::vector<std::byte>& into, const Fields& fields) {
  std::uint32_t length = 0;
  for (const auto& [name, value] : fields) {
    length += static_cast<std::uint32_t>(sizeof(std::uint32_t) + name.size() + 1 + value.size());
  }
  append_to(into, bytes_of(length));
  for (const auto& [name, value] : fields) {
    append_to(into, bytes_of(static_cast<std::uint32_t>(name.size() + 1 + value.size())));
    append_to(into, name);
    append_to(into, "=");
    append_to(into, value);
  }
}

void append_data(std::vector<std::byte>& into, std::span<const std::byte> data) {
  append_to(into, bytes_of(static_cast<std::uint32_t>(data.size())));
  into.insert(into.end(), data.begin(), data.end());
}

}  // namespace

BagWriter::BagWriter(std::filesystem::path path) : path_(std::move(path)), out_(path_, "cannot create") {
  std::vector<std::byte> start;
  append_to(start, kStart);
  put_bag_header(start, 0);
  append(start);
}

std::uint32_t BagWriter::add_connection(const std::string& topic, const std::string& type, const std::string& md5,
                                        const std::string& definition) {
  const auto found = std::ranges::find(connections_, topic, &Connection::topic);
  if (found == connections_.end()) {
    connections_.push_back({topic, type, md5, definition});
    return static_cast<std::uint32_t>(connections_.size() - 1);
  }
  if (found->type != type) {
    throw Error(fmt::format("{}: topic {} cannot be {} and {}", path_.string(), topic, found->type, type));
  }
  return static_cast<std::uint32_t>(found - connections_.begin());
}

void BagWriter::put_connection(std::vector<std::byte>& into, std::uint32_t connection) const {
  const Connection& facts = connections_[connection];
  append_header(into, {{"conn", bytes_of(connection)}, {"op", bytes_of(Op::kConnection)}, {"topic", facts.topic}});
  std::vector<std::byte> data;
  append_header(
      data,
      {{"topic", facts.topic}, {"type", facts.type}, {"md5sum", facts.md5}, {"message_definition", facts.definition}});
  into.insert(into.end(), data.begin(), data.end());  // Its length comes first, as before data.
}

// Filled up with spaces to always the same length.
void BagWriter::put_bag_header(std::vector<std::byte>& into, std::uint64_t index_position) const {
  const auto chunks = static_cast<std::uint32_t>(chunks_.size());
  const auto connections = static_cast<std::uint32_t>(index_position == 0 ? 0 : connections_.size());
  std::vector<std::byte> header;
  append_header(header, {{"chunk_count", bytes_of(chunks)},
                         {"conn_count", bytes_of(connections)},
                         {"index_pos", bytes_of(index_position)},
                         {"op", bytes_of(Op::kBagHeader)}});
  into.insert(into.end(), header.begin(), header.end());
  append_data(into, std::vector<std::byte>(kBagHeaderLength - header.size() - sizeof(std::uint32_t), std::byte{' '}));
}

void BagWriter::add(std::uint64_t time_ns, std::uint32_t connection, std::span<const std::byte> message) {
  time_ns = std::max<std::uint64_t>(time_ns, 1);
  for (; written_ < connections_.size(); ++written_) {
    put_connection(chunk_, static_cast<std::uint32_t>(written_));
  }
  first_ns_ = entries_.empty() ? time_ns : std::min(first_ns_, time_ns);
  last_ns_ = entries_.empty() ? time_ns : std::max(last_ns_, time_ns);
  const std::uint64_t time = bag_time(time_ns);
  entries_[connection].push_back({time, static_cast<std::uint32_t>(chunk_.size())});
  append_header(chunk_, {{"conn", bytes_of(connection)}, {"op", bytes_of(Op::kMessage)}, {"time", bytes_of(time)}});
  append_data(chunk_, message);
  if (chunk_.size() >= kLargeChunk) {
    write_chunk();
  }
}

// The chunk, and after it the index of each connection in it.
void BagWriter::write_chunk() {
  if (entries_.empty()) {
    return;
  }
  ChunkFacts facts{.position = end_, .first = bag_time(first_ns_), .last = bag_time(last_ns_), .counts = {}};
  std::vector<std::byte> bytes;
  bytes.reserve(chunk_.size() + 4096);
  const auto size = static_cast<std::uint32_t>(chunk_.size());
  append_header(bytes, {{"compression", "none"}, {"op", bytes_of(Op::kChunk)}, {"size", bytes_of(size)}});
  append_data(bytes, chunk_);
  constexpr std::uint32_t kVersion = 1;
  for (const auto& [connection, entries] : entries_) {
    const auto count = static_cast<std::uint32_t>(entries.size());
    facts.counts[connection] = count;
    append_header(bytes, {{"conn", bytes_of(connection)},
                          {"count", bytes_of(count)},
                          {"op", bytes_of(Op::kIndex)},
                          {"ver", bytes_of(kVersion)}});
    append_to(bytes, bytes_of(static_cast<std::uint32_t>(count * (sizeof(std::uint64_t) + sizeof(std::uint32_t)))));
    for (const Entry& entry : entries) {
      append_to(bytes, bytes_of(entry.time));
      append_to(bytes, bytes_of(entry.offset));
    }
  }
  append(bytes);
  chunks_.push_back(std::move(facts));
  chunk_.clear();
  entries_.clear();
}

void BagWriter::write(std::span<const std::byte> bytes, std::uint64_t at) {
  if (!write_at(out_.descriptor(), at, bytes)) {
    out_.fail_by_errno();
  }
}

void BagWriter::append(std::span<const std::byte> bytes) {
  write(bytes, end_);
  end_ += bytes.size();
}

void BagWriter::close() {
  write_chunk();
  const std::uint64_t index_position = end_;
  std::vector<std::byte> index;
  for (std::size_t i = 0; i < connections_.size(); ++i) {
    put_connection(index, static_cast<std::uint32_t>(i));
  }
  constexpr std::uint32_t kVersion = 1;
  for (const ChunkFacts& chunk : chunks_) {
    const auto count = static_cast<std::uint32_t>(chunk.counts.size());
    append_header(index, {{"chunk_pos", bytes_of(chunk.position)},
                          {"count", bytes_of(count)},
                          {"end_time", bytes_of(chunk.last)},
                          {"op", bytes_of(Op::kChunkFacts)},
                          {"start_time", bytes_of(chunk.first)},
                          {"ver", bytes_of(kVersion)}});
    append_to(index, bytes_of(static_cast<std::uint32_t>(count * 2 * sizeof(std::uint32_t))));
    for (const auto& [connection, messages] : chunk.counts) {
      append_to(index, bytes_of(connection));
      append_to(index, bytes_of(messages));
    }
  }
  append(index);
  std::vector<std::byte> header;
  put_bag_header(header, index_position);
  write(header, kStart.size());
  if (fsync(out_.descriptor()) != 0) {
    out_.fail_by_errno();
  }
  out_.put_in_place();
}

}  // namespace insonify
