// ping360_file_test.cpp -- logs of Ping Viewer and streams of frames: samples, angles and what is refused.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/foreign/foreign_bytes.h"

namespace insonify::ping360_file_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::string> sweep(int first, int count, int step) {
  std::vector<std::string> frames;
  for (int i = 0; i < count; ++i) {
    frames.push_back(ping360_profile(static_cast<std::uint16_t>((first + i * step) % 400), "abcd"));
  }
  return frames;
}

TEST(Ping360FileTest, ALogGivesSamplesTimesAndAngles) {
  const WorkingFolder folder;
  folder.write("a.bin", ping_viewer_log({ping360_profile(0, std::string("\0\x01\x80\xff", 4)), ping_frame(5, "x"),
                                         ping360_profile(100, "wxyz"), ping360_auto_profile(200, "abcd")}));
  const RecordedPings pings("a.bin");
  EXPECT_EQ(pings.foreign_format(), "Ping360");
  EXPECT_EQ(pings.ping_count(), 3U);
  EXPECT_EQ(pings.beam_count(), 1);
  EXPECT_EQ(pings.full_scale(), 255);
  EXPECT_THAT(pings.intensity(0), ElementsAre(0, 1, 128, 255));
  EXPECT_THAT(pings.intensity(1), ElementsAre('w', 'x', 'y', 'z'));
  EXPECT_THAT(pings.intensity(2), ElementsAre('a', 'b', 'c', 'd'));
  EXPECT_NEAR(pings.ping(1).time, 0.5, 1e-9);
  // 100 gradians are a quarter of a turn, to starboard.
  EXPECT_NEAR(degrees_from_radians(pings.ping(1).head_angle), -90, 1e-9);
  EXPECT_THAT(pings.notes(), IsEmpty());
  EXPECT_THAT(pings.assumed(), ElementsAre("no sound speed in it, 1500 m/s is assumed"));
}

// 100 ticks of 25 ns and 4 samples: 10 us there and back.
TEST(Ping360FileTest, SettingsFollowFromTheFrames) {
  const WorkingFolder folder;
  folder.write("a.bin", ping_viewer_log(sweep(0, 200, 2)));
  const SonarConfig sonar = RecordedPings("a.bin").sonar_config();
  EXPECT_TRUE(sonar.scans());
  EXPECT_EQ(sonar.bin_count, 4);
  EXPECT_NEAR(sonar.max_range, 750 * 10e-6, 1e-12);
  EXPECT_EQ(sonar.frequency, 750e3);
  EXPECT_NEAR(degrees_from_radians(sonar.head.step), -1.8, 1e-9);
  EXPECT_NEAR(degrees_from_radians(sonar.head.sector_width), 360, 1e-9);
}

// From 350 to 50 gradians, across the front: 100 gradians are 90 degrees.
TEST(Ping360FileTest, ASectorIsWhatWasSwept) {
  const WorkingFolder folder;
  folder.write("a.bin", ping_viewer_log(sweep(350, 26, 4)));
  const RotatingScan head = RecordedPings("a.bin").sonar_config().head;
  EXPECT_NEAR(degrees_from_radians(head.step), -3.6, 1e-9);
  EXPECT_NEAR(degrees_from_radians(head.sector_width), 90, 1e-9);
  EXPECT_NEAR(head.sector_center, 0, 1e-9);
  folder.write("b.bin", ping_viewer_log(sweep(50, 26, 4)));
  EXPECT_NEAR(degrees_from_radians(RecordedPings("b.bin").sonar_config().head.sector_center), -90, 1e-9);
}

TEST(Ping360FileTest, LogsOfWindowsAndStreamsOfFramesAreRead) {
  const WorkingFolder folder;
  folder.write("windows.bin", ping_viewer_log({ping360_profile(7, "abcd")}, true));
  EXPECT_THAT(RecordedPings("windows.bin").intensity(0), ElementsAre('a', 'b', 'c', 'd'));
  folder.write("stream.bin", ping360_profile(7, "abcd") + "noise BR" + ping360_auto_profile(8, "efgh"));
  const RecordedPings stream("stream.bin");
  EXPECT_EQ(stream.ping_count(), 2U);
  EXPECT_THAT(stream.intensity(1), ElementsAre('e', 'f', 'g', 'h'));
}

TEST(Ping360FileTest, OtherShapesDamageAndACutEndAreTold) {
  const WorkingFolder folder;
  std::string wrong_sum = ping360_profile(3, "abcd");
  wrong_sum.back() = static_cast<char>(wrong_sum.back() + 1);
  const std::string log = ping_viewer_log({ping360_profile(1, "abcd"), ping360_profile(2, "abcdef"),
                                           ping360_profile(2, "abcd", 200), wrong_sum, ping360_profile(500, "abcd"),
                                           ping360_profile(4, "efgh"), ping360_profile(5, "ijkl")});
  folder.write("a.bin", log.substr(0, log.size() - 3));
  const RecordedPings pings("a.bin");
  EXPECT_EQ(pings.ping_count(), 2U);
  EXPECT_THAT(pings.intensity(1), ElementsAre('e', 'f', 'g', 'h'));
  const std::size_t last = log.size() - ping360_profile(5, "ijkl").size() - 4;
  EXPECT_THAT(
      pings.notes(),
      ElementsAre(
          "2 pings of another range or number of samples than the first left out", "2 messages damaged and left out",
          fmt::format("read until byte {}: a message of 28 bytes is cut off: the file has {}", last, log.size() - 3)));
}

TEST(Ping360FileTest, WrongFilesAreOneMessage) {
  const WorkingFolder folder;
  folder.write("text.bin", "hello, this is text");
  EXPECT_EQ(opening("text.bin"),
            "text.bin: byte 0: the name of the format of 1751477356 bytes must have at most 65545");
  folder.write("named.bin", qt_text("Another program's log file") + big(1));
  EXPECT_EQ(opening("named.bin"), "named.bin: byte 0: does not begin with \"PingViewer sensor log file\"");
  folder.write("head.bin", qt_text("PingViewer sensor log file") + big(1) + big(4'000'000'000));
  EXPECT_EQ(opening("head.bin"), "head.bin: byte 34: a commit of 4000000000 bytes must have at most 65545");
  folder.write("ping1d.bin", ping_viewer_log({ping_frame(1300, "x"), ping_frame(1300, "y")}));
  EXPECT_EQ(opening("ping1d.bin"),
            "ping1d.bin: has no profile of a Ping360 (messages 2300 and 2301); 2 others, 0 damaged");
  folder.write("empty.bin", "");
  EXPECT_EQ(opening("empty.bin"), "empty.bin: the file is empty");
}

}  // namespace
}  // namespace insonify::ping360_file_test
