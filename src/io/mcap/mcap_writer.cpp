// mcap_writer.cpp -- collects records in chunks and decides when they are written (mcap.dev/spec).

#include "io/mcap/mcap_writer.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

#include "insonify/error.h"

namespace insonify {
namespace {

constexpr std::size_t kLargeChunk = std::size_t{1} << 16;  // [bytes]

}  // namespace

McapWriter::McapWriter(std::filesystem::path path, const std::string& library, bool replace, bool only_whole)
    : path_(std::move(path)), only_whole_(only_whole) {
  const auto refuse_while_another_writes = [this] {
    if (is_being_written(path_)) {
      fail("cannot create: another run is writing it; choose another folder");
    }
  };
  refuse_while_another_writes();
  std::error_code ignored;
  if (std::filesystem::is_regular_file(path_, ignored)) {
    if (!replace) {
      fail("cannot create: it exists already");
    }
    earlier_ = std::make_unique<WriteMark>(path_);
  }
  out_ = std::make_unique<UnfinishedFile>(path_, "cannot create");
  mark_as_being_written(out_->descriptor());
  absolute_ = std::filesystem::absolute(out_->unfinished());
  McapBytes start;
  start.append(std::as_bytes(std::span(kMcapMagic)));
  start.record(McapOp::kHeader, [&] { start.put(std::string_view("ros2"), std::string_view(library)); });
  write(start.bytes());
  if (!earlier_ && !only_whole_) {
    refuse_while_another_writes();
    std::filesystem::path in_place = std::filesystem::absolute(path_);
    out_->put_in_place();
    absolute_.swap(in_place);
    try {
      out_->sync_folder();
    } catch (...) {
      discard();
      throw;
    }
  }
}

McapWriter::~McapWriter() {
  if (out_ && !only_whole_) {
    try {
      finish();
    } catch (const std::exception&) {  // NOLINT(bugprone-empty-catch): close() reports.
    }
    if (written_.messages > 0) {
      out_->keep();
    }
  }
}

void McapWriter::discard() {
  if (!is_beside() && is_still_there(out_->descriptor(), absolute_)) {
    std::error_code ignored;
    std::filesystem::remove(absolute_, ignored);
  }
  out_.reset();
}

void McapWriter::fail(const std::string& what) const {
  throw Error(fmt::format("{}: {}", path_.string(), what));
}

void McapWriter::check_open() const {
  if (failure_) {
    std::rethrow_exception(failure_);
  }
  if (!out_) {
    fail("cannot write: it is closed");
  }
}

void McapWriter::add_metadata(const std::string& name, const std::map<std::string, std::string>& texts) {
  check_open();
  put_metadata(name, texts);
}

std::uint16_t McapWriter::add_channel(const std::string& topic, const std::string& type,
                                      const std::string& definition) {
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    if (channels_[i].topic == topic) {
      if (schemas_[channels_[i].schema - 1U].name != type) {
        fail(fmt::format("topic {} cannot be {} and {}", topic, schemas_[channels_[i].schema - 1U].name, type));
      }
      return static_cast<std::uint16_t>(i);
    }
  }
  auto schema = std::ranges::find(schemas_, type, &Schema::name);
  if (schema == schemas_.end()) {
    schema = schemas_.insert(schema, {type, definition});
  }
  channels_.push_back({static_cast<std::uint16_t>(schema - schemas_.begin() + 1), topic});  // Schema 0 means none.
  return static_cast<std::uint16_t>(channels_.size() - 1);
}

void McapWriter::put_schema(McapBytes& into, std::size_t index) const {
  into.record(McapOp::kSchema, [&] {
    into.put(static_cast<std::uint16_t>(index + 1), std::string_view(schemas_[index].name), std::string_view("ros2msg"),
             std::string_view(schemas_[index].definition));
  });
}

void McapWriter::put_channel(McapBytes& into, std::size_t index) const {
  into.record(McapOp::kChannel, [&] {
    into.put(static_cast<std::uint16_t>(index), channels_[index].schema, std::string_view(channels_[index].topic),
             std::string_view("cdr"));
    into.put(std::map<std::string, std::string>{{"offered_qos_profiles", ""}});  // Which rosbag2 looks for.
  });
}

// A chunk begins with the schemas and channels that are new since the last chunk.
void McapWriter::begin_chunk() {
  for (; written_schemas_ < schemas_.size(); ++written_schemas_) {
    put_schema(chunk_, written_schemas_);
  }
  for (; written_channels_ < channels_.size(); ++written_channels_) {
    put_channel(chunk_, written_channels_);
  }
}

void McapWriter::put_message(std::uint64_t time_ns, const Message& message) {
  Channel& to = channels_[message.channel];
  chunk_index_[message.channel].push_back({time_ns, chunk_.size()});
  chunk_.record(McapOp::kMessage, [&] {
    chunk_.put(message.channel, to.next_sequence++, time_ns, time_ns);
    chunk_.append(message.bytes);
  });
}

void McapWriter::add(std::uint64_t time_ns, std::span<const Message> messages) {
  check_open();
  const bool begins = chunk_index_.empty();
  if (begins || written_channels_ < channels_.size()) {
    begin_chunk();
  }
  chunk_begun_ns_ = begins ? time_ns : chunk_begun_ns_;
  for (const Message& message : messages) {
    put_message(time_ns, message);
  }
  ping_ends_.push_back(chunk_.size());
  if (chunk_.size() >= kLargeChunk || time_ns >= chunk_begun_ns_ + kLongestChunkNs) {
    write_chunk();
  }
}

void McapWriter::finish() {
  if (failure_) {
    std::rethrow_exception(failure_);
  }
  write_chunk();
  write_summary();
  if (fsync(out_->descriptor()) != 0) {
    fail("cannot write: " + std::generic_category().message(errno));
  }
}

void McapWriter::close() {
  if (!out_) {
    return;
  }
  finish();
  if (is_beside()) {
    out_->put_in_place();
  }
  out_->sync_folder();
  out_.reset();
  earlier_.reset();
}

}  // namespace insonify
