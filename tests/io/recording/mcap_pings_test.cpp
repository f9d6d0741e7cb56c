// mcap_pings_test.cpp -- pings in MCAP recordings: topics, levels, files being replaced, broken files.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "insonify/mcap_recording.h"
#include "insonify/recorded_pings.h"
#include "insonify/recording_info.h"
#include "insonify/stored_tables.h"
#include "io/mcap/mcap_writer.h"
#include "support/message_of.h"
#include "support/working_folder.h"

namespace insonify::mcap_pings_test {
namespace {

class McapPingsTest : public testing::Test {
 protected:
  WorkingFolder folder;
};

// A recording of one small ping.
void record_ping(const std::filesystem::path& path) {
  SonarConfig sonar;
  sonar.name = "fls";
  sonar.beam_count = 2;
  sonar.bin_count = 3;
  sonar.max_range = 9;
  sonar.assumed_sound_speed = 1500;
  McapOptions options{.run = {.seed = 77}};
  options.messages.fan_height = 240;
  McapRecording out(path, {MessageSource{sonar, EchoModel::kCalibrated, {}, "pings: 1\n", {}}}, options);
  Ping ping;
  ping.time = 1.5;
  ping.world_from_sonar.position = {1, 2, 3};
  ping.bin_count = 3;
  ping.beam_count = 2;
  ping.intensity = {1e-9F, 0, 1e-8F, 1e-7F, 1e-3F, 1e-30F};
  out.add(0, ping);
  out.close();
}

TEST_F(McapPingsTest, SonarsOfTheSameTopicsAreKeptApart) {
  const auto source = [](const char* name, int bins) {
    SonarConfig sonar;
    sonar.name = name;
    sonar.beam_count = 2;
    sonar.bin_count = bins;
    sonar.assumed_sound_speed = 1500;
    return MessageSource{sonar, EchoModel::kCalibrated, {}, "", {}};
  };
  {
    McapRecording out("a.mcap", {source("fls ä", 3), source("fls ö", 4)});
    for (int sonar = 0; sonar < 2; ++sonar) {
      Ping ping;
      ping.bin_count = 3 + sonar;
      ping.beam_count = 2;
      ping.intensity.assign(2 * (3 + sonar), 1e-8F);
      out.add(sonar, ping);
    }
    out.close();
  }
  const RecordingInfo info = recording_info("a.mcap");
  EXPECT_THAT(info.contents, testing::Contains("/fls__/sonar_image marine_acoustic_msgs/msg/ProjectedSonarImage"));
  EXPECT_THAT(info.contents, testing::Contains("/fls___2/sonar_image marine_acoustic_msgs/msg/ProjectedSonarImage"));
  EXPECT_EQ(RecordedPings("a.mcap", "fls ä").ping(0).bin_count, 3);
  EXPECT_EQ(RecordedPings("a.mcap", "fls ö").ping(0).bin_count, 4);
  EXPECT_EQ(message_of([&] {
              McapRecording("b.mcap", {source("fls", 3), source("fls", 4)});
            }),
            "b.mcap: there are two sonars called fls; their names must differ");
}

TEST_F(McapPingsTest, AnEarlierFileThatIsToBeReplacedIsNotTheOneBeingWritten) {
  record_ping("a.mcap");
  EXPECT_EQ(recording_state("a.mcap"), RecordingState::kWhole);
  std::filesystem::resize_file("a.mcap", std::filesystem::file_size("a.mcap") - 100);  // Its run was killed.
  const McapWriter next("a.mcap", "us", true);
  EXPECT_EQ(recording_state("a.mcap"), RecordingState::kUnfinished);
  EXPECT_EQ(message_of([] { McapWriter("a.mcap", "us", true); }),
            "a.mcap: cannot create: another run is writing it; choose another folder");
}

TEST_F(McapPingsTest, PingsAreReadBackWithinTheirLevels) {
  record_ping("a.mcap");
  const RecordedPings pings("a.mcap");
  ASSERT_EQ(pings.ping_count(), 1);
  EXPECT_EQ(pings.sonar_config().max_range, 9);
  const Ping ping = pings.ping(0);
  EXPECT_EQ(ping.time, 1.5);
  EXPECT_EQ(ping.world_from_sonar.position, Vec3(1, 2, 3));
  // Bins are 2.933 m long from 0.2 m on, centred at 1.667, 4.6 and 7.533 m. Levels in dB, and with 30 log10(range):
  //   -90, nothing     -83.3
  //   -80, -70         -60.1, -50.1
  //   -30, -300        -3.7: above the highest level, -40; -273.7: below the lowest, -100
  const auto level = [&](std::size_t cell) { return 10 * std::log10(ping.intensity.at(cell)); };
  EXPECT_NEAR(level(0), -90, 0.0005);
  EXPECT_EQ(ping.intensity[1], 0);
  EXPECT_NEAR(level(2), -80, 0.0005);
  EXPECT_NEAR(level(3), -70, 0.0005);
  EXPECT_NEAR(level(4), -40 - 30 * std::log10(0.2 + 2.5 * 8.8 / 3), 0.0005);
  EXPECT_EQ(ping.intensity[5], 0);
}

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

TEST_F(McapPingsTest, BrokenRecordingsAreRefusedWithTheirName) {
  record_ping("a.mcap");
  const std::string whole = text_of("a.mcap");
  int refused = 0;
  for (std::size_t i = 8; i < whole.size(); i += 13) {
    std::string broken = whole;
    broken[i] = static_cast<char>(broken[i] ^ 0x05);
    std::filesystem::remove("broken.mcap");  // Some file systems wait for the disk when a file is cut to nothing.
    folder.write("broken.mcap", broken);
    const std::string message = message_of([] {
      (void)recording_info("broken.mcap");
      const RecordedPings pings("broken.mcap");
      const StoredTables tables("broken.mcap");
      for (std::uint64_t ping = 0; ping < pings.ping_count(); ++ping) {
        (void)pings.ping(ping);
      }
      std::vector<std::byte> intensity(6 * sizeof(float));
      const std::vector<TableSlice> all = {{0, 1}, {0, 3}, {0, 2}};
      tables.read(*tables.find("intensity"), all, intensity);
    });
    EXPECT_TRUE(message == "no error" || message.starts_with("broken.mcap")) << i << ": " << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << i << ": " << message;
    refused += message == "no error" ? 0 : 1;
  }
  EXPECT_GT(refused, 50);
}

}  // namespace
}  // namespace insonify::mcap_pings_test
