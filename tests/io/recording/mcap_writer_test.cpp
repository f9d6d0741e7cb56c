// mcap_writer_test.cpp -- records of MCAP files: chunks in time, replacing files, full disks, reading back.

#include "io/mcap/mcap_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>
#include <sstream>

#include "insonify/recording_info.h"
#include "io/mcap/mcap_reader.h"
#include "support/message_of.h"
#include "support/working_folder.h"

namespace insonify::mcap_writer_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::byte> bytes_of(const std::string& text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

// The files of the current folder.
std::vector<std::string> files() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(".")) {
    names.push_back(entry.path().filename().string());
  }
  std::ranges::sort(names);
  return names;
}

class McapWriterTest : public testing::Test {
 protected:
  WorkingFolder folder;
};

// Adds a single message.
void add(McapWriter& out, std::uint16_t channel, std::uint64_t time, const std::vector<std::byte>& bytes) {
  const McapWriter::Message message{channel, bytes};
  out.add(time, std::span(&message, 1));
}

TEST_F(McapWriterTest, BytesOfTheStartAreThoseOfTheSpecification) {
  McapWriter("a.mcap", "us", false).close();
  // Magic; opcode 1, a length of 4 + 4 + 4 + 2 bytes, profile and library with their lengths.
  EXPECT_EQ(text_of("a.mcap").substr(0, 31),
            std::string("\x89MCAP0\r\n\x01\x0e\0\0\0\0\0\0\0\x04\0\0\0ros2\x02\0\0\0us", 31));
  EXPECT_TRUE(text_of("a.mcap").ends_with("\x89MCAP0\r\n"));
}

TEST_F(McapWriterTest, ReadsBackWhatWasWritten) {
  McapWriter out("a.mcap", "us", false);
  out.add_metadata("about", {{"seed", "7"}, {"", "x"}});
  const auto first = out.add_channel("/a", "p/msg/A", "int32 a\n");
  const auto second = out.add_channel("/b", "p/msg/A", "int32 a\n");
  EXPECT_EQ(out.add_channel("/a", "p/msg/A", "int32 a\n"), first);
  add(out, second, 5, bytes_of("five"));
  add(out, first, 3, bytes_of(""));
  add(out, second, 9, bytes_of("nine"));
  out.close();
  const McapReader in("a.mcap");
  EXPECT_TRUE(in.is_whole());
  EXPECT_EQ(in.metadata().at("about").at("seed"), "7");
  EXPECT_EQ(in.topics().at("/b"), "p/msg/A");
  ASSERT_EQ(in.messages("/b").size(), 2);
  EXPECT_EQ(in.messages("/b")[1].time, 9);
  EXPECT_EQ(in.read(in.messages("/b")[1]), bytes_of("nine"));
  EXPECT_EQ(in.read(in.messages("/a")[0]), bytes_of(""));
  EXPECT_TRUE(in.messages("/c").empty());
}

TEST_F(McapWriterTest, AChunkHasMessagesOfHalfASecond) {
  McapWriter out("a.mcap", "us", false);
  const auto channel = out.add_channel("/a", "p/msg/A", "int32 a\n");
  const auto written = [] { return McapReader("a.mcap").messages("/a").size(); };
  add(out, channel, 1, bytes_of("one"));
  add(out, channel, McapWriter::kLongestChunkNs, bytes_of("two"));
  EXPECT_EQ(written(), 0U);
  add(out, channel, 1 + McapWriter::kLongestChunkNs, bytes_of("three"));
  EXPECT_EQ(written(), 3U);
  EXPECT_FALSE(McapReader("a.mcap").is_whole());
  add(out, channel, 2 * McapWriter::kLongestChunkNs, bytes_of("four"));
  EXPECT_EQ(written(), 3U);
  out.close();
  EXPECT_EQ(written(), 4U);
}

TEST_F(McapWriterTest, LargeChunksDoNotWait) {
  McapWriter out("a.mcap", "us", false);
  const auto channel = out.add_channel("/a", "p/msg/A", "int32 a\n");
  add(out, channel, 1, std::vector<std::byte>(5'000'000, std::byte{3}));
  EXPECT_EQ(McapReader("a.mcap").messages("/a").size(), 1);
}

