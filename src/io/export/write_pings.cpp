// write_pings.cpp -- merges the pings of several recordings by their times.

#include <algorithm>
#include <cstring>

#include "io/export/export_format.h"

namespace insonify {
namespace {

// One recording, of which one ping is read ahead.
struct Source {
  const RecordedTables& recording;
  RecordedPings pings = pings_of(recording);
  std::uint64_t next = 0;
  bool done = false;
  Ping ping = {};  // With the elevations of the ground truth, if any.

  void advance() {
    done = next >= recording.ping_count();
    if (done) {
      return;
    }
    ping = pings.ping(next);
    const auto elevation = std::ranges::find(recording.tables(), "elevation", &RecordedTable::name);
    if (elevation != recording.tables().end() && elevation->type == "<f4") {
      const std::vector<std::byte> bytes = recording.row(*elevation, next);
      ping.elevation.resize(bytes.size() / sizeof(float));
      std::memcpy(ping.elevation.data(), bytes.data(), bytes.size());
    }
    ++next;
  }
};

// That with the earliest ping, the first one of equals; null at the end.
Source* earliest(std::vector<Source>& sources) {
  Source* found = nullptr;
  for (Source& source : sources) {
    if (!source.done && (found == nullptr || source.ping.time < found->ping.time)) {
      found = &source;
    }
  }
  return found;
}

}  // namespace

void write_pings(RecordedSonars recordings, PingSink& sink, const ExportOptions& options) {
  std::vector<Source> sources;
  for (const auto& recording : recordings) {
    sources.push_back({*recording});
    sources.back().advance();
  }
  while (Source* const next = earliest(sources)) {
    check_stop(options);
    sink.add(static_cast<std::size_t>(next - sources.data()), next->ping);
    next->advance();
  }
  const auto& names = recordings.front()->names();
  const auto markers = std::ranges::find(names, "markers", &RecordedNames::name);
  if (markers != names.end()) {
    sink.mark(markers_from_texts(markers->texts));
  }
  sink.close();
}

}  // namespace insonify
