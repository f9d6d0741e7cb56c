// recording_formats_test.cpp -- the table of formats, and pings written through its interface.

#include "insonify/recording_formats.h"

#include <gtest/gtest.h>

#include "insonify/recorded_pings.h"
#include "insonify/simulator.h"
#include "support/test_files.h"

namespace insonify::recording_formats_test {
namespace {

TEST(RecordingFormatsTest, AreFoundByTheEndingOfAFile) {
  for (const RecordingFormat& format : recording_formats()) {
    EXPECT_EQ(recording_format("out/fls" + format.ending()), &format);
    EXPECT_EQ(is_recording("fls" + format.ending()), format.readable);
  }
  EXPECT_EQ(recording_format("FLS.MCAP"), recording_format("fls.mcap"));
  EXPECT_TRUE(is_recording("fls.hdf5"));
  EXPECT_TRUE(is_recording("FLS.HDF5"));
  for (const char* other : {"fls", "fls.h5.yaml", "fls.bag", ".h5x"}) {
    EXPECT_EQ(recording_format(other), nullptr);
    EXPECT_FALSE(is_recording(other));
  }
  EXPECT_EQ(recording_names(".", " or "), ".h5 or .mcap");
  EXPECT_EQ(recording_names("", ", ", &RecordingFormat::holds_all), "mcap");
  EXPECT_EQ(readable_recordings(), ".h5, .mcap");
}

// Two pings of a sonar in empty water with noise, read back; of formats that hold all sonars also two in one file.
TEST(RecordingFormatsTest, EachWritesThePingsThatItIsGiven) {
  Scenario scenario;
  scenario.sonars.resize(2);
  for (std::size_t i = 0; i < 2; ++i) {
    scenario.sonars[i].name = i == 0 ? "one" : "two";
    scenario.sonars[i].beam_count = 4;
    scenario.sonars[i].bin_count = 8;
  }
  const ScratchFolder folder;
  Simulator simulator(scenario, {}, 1);
  for (const RecordingFormat& format : recording_formats()) {
    std::vector<SonarConfig> sonars = {simulator.sonar(0)};
    if (format.holds_all) {
      sonars.push_back(simulator.sonar(1));
    }
    const std::filesystem::path path = folder.path() / ("out" + format.ending());
    const auto sink = format.open(path, {simulator.scenario(), simulator.scene(), sonars}, {});
    for (std::size_t sonar = 0; sonar < sonars.size(); ++sonar) {
      for (std::uint64_t number = 0; number < 2; ++number) {
        sink->add(sonar, simulator.make_ping(static_cast<int>(sonar), number));
      }
    }
    sink->close();
    EXPECT_EQ(sink->place(), path);
    for (const SonarConfig& sonar : sonars) {
      const RecordedPings pings(path, sonar.name);
      ASSERT_EQ(pings.ping_count(), 2U) << path;
      EXPECT_EQ(pings.ping(1).beam_count, 4);
    }
    EXPECT_LE(std::filesystem::file_size(path),
              sonars.size() * format.bytes(simulator.scenario(), sonars.front(), 2, {}));
  }
}

}  // namespace
}  // namespace insonify::recording_formats_test
