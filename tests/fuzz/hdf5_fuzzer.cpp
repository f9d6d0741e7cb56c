// hdf5_fuzzer.cpp -- changes words of the heads of an HDF5 recording, as the input says, and reads it.

#include "fuzz/recordings.h"

namespace insonify::hdf5_fuzzer {
namespace {

// Of the 8-byte words that are not 0: heads, indices, types and names, since there is one ping.
std::vector<std::size_t> places_in(const std::string& whole) {
  std::vector<std::size_t> places;
  for (std::size_t at = 0; at + 8 <= whole.size(); at += 8) {
    if (whole.find_first_not_of('\0', at) < at + 8) {
      places.push_back(at);
    }
  }
  return places;
}

void take(fuzz::Bytes bytes) {
  static const fuzz::InputFile file;
  static const std::string whole = [] {
    const std::filesystem::path path = file.folder() / "whole.h5";
    record_ping([&](const Scenario& scenario, const Scene& scene, const SonarConfig& sonar, const Ping& ping) {
      Recording(path, scenario, scene, sonar).add(ping);
    });
    fuzz::read_recording(path);
    return fuzz::bytes_of(path);
  }();
  static const std::vector<std::size_t> places = places_in(whole);
  const auto path = file.write("a.h5", fuzz::with_words(whole, places, bytes));
  fuzz::expect_error_or_nothing([&] { fuzz::read_recording(path); }, path);
}

const fuzz::Listed kListed("hdf5", take);

}  // namespace
}  // namespace insonify::hdf5_fuzzer
