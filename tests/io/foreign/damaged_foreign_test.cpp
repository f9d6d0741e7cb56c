// damaged_foreign_test.cpp -- whatever the bytes of a foreign file, it is read whole or refused with its name.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "io/foreign/foreign_bytes.h"
#include "io/foreign/foreign_formats.h"
#include "io/picture/grey_picture.h"

namespace insonify::damaged_foreign_test {
namespace {

using testing::StartsWith;

// Seeds of the fuzzer: the first byte says which format follows.
std::vector<std::string> seeds() {
  std::vector<std::string> seeds;
  for (const auto& entry : std::filesystem::directory_iterator(INSONIFY_SOURCE_DIR "/tests/fuzz/seeds/foreign")) {
    seeds.push_back(read_bytes(entry.path()));
  }
  std::ranges::sort(seeds);
  return seeds;
}

// Reads in this process, so that a crash ends the test; true if it was read.
bool reads(const std::filesystem::path& path, const std::string& bytes, bool picture) {
  try {
    if (picture) {
      EXPECT_TRUE(fits(decode_grey(path.string(), bytes)));
      return true;
    }
    const auto tables = foreign_format(path)->open(path, "");
    for (const RecordedTable& table : tables->tables()) {
      EXPECT_EQ(tables->row(table, 0).size(), table.row_bytes());
      EXPECT_EQ(tables->row(table, table.by_ping ? tables->ping_count() - 1 : 0).size(), table.row_bytes());
    }
    return true;
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), StartsWith(path.string() + ": "));
    return false;
  }
}

TEST(DamagedForeignTest, IsReadWholeOrRefused) {
  constexpr const char* kNames[] = {"a.raw", "a.bin", "a.xtf", "a.npy", "a.npz", "a.jpg", "a.pgm"};
  constexpr int kFirstPicture = 5, kRounds = 150;
  const WorkingFolder folder;
  std::mt19937 chance(7);
  const auto up_to = [&](std::size_t most) { return std::uniform_int_distribution<std::size_t>(0, most)(chance); };
  const std::vector<std::string> all = seeds();
  ASSERT_EQ(all.size(), 9U);
  int read = 0, refused = 0;
  for (const std::string& seed : all) {
    const int format = seed[0];
    for (int round = 0; round < kRounds; ++round) {
      std::string bytes = seed.substr(1);
      for (std::size_t changes = round == 0 ? 0 : 1 + up_to(3); changes > 0; --changes) {
        const std::size_t at = up_to(bytes.size() - 1);
        if (up_to(3) == 0) {
          bytes.replace(at, 4, std::string(4, static_cast<char>(up_to(1) == 0 ? 0xff : 0x7f)));
        } else {
          bytes[at] = static_cast<char>(up_to(255));
        }
      }
      if (up_to(9) == 0 && round > 0) {
        bytes.resize(up_to(bytes.size()));
      }
      if (bytes.empty()) {
        continue;
      }
      folder.write(kNames[format], bytes);
      const bool good = reads(kNames[format], bytes, format >= kFirstPicture);
      EXPECT_TRUE(good || round > 0) << kNames[format];
      ++(good ? read : refused);
    }
  }
  EXPECT_GT(read, 200);
  EXPECT_GT(refused, 200);
}

}  // namespace
}  // namespace insonify::damaged_foreign_test
