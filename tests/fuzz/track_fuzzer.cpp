// track_fuzzer.cpp -- reads any bytes as a trajectory file; the first byte chooses the ending.

#include <iterator>

#include "fuzz/fuzzer.h"
#include "insonify/files.h"

namespace insonify::track_fuzzer {
namespace {

void take(fuzz::Bytes bytes) {
  static const fuzz::InputFile file;
  constexpr const char* kNames[] = {"t.csv", "t.tum", "t.txt", "t.kitti"};
  if (bytes.empty()) {
    return;
  }
  const auto path = file.write(kNames[bytes[0] % std::size(kNames)], fuzz::text_of(bytes.subspan(1)));
  fuzz::expect_error_or_nothing([&] { static_cast<void>(load_trajectory(path)); }, path);
}

const fuzz::Listed kListed("track", take);

}  // namespace
}  // namespace insonify::track_fuzzer
