// recordings.h -- small recordings for the fuzzers of recordings to damage, and what is read of them.

#pragma once

#include <fstream>
#include <iterator>

#include "fuzz/fuzzer.h"
#include "insonify/files.h"
#include "insonify/mcap_recording.h"
#include "insonify/recorded_pings.h"
#include "insonify/recording_info.h"
#include "support/small_recording.h"

namespace insonify::fuzz {

/// Reads all that commands read.
inline void read_recording(const std::filesystem::path& path) {
  static_cast<void>(recording_info(path));
  const RecordedPings pings(path);
  static_cast<void>(pings.receiver_config());
  for (std::uint64_t i = 0; i < std::min<std::uint64_t>(pings.ping_count(), 2); ++i) {
    const Ping ping = pings.ping(i);
    expect(ping.intensity.size() == static_cast<std::size_t>(pings.bin_count()) * pings.beam_count());
  }
}

inline std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace insonify::fuzz
