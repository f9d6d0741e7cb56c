// markers_test.cpp -- what an operator has marked is in recordings and in what is exported from them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "insonify/export.h"
#include "insonify/marker.h"
#include "insonify/recording_info.h"
#include "insonify/stored_tables.h"
#include "io/recording/made_recording.h"
#include "support/message_of.h"

namespace insonify::markers_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

const std::vector<Marker>& marked() {
  static const std::vector<Marker> markers = {{"wreck \"stern\"", {1, -2.5, 0.1}, 4.5, "bow", 9, 8.5, "starboard"},
                                              {"Boje ä", {}, 0, "", 0}};
  return markers;
}

void expect_marked(const std::filesystem::path& path) {
  const std::vector<Marker> found = recording_info(path).markers;
  ASSERT_EQ(found.size(), 2U) << path;
  EXPECT_EQ(found[0].name, "wreck \"stern\"");
  EXPECT_EQ(found[0].position, Vec3(1, -2.5, 0.1));
  EXPECT_EQ(found[0].time, 4.5);
  EXPECT_EQ(found[0].sonar, "bow");
  EXPECT_EQ(found[0].ping, 9U);
  EXPECT_EQ(found[0].range, 8.5);
  EXPECT_EQ(found[0].side, "starboard");
  EXPECT_EQ(found[1].range, std::nullopt);
  EXPECT_EQ(found[1].side, "");
  EXPECT_EQ(found[1].name, "Boje ä");
  EXPECT_THAT(StoredTables(path).texts("markers"), ElementsAre(marker_text(marked()[0]), marker_text(marked()[1])));
}

TEST(MarkersTest, AreInARecordingAndInWhatIsExportedFromIt) {
  const auto path = fresh("marked"), mcap = std::filesystem::path(path).replace_extension(".mcap"),
             npz = std::filesystem::path(path).replace_extension(".npz");
  Recording recording(path, scenario(), scene(), large_sonar());
  for (std::uint64_t number = 0; number < 3; ++number) {
    recording.add(make_ping(large_sonar(), number));
  }
  recording.mark({});
  recording.mark(marked());
  recording.close();
  expect_marked(path);
  EXPECT_THAT(verify_recording(path).damaged, IsEmpty());
  EXPECT_EQ(recording_info(path).state, RecordingState::kWhole);
  export_recordings(std::array{path}, mcap, {.replace = true});
  expect_marked(mcap);
  export_recordings(std::array{mcap}, npz, {.replace = true, .compress = false});
  EXPECT_THAT(bytes_of(npz), testing::HasSubstr("markers.npy"));
}

TEST(MarkersTest, LeaveARecordingWithoutThemAsItWas) {
  record(scratch("plain"), fan_sonar(), 2);
  const auto path = fresh("unmarked");
  Recording recording(path, scenario(), scene(), fan_sonar());
  recording.add(make_ping(fan_sonar(), 0));
  recording.add(make_ping(fan_sonar(), 1));
  recording.mark({});
  recording.close();
  EXPECT_EQ(bytes_of(path), bytes_of(scratch("plain")));
  EXPECT_THAT(recording_info(path).markers, IsEmpty());
}

TEST(MarkersTest, ATextThatIsNoneIsRefused) {
  for (const char* text :
       {"", "[]", R"({"name": "a"})", R"({"name":1,"position":[1,2,3],"time":0,"sonar":"","ping":0})",
        R"({"name":"a","position":[1,2],"time":0,"sonar":"","ping":0})",
        R"({"name":"a","position":[1,2,3],"time":0,"sonar":"","ping":0,"range":"far"})"}) {
    EXPECT_EQ(message_of([&] { (void)marker_from_text(text); }),
              "a marker must be a JSON object with name, position, time, sonar and ping")
        << text;
  }
}

}  // namespace
}  // namespace insonify::markers_test
