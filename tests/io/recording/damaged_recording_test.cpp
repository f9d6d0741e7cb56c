// damaged_recording_test.cpp -- a damaged HDF5 recording ends in one message with its path, or is read; never in a
// crash.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <random>

#include "insonify/files.h"
#include "insonify/mesh.h"
#include "insonify/recorded_pings.h"
#include "insonify/recording_info.h"
#include "insonify/stored_tables.h"
#include "support/message_of.h"
#include "support/working_folder.h"

namespace insonify::damaged_recording_test {
namespace {

using testing::AnyOf;
using testing::HasSubstr;
using testing::StartsWith;

const std::string kNone = "no error";  // Answer of message_of() without an error.

class DamagedRecordingTest : public testing::Test {
 protected:
  DamagedRecordingTest() {
    Scenario scenario;
    scenario.text = "world: nothing.sdf\n";
    SonarConfig sonar;
    sonar.name = "ahead";
    sonar.bin_count = 3;
    sonar.beam_count = 4;
    Scene scene;
    scene.instances.push_back({.name = "wreck::hull", .mesh = std::make_shared<const Mesh>(make_sphere(1))});
    assign_materials(scene, {});
    {
      Recording recording("a.h5", scenario, scene, sonar);
      Ping ping;
      ping.bin_count = 3;
      ping.beam_count = 4;
      ping.intensity.assign(12, 0.25F);
      ping.instance.assign(12, 0);
      ping.material.assign(12, 0);
      ping.elevation.assign(12, 0.5F);
      recording.add(ping);
    }
    std::ifstream file("a.h5", std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(file), {});
  }

  // Writes the damaged file and reads all of it that insonify reads.
  static std::string read_damaged(const std::string& damaged) {
    std::ofstream("b.h5", std::ios::binary) << damaged;
    return message_of([] {
      static_cast<void>(recording_info("b.h5"));
      const RecordedPings pings("b.h5");
      static_cast<void>(pings.receiver_config());
      for (std::uint64_t i = 0; i < std::min<std::uint64_t>(pings.ping_count(), 2); ++i) {
        static_cast<void>(pings.ping(i));
      }
      const StoredTables tables("b.h5");
      static_cast<void>(tables.texts("instance_names"));
    });
  }

  // The same by what Python reads with.
  static std::string read_tables(const std::string& damaged) {
    std::ofstream("b.h5", std::ios::binary) << damaged;
    return message_of([] { static_cast<void>(StoredTables("b.h5").texts("instance_names")); });
  }

  // The 16 bytes that refer to a text: length, address of its heap, number in it.
  [[nodiscard]] std::size_t reference_to(const std::string& text) const {
    for (std::size_t heap = bytes.find("GCOL\1"); heap != std::string::npos; heap = bytes.find("GCOL\1", heap + 1)) {
      const std::size_t end = heap + number<std::uint64_t>(heap + 8);
      for (std::size_t object = heap + 16; object + 16 < end && number<std::uint16_t>(object) != 0;
           object += 16 + (number<std::uint64_t>(object + 8) + 7) / 8 * 8) {
        if (bytes.compare(object + 16, number<std::uint64_t>(object + 8), text + '\0') == 0 ||
            bytes.compare(object + 16, number<std::uint64_t>(object + 8), text) == 0) {
          std::string reference(16, '\0');
          const auto length = static_cast<std::uint32_t>(number<std::uint64_t>(object + 8));
          const auto address = static_cast<std::uint64_t>(heap);
          const auto index = static_cast<std::uint32_t>(number<std::uint16_t>(object));
          std::memcpy(reference.data(), &length, 4);
          std::memcpy(reference.data() + 4, &address, 8);
          std::memcpy(reference.data() + 12, &index, 4);
          return bytes.find(reference);
        }
      }
    }
    return std::string::npos;
  }

  template <typename Number>
  [[nodiscard]] Number number(std::size_t place) const {
    Number value;
    std::memcpy(&value, bytes.data() + place, sizeof value);
    return value;
  }