TEST_F(McapWriterTest, MessagesOfAPingAreInOneChunk) {
  McapWriter out("a.mcap", "us", false);
  const auto channel = out.add_channel("/a", "p/msg/A", "int32 a\n");
  const std::vector<McapWriter::Message> ping(3, {channel, std::vector<std::byte>(2'000'000, std::byte{3})});
  out.add(7, ping);  // More than a chunk usually holds.
  out.add(8, ping);
  out.close();
  const McapReader in("a.mcap");
  std::vector<std::size_t> chunks;
  for (const McapReader::Entry& entry : in.messages("/a")) {
    chunks.push_back(entry.chunk);
  }
  EXPECT_THAT(chunks, ElementsAre(0, 0, 0, 1, 1, 1));
}

TEST_F(McapWriterTest, ADestroyedWriterLeavesAWholeFile) {
  {
    McapWriter out("a.mcap", "us", false);
    add(out, out.add_channel("/a", "p/msg/A", "int32 a\n"), 1, bytes_of("one"));
  }
  EXPECT_TRUE(McapReader("a.mcap").is_whole());
}

TEST_F(McapWriterTest, ReplacesAnEarlierFileOnlyWhenClosed) {
  folder.write("a.mcap", "earlier");
  EXPECT_EQ(message_of([] { McapWriter("a.mcap", "us", false); }), "a.mcap: cannot create: it exists already");
  {
    McapWriter out("a.mcap", "us", true);
    EXPECT_NE(out.place(), "a.mcap");
    add(out, out.add_channel("/a", "p/msg/A", "int32 a\n"), 1, bytes_of("one"));
  }
  EXPECT_EQ(text_of("a.mcap"), "earlier");
  EXPECT_EQ(files().size(), 2);  // The new one stays beside it.
  { McapWriter unused("a.mcap", "us", true); }
  EXPECT_EQ(files().size(), 2);
  McapWriter out("a.mcap", "us", true);
  out.close();
  EXPECT_TRUE(McapReader("a.mcap").is_whole());
}

TEST_F(McapWriterTest, AnOnlyWholeFileLeavesNothingUnlessClosed) {
  {
    McapWriter out("a.mcap", "us", false, true);
    add(out, out.add_channel("/a", "p/msg/A", "int32 a\n"), 1, bytes_of("one"));
    EXPECT_FALSE(std::filesystem::exists("a.mcap"));
  }
  EXPECT_TRUE(files().empty());
}

TEST_F(McapWriterTest, TwoWritersDoNotShareAFile) {
  const McapWriter one("a.mcap", "us", false);
  EXPECT_EQ(message_of([] { McapWriter("a.mcap", "us", true); }),
            "a.mcap: cannot create: another run is writing it; choose another folder");
}

TEST_F(McapWriterTest, ATopicHasOneType) {
  McapWriter out("a.mcap", "us", false);
  (void)out.add_channel("/a", "p/msg/A", "int32 a\n");
  EXPECT_EQ(message_of([&] { (void)out.add_channel("/a", "p/msg/B", "int32 b\n"); }),
            "a.mcap: topic /a cannot be p/msg/A and p/msg/B");
}

TEST_F(McapWriterTest, SaysSoWhenItsFileIsRemoved) {
  McapWriter out("a.mcap", "us", false);
  const auto channel = out.add_channel("/a", "p/msg/A", "int32 a\n");
  add(out, channel, 1, bytes_of("one"));
  std::filesystem::remove("a.mcap");
  EXPECT_THAT(message_of([&] { out.close(); }), HasSubstr("a.mcap: no longer exists"));
}

// Bytes that cannot be compressed.
std::vector<std::byte> noise(std::size_t count, std::uint32_t state = 1) {
  std::vector<std::byte> bytes(count);
  for (std::byte& value : bytes) {
    state = state * 1664525 + 1013904223;
    value = static_cast<std::byte>(state >> 24U);
  }
  return bytes;
}

