// recorded_sequence.h -- the pings of several recordings, in order of time.

#pragma once

#include <vector>

#include "insonify/recorded_pings.h"
#include "io/export/export_format.h"

namespace insonify {

/// Reads one ping of each recording ahead.
class RecordedSequence {
 public:
  /// @param recordings  Must live as long as this.
  explicit RecordedSequence(RecordedSonars recordings);

  [[nodiscard]] bool done() const;
  /// The earliest remaining ping; of simultaneous ones, that of the first recording.
  [[nodiscard]] std::size_t sonar() const { return next_; }
  /// With the elevations of the ground truth, if any.
  [[nodiscard]] const Ping& ping() const { return sources_[next_].ping; }
  void advance();

 private:
  struct Source {
    const RecordedTables* recording;
    RecordedPings pings;
    const RecordedTable* elevation;  // Null: none.
    std::uint64_t next = 0;
    bool done = false;
    Ping ping = {};

    void advance();
  };
  void find_next();

  std::vector<Source> sources_;
  std::size_t next_ = 0;
};

}  // namespace insonify
