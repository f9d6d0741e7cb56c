// cast_fuzzer.cpp -- reads any bytes as a sound-speed profile; the first byte chooses the ending.

#include <iterator>

#include "fuzz/fuzzer.h"
#include "insonify/sound_speed_files.h"

namespace insonify::cast_fuzzer {
namespace {

void take(fuzz::Bytes bytes) {
  static const fuzz::InputFile file;
  constexpr const char* kNames[] = {"t.csv", "t.svp", "t.asvp"};
  if (bytes.empty()) {
    return;
  }
  const auto path = file.write(kNames[bytes[0] % std::size(kNames)], fuzz::text_of(bytes.subspan(1)));
  fuzz::expect_error_or_nothing([&] { static_cast<void>(SoundSpeedProfile(load_sound_speed_profile(path))); }, path);
}

const fuzz::Listed kListed("cast", take);

}  // namespace
}  // namespace insonify::cast_fuzzer
