// foreign_fuzzer.cpp -- reads any bytes as a file of an instrument, an array or a picture; the first byte says which.

#include <algorithm>
#include <cstdlib>
#include <iterator>

#include "fuzz_reader.h"
#include "insonify/recorded_pings.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace insonify;
  static const fuzz::InputFile file;
  constexpr const char* kNames[] = {"a.raw", "a.bin", "a.xtf", "a.npy", "a.npz", "a.jpg", "a.pgm"};
  if (size == 0) {
    return 0;
  }
  const auto path = file.write(kNames[data[0] % std::size(kNames)], fuzz::text_of(data, size).substr(1));
  fuzz::expect_error_or_nothing([&] {
    const RecordedPings pings(path);
    for (std::uint64_t ping = 0; ping < std::min<std::uint64_t>(pings.ping_count(), 3); ++ping) {
      if (pings.intensity(ping).size() != static_cast<std::size_t>(pings.bin_count()) * pings.beam_count()) {
        std::abort();
      }
    }
    static_cast<void>(pings.sonar_config());
  });
  return 0;
}
