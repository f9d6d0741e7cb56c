// recorded_sequence.cpp -- merges the pings of several recordings by their times.

#include "io/export/recorded_sequence.h"

#include <algorithm>
#include <cstring>

#include "io/export/recorded_source.h"

namespace insonify {
namespace {

const RecordedTable* table_named(const RecordedTables& recording, const std::string& name) {
  const auto& tables = recording.tables();
  const auto found = std::ranges::find(tables, name, &RecordedTable::name);
  return found == tables.end() ? nullptr : &*found;
}

}  // namespace

void RecordedSequence::Source::advance() {
  done = next >= recording->ping_count();
  if (done) {
    return;
  }
  ping = pings.ping(next);
  if (elevation != nullptr && elevation->type == "<f4") {
    const std::vector<std::byte> bytes = recording->row(*elevation, next);
    ping.elevation.resize(bytes.size() / sizeof(float));
    std::memcpy(ping.elevation.data(), bytes.data(), bytes.size());
  }
  ++next;
}

RecordedSequence::RecordedSequence(RecordedSonars recordings) {
  for (const auto& recording : recordings) {
    sources_.push_back({recording.get(), pings_of(*recording), table_named(*recording, "elevation")});
    sources_.back().advance();
  }
  find_next();
}

bool RecordedSequence::done() const {
  return sources_.empty() || sources_[next_].done;
}

void RecordedSequence::advance() {
  sources_[next_].advance();
  find_next();
}

void RecordedSequence::find_next() {
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    const bool sooner = sources_[next_].done || sources_[i].ping.time < sources_[next_].ping.time;
    if (!sources_[i].done && (sooner || (i < next_ && sources_[i].ping.time <= sources_[next_].ping.time))) {
      next_ = i;
    }
  }
}

}  // namespace insonify
