// damaged_recording_test.cpp -- a damaged HDF5 recording ends in one message with its path, or is read; never in a
// crash.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <stdlib.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <random>

#include "insonify/files.h"
#include "insonify/recorded_pings.h"
#include "insonify/recording_info.h"
#include "insonify/stored_tables.h"
#include "support/message_of.h"
#include "support/sanitized.h"
#include "support/small_recording.h"
#include "support/working_folder.h"

namespace insonify::damaged_recording_test {
namespace {

using testing::AnyOf;
using testing::StartsWith;

const std::string kNone = "no error";  // Answer of message_of() without an error.

class DamagedRecordingTest : public testing::Test {
 protected:
  ~DamagedRecordingTest() override { unsetenv("INSONIFY_LIMITS"); }
  DamagedRecordingTest() {
    setenv("INSONIFY_LIMITS", "memory=1e9", 1);  // Some damage makes HDF5 clear all that a reader may have.
    record_ping([](const Scenario& scenario, const Scene& scene, const SonarConfig& sonar, const Ping& ping) {
      Recording("a.h5", scenario, scene, sonar).add(ping);
    });
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

// Lengths, addresses and numbers of texts that HDF5 follows beyond its memory.
TEST_F(DamagedRecordingTest, TextsThatPointElsewhereEndAtMostTheReader) {
  for (const char* text : {"wreck::hull", "calibrated", "ping bin beam"}) {
    const std::size_t place = reference_to(text);
    ASSERT_NE(place, std::string::npos);
    for (const std::string& damaged :
         {changed<std::uint32_t>(place, 100'000), changed<std::uint64_t>(place + 4, bytes.size() * 3),
          changed<std::uint64_t>(place + 4, ~std::uint64_t{7}), changed<std::uint64_t>(place + 4, 8),
          changed<std::uint64_t>(place + 4, std::uint64_t{1} << 40), changed<std::uint32_t>(place + 12, 60'000),
          changed<std::uint32_t>(place + 12, 1'000'000)}) {
      EXPECT_THAT(read_damaged(damaged), AnyOf(kNone, StartsWith("b.h5: "))) << text;
      EXPECT_THAT(read_tables(damaged), AnyOf(kNone, StartsWith("b.h5: "))) << text;
    }
  }
}

TEST_F(DamagedRecordingTest, BrokenHeapsOfTextsEndAtMostTheReader) {
  const std::size_t heap = bytes.find("GCOL\1");
  ASSERT_NE(heap, std::string::npos);
  for (const std::string& damaged :
       {changed<std::uint64_t>(heap + 8, 1 << 20), changed<std::uint64_t>(heap + 8, 3),
        changed<std::uint64_t>(heap + 16 + 8, 1 << 20), changed<std::uint64_t>(heap + 16 + 8, ~std::uint64_t{0})}) {
    EXPECT_THAT(read_damaged(damaged), StartsWith("b.h5: "));
  }
}

// HDF5 gets memory by the size of a character, and copies the values of an enumeration by the size of one type into
// memory for the other.
TEST_F(DamagedRecordingTest, TypesThatContradictThemselvesEndAtMostTheReader) {
  // A list of variable length (class 9, version 1), text, UTF-8, 16 bytes; and a truth value: an enumeration (class 8,
  // version 1) of 2 words and 1 byte. The type of their characters or numbers follows, its size after 4 bytes.
  for (const std::string& type :
       {std::string("\x19\x01\x01\0\x10\0\0\0\x10", 9), std::string("\x18\x02\0\0\x01\0\0\0\x10", 9)}) {
    int found = 0;
    for (std::size_t place = bytes.find(type); place != std::string::npos; place = bytes.find(type, place + 1)) {
      if (found++ % 20 == 0) {
        for (const std::string& damaged :
             {changed<std::uint32_t>(place + 12, 48), changed<std::uint32_t>(place + 12, 0x7fffffff),
              changed<std::uint32_t>(place + 4, 0x10000), changed<std::uint16_t>(place + 1, 60'000)}) {
          EXPECT_THAT(read_damaged(damaged), AnyOf(kNone, StartsWith("b.h5: "))) << place;
        }
      }
    }
    EXPECT_GT(found, 3);
  }
}

// Addresses in the superblock and in the first object's header and its index.
TEST_F(DamagedRecordingTest, AddressesOfAllOnesEndAtMostTheReader) {
  if (kSanitized) {
    GTEST_SKIP() << "A sanitizer ends the reader by an exit status, and has no limit of memory";
  }
  int crashes = 0;
  for (std::size_t place = 0; place < 512; place += 8) {
    const std::string message = read_damaged(changed<std::uint64_t>(place, ~std::uint64_t{0}));
    EXPECT_THAT(message, AnyOf(kNone, StartsWith("b.h5: "))) << place;
    crashes += message == "b.h5: the reader of HDF5 files crashed (SIGSEGV)" ? 1 : 0;
  }
  EXPECT_TRUE(crashes > 0 || H5_VERSION_GE(1, 14, 0));  // Were there none in 1.10, the reader could be spared.
}

TEST_F(DamagedRecordingTest, RandomDamageIsAMessageOrNothing) {
  constexpr int kSeeds = 70;
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