// Runs in a process of its own, whose files may have so many bytes: a limit on files stands for the end of a disk.
template <typename Function>
bool holds_with_files_of(rlim_t bytes, Function&& function) {
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{bytes, bytes};
    setrlimit(RLIMIT_FSIZE, &limit);
    _exit(function() ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return status == 0;
}

TEST_F(McapWriterTest, AFullDiskKeepsTheChunksBefore) {
  EXPECT_TRUE(holds_with_files_of(100'000, [] {
    McapWriter out("a.mcap", "us", false);
    const auto channel = out.add_channel("/a", "p/msg/A", "int32 a\n");
    add(out, channel, 1, std::vector<std::byte>(4'200'000, std::byte{1}));
    const std::string wanted = "a.mcap: cannot write: File too large; what was written before stays readable";
    // It stays full: what comes next is refused for the same reason.
    return message_of([&] { add(out, channel, 2, noise(4'200'000)); }) == wanted &&
           message_of([&] { add(out, channel, 3, {}); }) == wanted && message_of([&] { out.close(); }) == wanted;
  }));
  const McapReader in("a.mcap");
  EXPECT_EQ(in.messages("/a").size(), 1);
  EXPECT_EQ(in.read(in.messages("/a")[0]).size(), 4'200'000);
  EXPECT_TRUE(in.is_whole());
  EXPECT_EQ(in.metadata().at("insonify:end").at("reason"), "File too large");
}

TEST_F(McapWriterTest, AFullDiskKeepsThePingsThatFit) {
  EXPECT_TRUE(holds_with_files_of(100'000, [] {
    McapWriter out("a.mcap", "us", false);
    const auto channel = out.add_channel("/a", "p/msg/A", "int32 a\n");
    return message_of([&] {
             for (std::uint64_t time = 1; time <= 4; ++time) {
               add(out, channel, time, noise(40'000, static_cast<std::uint32_t>(time)));  // Two of them fit.
             }
           }) == "a.mcap: cannot write: File too large; what was written before stays readable";
  }));
  const McapReader in("a.mcap");
  ASSERT_EQ(in.messages("/a").size(), 2);
  EXPECT_EQ(in.messages("/a")[1].time, 2);
  EXPECT_EQ(in.read(in.messages("/a")[1]), noise(40'000, 2));
  EXPECT_TRUE(in.is_whole());
  EXPECT_LE(std::filesystem::file_size("a.mcap"), 100'000);
}

TEST_F(McapWriterTest, AnOnlyWholeFileLeavesNothingOnAFullDiskAndSaysNothingElse) {
  EXPECT_TRUE(holds_with_files_of(100'000, [] {
    McapWriter out("a.mcap", "us", false, true);
    const auto channel = out.add_channel("/a", "p/msg/A", "int32 a\n");
    add(out, channel, 1, std::vector<std::byte>(4'200'000, std::byte{1}));
    const bool refused =
        message_of([&] { add(out, channel, 2, noise(4'200'000)); }) == "a.mcap: cannot write: File too large";
    return refused;
  }));
  EXPECT_FALSE(std::filesystem::exists("a.mcap"));
}

TEST_F(McapWriterTest, ReadersRefuseWhatIsBroken) {
  folder.write("text.mcap", "world: none\n");
  EXPECT_EQ(message_of([] { McapReader("text.mcap"); }), "text.mcap: is no MCAP file");
  EXPECT_EQ(message_of([] { McapReader("none.mcap"); }), "none.mcap: no such file");
  {
    McapWriter out("a.mcap", "us", false);
    add(out, out.add_channel("/a", "p/msg/A", "int32 a\n"), 1, bytes_of("one"));
  }
  const std::string whole = text_of("a.mcap");
  EXPECT_EQ(message_of([] { (void)recording_info("a.mcap"); }),
            "a.mcap: was not recorded by insonify: it has no metadata insonify");
  // However it is cut or changed: an error or a reader, never a crash.
  for (std::size_t i = 8; i < whole.size(); ++i) {
    std::string broken = whole;
    broken[i] = static_cast<char>(broken[i] ^ 0x41);
    std::filesystem::remove("broken.mcap");  // Some file systems wait for the disk when a file is cut to nothing.
    folder.write("broken.mcap", broken);
    const std::string changed = message_of([] { McapReader("broken.mcap"); });
    EXPECT_TRUE(changed == "no error" || changed.starts_with("broken.mcap: ")) << changed;
    std::filesystem::remove("cut.mcap");
    folder.write("cut.mcap", whole.substr(0, i));
    const std::string cut = message_of([] { McapReader("cut.mcap"); });
    EXPECT_EQ(cut, "no error") << i;
  }
}

}  // namespace
}  // namespace insonify::mcap_writer_test