  template <typename Number>
  [[nodiscard]] std::string changed(std::size_t place, Number value) const {
    std::string copy = bytes;
    std::memcpy(copy.data() + place, &value, sizeof value);
    return copy;
  }

  const WorkingFolder folder;
  std::string bytes;
};

TEST_F(DamagedRecordingTest, AWholeRecordingIsRead) {
  EXPECT_EQ(read_damaged(bytes), kNone);
}

TEST_F(DamagedRecordingTest, TextsOfDatasetsMustBeWhereTheyPoint) {
  const std::size_t names = reference_to("wreck::hull");
  ASSERT_NE(names, std::string::npos);
  const std::string damaged = "b.h5: instance_names is damaged: ";
  EXPECT_EQ(read_damaged(changed<std::uint32_t>(names, 100'000)), damaged + "its text is not in the heap of texts");
  EXPECT_EQ(read_damaged(changed<std::uint64_t>(names + 4, bytes.size() * 3)),
            damaged + "it points past the end of the file");
  EXPECT_EQ(read_damaged(changed<std::uint64_t>(names + 4, ~std::uint64_t{7})),
            damaged + "it points past the end of the file");
  EXPECT_EQ(read_damaged(changed<std::uint64_t>(names + 4, 8)), damaged + "it points to no heap of texts");
  EXPECT_EQ(read_damaged(changed<std::uint32_t>(names + 12, 60'000)), damaged + "its text is not in the heap of texts");
  EXPECT_EQ(read_damaged(changed<std::uint32_t>(names + 12, 1'000'000)),
            damaged + "its text is not in the heap of texts");
}

TEST_F(DamagedRecordingTest, StoredTablesCheckTheirTextsThemselves) {
  EXPECT_EQ(read_tables(bytes), kNone);
  const std::size_t names = reference_to("wreck::hull");
  EXPECT_EQ(read_tables(changed<std::uint32_t>(names + 12, 60'000)),
            "b.h5: instance_names is damaged: its text is not in the heap of texts");
  const std::size_t axes = reference_to("ping bin beam");
  ASSERT_NE(axes, std::string::npos);
  EXPECT_THAT(read_tables(changed<std::uint32_t>(axes, 100'000)),
              HasSubstr(" is damaged: its text is not in the heap of texts"));
}

TEST_F(DamagedRecordingTest, TextsOfAttributesMustBeWhereTheyPoint) {
  const std::size_t model = reference_to("calibrated");
  ASSERT_NE(model, std::string::npos);
  const std::string damaged = "b.h5: the file is damaged: ";
  EXPECT_EQ(read_damaged(changed<std::uint32_t>(model, 3)), damaged + "its text is not in the heap of texts");
  EXPECT_EQ(read_damaged(changed<std::uint64_t>(model + 4, std::uint64_t{1} << 40)),
            damaged + "it points past the end of the file");
  EXPECT_EQ(read_damaged(changed<std::uint32_t>(model + 12, 30'000)), damaged + "its text is not in the heap of texts");
}

TEST_F(DamagedRecordingTest, HeapsOfTextsMustBeWhole) {
  const std::size_t heap = bytes.find("GCOL\1");
  ASSERT_NE(heap, std::string::npos);
  EXPECT_THAT(read_damaged(changed<std::uint64_t>(heap + 8, 1 << 20)),
              HasSubstr(" is damaged: it points past the end of the file"));
  EXPECT_THAT(read_damaged(changed<std::uint64_t>(heap + 8, 3)),
              HasSubstr(" is damaged: it points to no heap of texts"));
  EXPECT_THAT(read_damaged(changed<std::uint64_t>(heap + 16 + 8, 1 << 20)),
              HasSubstr(" is damaged: its heap of texts has an object larger than itself"));
  EXPECT_THAT(read_damaged(changed<std::uint64_t>(heap + 16 + 8, ~std::uint64_t{0})),
              HasSubstr(" is damaged: its heap of texts has an object larger than itself"));
}

TEST_F(DamagedRecordingTest, CharactersOfTextsMustHaveOneByte) {
  // A list of variable length (class 9, version 1), text, UTF-8, 16 bytes; then the type of its characters, whose size
  // follows after 4 bytes.
  const std::string text("\x19\x01\x01\0\x10\0\0\0", 8);
  int found = 0, refused = 0;
  for (std::size_t type = bytes.find(text); type != std::string::npos; type = bytes.find(text, type + 1)) {
    ASSERT_EQ(number<std::uint32_t>(type + 12), 1);
    if (found++ % 5 == 0) {
      // Nothing is said of a note that is not read.
      const std::string message = read_damaged(changed<std::uint32_t>(type + 12, 48));
      EXPECT_THAT(message, AnyOf(kNone, HasSubstr(" is damaged: its characters do not have 1 byte"))) << type;
      EXPECT_THAT(read_damaged(changed<std::uint32_t>(type + 12, 0x7fffffff)),
                  AnyOf(kNone, HasSubstr(" is damaged: a number has more than 64 bytes")))
          << type;
      refused += message == kNone ? 0 : 1;
    }
  }
  EXPECT_GT(refused, 5);
}

// HDF5 copies the values of an enumeration by the size of one type into memory for the other: 3 of 3700 files with
// random damage ended it so.
TEST_F(DamagedRecordingTest, WordsMustBeNumbersOfTheirType) {
  // A truth value: an enumeration (class 8, version 1) of 2 words and 1 byte, then the type of its numbers, whose size
  // follows after 4 bytes.
  const std::string truth("\x18\x02\0\0\x01\0\0\0\x10", 9);
  int found = 0;
  for (std::size_t type = bytes.find(truth); type != std::string::npos; type = bytes.find(truth, type + 1), ++found) {
    ASSERT_EQ(number<std::uint32_t>(type + 12), 1);
    if (found % 5 != 0) {
      continue;
    }
    const std::string message = "is damaged: its words are not numbers of their type";
    EXPECT_THAT(read_damaged(changed<std::uint32_t>(type + 12, 32)), HasSubstr(message)) << type;
    EXPECT_THAT(read_damaged(changed<std::uint32_t>(type + 4, 0x10000)), HasSubstr(message)) << type;
    EXPECT_THAT(read_damaged(changed<std::uint8_t>(type + 8, 0x13)), HasSubstr(message)) << type;  // Texts.
    EXPECT_THAT(read_damaged(changed<std::uint16_t>(type + 1, 60'000)),
                testing::AnyOf(HasSubstr("is damaged: its type is longer than its message"),
                               HasSubstr("is damaged: a name in its type does not end")))
        << type;
  }
  EXPECT_GT(found, 3);
}

TEST_F(DamagedRecordingTest, RandomDamageIsAMessageOrNothing) {
  constexpr int kSeeds = 300;
  int refused = 0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    std::mt19937 random(static_cast<std::uint32_t>(seed));
    std::string damaged = bytes;
    // Flips bytes anywhere, from one to half a hundred.
    const int flips = 1 << (seed % 7);
    for (int i = 0; i < flips; ++i) {
      damaged[random() % damaged.size()] = static_cast<char>(random());
    }
    SCOPED_TRACE(seed);
    static_cast<void>(read_tables(damaged));
    const std::string message = read_damaged(damaged);
    EXPECT_THAT(message, AnyOf(kNone, StartsWith("b.h5")));
    EXPECT_EQ(message.find('\n'), std::string::npos);
    refused += message == kNone ? 0 : 1;
  }
  EXPECT_GT(refused, kSeeds / 10);  // Else the damage would not reach what is read.
  EXPECT_LT(refused, kSeeds);
}

}  // namespace
}  // namespace insonify::damaged_recording_test
