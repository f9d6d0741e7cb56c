// strangers_files_cli_test.cpp -- commands say in one line what has ended the reader of a file.

#include "apps/cli.h"
#include "support/sanitized.h"

namespace insonify::strangers_files_cli_test {
namespace {

using testing::AnyOf;
using testing::MatchesRegex;

// HDF5 1.10 reads beyond its memory where an address is all ones.
TEST_F(CliTest, BrokenAddressesOfARecordingAreOneMessage) {
  if (kSanitized) {
    GTEST_SKIP() << "A sanitizer ends the reader by an exit status, and has no limit of memory";
  }
  ASSERT_EQ(shell("insonify run fan.yaml -o out --pings 1 --no-pictures").status, 0);
  const std::string whole = text_of("out/ahead.h5");
  int crashes = 0;
  for (const std::size_t place : {120U, 168U, 184U, 200U, 256U}) {
    folder.write("bad.h5", std::string(whole).replace(place, 8, 8, '\xff'));
    for (const char* command :
         {"insonify info bad.h5", "insonify draw bad.h5 -o pictures -f", "insonify export bad.h5 -o a.npz -f"}) {
      const Outcome outcome = shell(command);
      EXPECT_THAT(outcome.status, AnyOf(0, 1, 2)) << command << " " << place;
      if (outcome.status != 0) {
        EXPECT_THAT(outcome.err, MatchesRegex("insonify: bad.h5: [^\n]*\n")) << command << " " << place;
        crashes += outcome.err == "insonify: bad.h5: the reader of HDF5 files crashed (SIGSEGV)\n" ? 1 : 0;
      }
    }
  }
  EXPECT_GT(crashes, 0);
}

TEST_F(CliTest, AWorldWithoutItsReaderIsAnErrorUnlessItIsReadInProcess) {
  const Outcome without = shell("INSONIFY_READER=/none insonify run fan.yaml -o out --pings 1 --no-pictures");
  EXPECT_EQ(without.status, 2);
  EXPECT_EQ(without.err, "insonify: " + (folder.path() / "floor.obj").string() +
                             ": the reader of OBJ files, /none, cannot be started: No such file or directory\n");
  for (const char* command :
       {"INSONIFY_READER=/none insonify --in-process run", "INSONIFY_READER=/none insonify run --in-process",
        "INSONIFY_READER=in-process insonify run"}) {
    EXPECT_EQ(shell(std::string(command) + " fan.yaml -o out --pings 1 --no-pictures -f").status, 0) << command;
  }
}

TEST_F(CliTest, MoreThreadsThanThereIsMemoryForAreOneLine) {
  if (kSanitized) {
    GTEST_SKIP() << "A sanitizer takes more address space";
  }
  for (const int megabytes : {300, 900}) {
    for (const int threads : {64, 1024}) {
      const Outcome outcome = shell(fmt::format(
          "ulimit -v {}; insonify run fan.yaml -o out -q --no-pictures -f --threads {}", megabytes * 1000, threads));
      EXPECT_THAT(outcome.status, AnyOf(0, 1, 2));
      if (outcome.status != 0) {
        EXPECT_THAT(outcome.err,
                    MatchesRegex("insonify: (threads = [0-9]+: only [0-9]+ can be started: Resource temporarily "
                                 "unavailable|out of memory|ended by a thread: pthread_create has failed: Resource "
                                 "temporarily unavailable; fewer threads take less memory)\n"));
      }
      EXPECT_TRUE(threads == 64 || outcome.status != 0);
    }
  }
}

// Processes insonify-read that work in this folder.
std::vector<std::string> readers_here() {
  std::vector<std::string> readers;
  for (const auto& process : std::filesystem::directory_iterator("/proc")) {
    std::error_code ignored;
    if (text_of(process.path() / "comm") == "insonify-read\n" &&
        std::filesystem::read_symlink(process.path() / "cwd", ignored) == std::filesystem::current_path()) {
      readers.push_back(process.path().filename().string());
    }
  }
  return readers;
}

TEST_F(CliTest, AReaderEndsWithTheProcessThatStartedIt) {
  std::string materials, obj = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n";  // assimp takes time for many materials.
  for (int i = 0; i < 60'000; ++i) {
    materials += fmt::format("newmtl a_long_name_of_a_material_{}\n", i);
    obj += fmt::format("usemtl a_long_name_of_a_material_{}\nf 1 2 3\n", i);
  }
  folder.write("a.mtl", materials);
  folder.write("floor.obj", obj);
  const Process run({"run", "fan.yaml", "-o", "out", "--no-pictures"});
  Process::wait_until([] { return !readers_here().empty(); });
  usleep(200'000);  // In the middle of the file.
  EXPECT_EQ(readers_here().size(), 1U);
  run.send(SIGKILL);
  static_cast<void>(run.end());
  Process::wait_until([] { return readers_here().empty(); });
}

}  // namespace
}  // namespace insonify::strangers_files_cli_test
