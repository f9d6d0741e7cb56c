// damaged_recordings_cli_test.cpp -- recordings that are cut short, damaged or read-only, as a user meets them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "apps/recordings_cli.h"

namespace insonify::damaged_recordings_cli_test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class DamagedRecordingsCliTest : public RecordingsCliTest {};

TEST_F(DamagedRecordingsCliTest, ARunOnAFullDiskLeavesAFileThatSaysSo) {
  // A limit on files, in blocks of 1024 bytes, stands for the end of the disk.
  const Outcome run = shell("ulimit -f 900; insonify run fan.yaml -o out -q --no-pictures --record mcap --pings 1000");
  EXPECT_EQ(run.status, 1);
  EXPECT_EQ(run.err,
            "insonify: out/ahead.mcap: cannot write: File too large; what was written before stays readable\n");
  const json told = info("out/ahead.mcap");
  EXPECT_EQ(told.at("state"), "disk_full");
  EXPECT_GT(told.at("sonars").at(0).at("pings"), 0);
  EXPECT_THAT(shell("insonify info out/ahead.mcap").out, HasSubstr(" MB, cut short: the disk was full\n"));
  const Outcome exported = shell("insonify export out/ahead.mcap -o x.npz --store");
  EXPECT_EQ(exported.status, 0);
  EXPECT_THAT(exported.err, HasSubstr("warning: out/ahead.mcap is cut short: the disk was full; it has "));
  // An export that does not fit leaves nothing, and says no more.
  const Outcome full = shell("ulimit -f 30; insonify export out/ahead.mcap -o y.mcap");
  EXPECT_EQ(full.status, 1);
  EXPECT_THAT(full.err, testing::EndsWith("insonify: y.mcap: cannot write: File too large\n"));
  EXPECT_EQ(files(".").count("y.mcap"), 0);
}

// Damage that only the pings show, after the recording was opened, is wrong input too.
TEST_F(DamagedRecordingsCliTest, DamagedPingsAreWrongInput) {
  ASSERT_EQ(shell("insonify run fan.yaml -o out -q --no-pictures --pings 3 --record mcap").status, 0);
  std::string bytes = text_of("out/ahead.mcap");
  const std::size_t packed = bytes.find("zstd") + 100;  // In the first chunk, behind its head.
  bytes[packed] = static_cast<char>(bytes[packed] ^ 1);
  folder.write("bad.mcap", bytes);
  for (const char* command : {"draw {} -o drawn -f", "replay {} -o drawn -f", "export {} -o a.npz -f"}) {
    const Outcome outcome = shell("insonify " + fmt::format(fmt::runtime(command), "bad.mcap"));
    EXPECT_EQ(outcome.status, 2) << command;
    EXPECT_THAT(outcome.err, testing::MatchesRegex("insonify: bad.mcap: chunk [0-9] is damaged\n")) << command;
  }
  EXPECT_FALSE(std::filesystem::exists("a.npz"));
}

TEST_F(DamagedRecordingsCliTest, VerifyReadsEveryPingAndSaysWhichIsDamaged) {
  for (const char* compress : {"", "--compress"}) {
    ASSERT_EQ(
        shell(fmt::format("insonify run fan.yaml -o out -q --no-pictures -f --pings 3 --record h5,mcap {}", compress))
            .status,
        0);
    for (const char* name : {"out/ahead.h5", "out/ahead.mcap"}) {
      const Outcome whole = shell(fmt::format("insonify info {} --verify", name));
      EXPECT_EQ(whole.status, 0) << whole.err;
      EXPECT_THAT(whole.out, HasSubstr(" rows can be read, with the checksums that they were written with\n"));
      EXPECT_EQ(json::parse(shell(fmt::format("insonify info {} --verify --json", name)).out)
                    .at(0)
                    .at("verified")
                    .at("damaged")
                    .size(),
                0U);
    }
    // Each ping's chunk is where it was written: the last of the largest table.
    std::string bytes = text_of("out/ahead.h5");
    bool seen = false;
    for (std::size_t at = bytes.size() / 2; at < bytes.size() && !seen; at += 997) {
      std::string damaged = bytes;
      damaged[at] = static_cast<char>(damaged[at] ^ 1);
      folder.write("bad.h5", damaged);
      const Outcome outcome = shell("insonify info bad.h5 --verify");
      seen = outcome.err.find("bad.h5: damaged: ") != std::string::npos;
      if (seen) {
        EXPECT_EQ(outcome.status, 2);
        EXPECT_THAT(outcome.err,
                    testing::MatchesRegex("(insonify: bad.h5: damaged: [a-z_]+ of ping [0-2]: [^\n]+\n)+"));
        const Outcome exported = shell("insonify export bad.h5 -o a.npz -f");
        EXPECT_EQ(exported.status, 2);
        EXPECT_THAT(exported.err, testing::MatchesRegex("insonify: bad.h5: cannot read [a-z_]+: [^\n]+\n"));
      }
    }
    EXPECT_TRUE(seen);
  }
  std::string bytes = text_of("out/ahead.mcap");
  bytes[bytes.find("zstd") + 1000] ^= 1;
  folder.write("bad.mcap", bytes);
  const Outcome outcome = shell("insonify info bad.mcap --verify");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("bad.mcap: "));
}

TEST_F(DamagedRecordingsCliTest, ReadOnlyRecordingsStay) {
  ASSERT_EQ(shell("insonify run fan.yaml -o out -q --no-pictures --record h5,mcap").status, 0);
  for (const char* name : {"ahead.h5", "ahead.mcap"}) {
    const std::filesystem::path path = std::filesystem::path("out") / name;
    const std::string before = text_of(path);
    std::filesystem::permissions(path, std::filesystem::perms::owner_read);
    const Outcome run = shell("insonify run fan.yaml -o out -q --no-pictures --record h5,mcap --force --seed 5");
    EXPECT_EQ(run.status, 1);
    EXPECT_EQ(run.err, "insonify: " + path.string() + ": cannot create: it exists and is read-only\n");
    EXPECT_EQ(text_of(path), before);
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  }
}

}  // namespace
}  // namespace insonify::damaged_recordings_cli_test
