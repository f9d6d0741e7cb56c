// mcap_pings_test.cpp -- MCAP files that are well-formed but tell nonsense are refused in one line.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "insonify/mcap_recording.h"
#include "insonify/recorded_pings.h"
#include "insonify/stored_tables.h"
#include "io/mcap/mcap_metadata.h"
#include "io/mcap/mcap_reader.h"
#include "io/mcap/mcap_writer.h"
#include "io/message/encode.h"
#include "support/message_of.h"
#include "support/working_folder.h"

namespace insonify {
namespace {

using Texts = std::map<std::string, std::string>;

class McapPingsTest : public testing::Test {
 protected:
  // A recording of one ping of 3 bins x 2 beams.
  McapPingsTest() {
    SonarConfig sonar;
    sonar.name = "fls";
    sonar.beam_count = 2;
    sonar.bin_count = 3;
    sonar.max_range = 9;
    sonar.assumed_sound_speed = 1500;
    McapRecording out("good.mcap", {MessageSource{sonar, EchoModel::kCalibrated, {}, "pings: 1\n", {}}});
    Ping ping;
    ping.bin_count = 3;
    ping.beam_count = 2;
    ping.intensity.assign(6, 1e-8F);
    out.add(0, ping);
    out.close();
  }

  // Writes the same file with some texts of the sonar's metadata changed, or with another sonar image.
  static void write_changed(const Texts& changes, const std::vector<std::byte>& image = {}) {
    const McapReader good("good.mcap");
    std::filesystem::remove("a.mcap");
    McapWriter out("a.mcap", "us", false);
    for (auto [name, texts] : good.metadata()) {
      if (name == "insonify/fls") {
        for (const auto& [key, value] : changes) {
          texts[key] = value;
        }
      }
      out.add_metadata(name, texts);
    }
    std::vector<McapWriter::Message> messages;
    for (const auto& [topic, type] : good.topics()) {
      const std::vector<std::byte> bytes = good.read(good.messages(topic).front());
      const bool changed = topic == "/fls/sonar_image" && !image.empty();
      messages.push_back({out.add_channel(topic, type, ""), changed ? image : bytes});
    }
    out.add(0, messages);
    out.close();
  }

  static std::string refusal() {
    return message_of([] { (void)RecordedPings("a.mcap").ping(0); });
  }
  static std::string refusal(const Texts& changes) {
    write_changed(changes);
    return refusal();
  }

  const WorkingFolder folder;
};

TEST_F(McapPingsTest, AnUnchangedFileIsRead) {
  EXPECT_EQ(refusal({}), "no error");
  EXPECT_NEAR(RecordedPings("a.mcap").ping(0).intensity[5], 1e-8, 1e-8 * 2e-4);  // 0.0005 dB is a factor of 1.0001.
}

TEST_F(McapPingsTest, LevelsMustBeNumbers) {
  namespace key = mcap_metadata;
  EXPECT_EQ(refusal({{key::kScale, "loud"}}), "a.mcap: its metadata scale is \"loud\", must be db or linear");
  EXPECT_EQ(refusal({{key::kLowDb, "nan"}}), "a.mcap: its metadata low_db is \"nan\", must be a finite number");
  EXPECT_EQ(refusal({{key::kHighDb, "-inf"}}), "a.mcap: its metadata high_db is \"-inf\", must be a finite number");
  EXPECT_EQ(refusal({{key::kHighDb, "-40 dB"}}), "a.mcap: its metadata high_db is \"-40 dB\", must be a finite number");
  EXPECT_EQ(refusal({{key::kGainPerDecade, "3e5"}}),
            "a.mcap: its metadata gain_per_decade = 300000 must be from -1000 to 1000");
}

TEST_F(McapPingsTest, SettingsMustBeThoseOfASonar) {
  namespace key = mcap_metadata;
  EXPECT_THAT(refusal({{key::kSettings, "sonars: 7\n"}}), testing::StartsWith("a.mcap: its metadata settings: "));
  EXPECT_EQ(refusal({{key::kSettings, "world: none\nsonars: [{beam_count: 2}, {beam_count: 2, name: b}]\n"}}),
            "a.mcap: its metadata settings: it has 2 sonars, must have one");
  EXPECT_EQ(refusal({{key::kSettings, "world: none\nsonars: [{name: fls, beam_count: 4, bin_count: 3}]\n"}}),
            "a.mcap: ping 0 of fls: it has 6 values, must have 3 x 4");
}

TEST_F(McapPingsTest, ValuesMustBeOfATypeThatIsWritten) {
  SonarImageFacts facts;
  facts.directions.resize(2, Vec3::UnitZ());
  const std::vector<std::uint16_t> values(6, 7);
  const std::vector<std::byte> good =
      encode_sonar_image(MessageForm::kRos2, {}, facts, std::span<const std::uint16_t>(values));
  write_changed({}, good);
  EXPECT_EQ(refusal(), "no error");
  // The message ends in: is_bigendian, 3 bytes to align, dtype, beam_count, number of bytes, 12 bytes.
  std::vector<std::byte> wrong = good;
  wrong.at(good.size() - 12 - 12) = std::byte{9};
  write_changed({}, wrong);
  EXPECT_EQ(refusal(),
            "a.mcap: ping 0 of fls: its values are of type 9, must be of 0 (uint8) or 2 (uint16), "
            "little-endian");
  wrong = good;
  wrong.at(good.size() - 12 - 16) = std::byte{1};
  write_changed({}, wrong);
  EXPECT_EQ(refusal(),
            "a.mcap: ping 0 of fls: its values are big-endian, of type 2, must be of 0 (uint8) or 2 (uint16), "
            "little-endian");
  write_changed({}, {good.begin(), good.begin() + 40});
  EXPECT_EQ(refusal(), "a.mcap: ping 0 of fls: a message ends too early");
  wrong = good;
  wrong.at(good.size() - 12 - 4) = std::byte{0xff};  // More bytes of values than the message has.
  write_changed({}, wrong);
  EXPECT_EQ(refusal(), "a.mcap: ping 0 of fls: a message ends too early");
}

TEST_F(McapPingsTest, ABlockOutsideTheTableIsRefused) {
  const StoredTables tables("good.mcap");
  std::vector<std::byte> bytes(4);
  const std::vector<TableSlice> outside = {{1, 1}, {0, 1}, {0, 1}};
  EXPECT_EQ(message_of([&] { tables.read(*tables.find("intensity"), outside, bytes); }),
            "good.mcap: intensity does not have that block");
  EXPECT_EQ(tables.find("instance"), nullptr);
  EXPECT_TRUE(tables.texts("instance_names").empty());
}

}  // namespace
}  // namespace insonify
