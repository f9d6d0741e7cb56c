// cli_streams_test.cpp -- closed and full streams, full disks, and scenarios read from a pipe.

#include "apps/cli.h"

namespace insonify::cli_streams_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

using CliStreamsTest = CliTest;

TEST_F(CliStreamsTest, ARecordingDoesNotTakeThePlaceOfAClosedStream) {
  ASSERT_EQ(shell("insonify run fan.yaml --no-pictures -o a").status, 0);
  for (const char* closed : {">&-", "2>&-", "<&-", "<&- >&- 2>&-"}) {
    const Outcome outcome =
        shell(fmt::format("insonify run fan.yaml --no-pictures --force -o b {} && cmp a/ahead.h5 b/ahead.h5", closed));
    EXPECT_EQ(outcome.status, 0) << closed << outcome.out;
  }
}

TEST_F(CliStreamsTest, WhatCannotBeSaidIsAnError) {
  constexpr const char* kFull = "insonify: standard output: cannot write: No space left on device\n";
  for (const char* command : {"describe", "sonars", "sonars tritech-micron-dst", "version", "--version", "--help",
                              "run --help", "run fan.yaml --no-pictures"}) {
    const Outcome outcome = shell(fmt::format("insonify {} > /dev/full", command));
    EXPECT_EQ(outcome.status, 1) << command;
    EXPECT_EQ(outcome.err, kFull) << command;
  }
  EXPECT_EQ(files("fan_pings"), std::set<std::string>{"ahead.h5"});
}

TEST_F(CliStreamsTest, AReaderThatHasGoneIsNoError) {
  EXPECT_EQ(shell("insonify describe | head -n 1 > first").err, "");
  // SIGPIPE is ignored, as in children of Python: the write fails instead of ending the program.
  EXPECT_EQ(shell("(trap '' PIPE; insonify describe) | true").err, "");
}

TEST_F(CliStreamsTest, AnErrorThatCannotBeToldStillIsAnExitStatus) {
  EXPECT_EQ(shell("insonify run nowhere.yaml 2> /dev/full").status, 2);
  EXPECT_EQ(shell("insonify run nowhere.yaml 2>&-").status, 2);
  EXPECT_EQ(shell("insonify run fan.yaml -o a -q --no-pictures --set orientation_deg=[0,-90,0] 2> /dev/full").status,
            0);
}

TEST_F(CliStreamsTest, AFileThatMayNotGrowIsOneLine) {
  const Outcome outcome = shell("ulimit -f 8; insonify run fan.yaml -q -o out --no-pictures");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.err, "insonify: out/ahead.h5: cannot create: File too large\n");
  EXPECT_THAT(files("out"), IsEmpty());
}

TEST_F(CliStreamsTest, AFullDiskIsOneLineAndKeepsWhatWasRecorded) {
  const char* with_disk =
      "mkdir small && unshare -m bash -c 'mount -t tmpfs -o size={}k none small || exit 77; \"{}\" run fan.yaml -q -o "
      "small --no-pictures --pings 1000; status=$?; cp small/* . 2> /dev/null; exit $status'; status=$?; rmdir small; "
      "exit $status";
  for (const int kilobytes : {4, 8, 16, 40, 64}) {
    const Outcome outcome = shell(fmt::format(fmt::runtime(with_disk), kilobytes, INSONIFY_CLI));
    if (outcome.status == 77 || outcome.err.find("unshare") != std::string::npos) {
      GTEST_SKIP() << "a small disk can only be made by root";
    }
    EXPECT_EQ(outcome.status, 1) << kilobytes;
    EXPECT_THAT(outcome.err, testing::MatchesRegex(
                                 "insonify: warning: small: the recordings need [0-9.]+ MB, [0-9.]+ kB are free; a "
                                 "full disk ends the run, which keeps the pings made so far\ninsonify: "
                                 "small/ahead.h5: cannot create: No space left on device\n"))
        << kilobytes;
  }
  const Outcome outcome = shell(fmt::format(fmt::runtime(with_disk), 400, INSONIFY_CLI));
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.err,
              testing::MatchesRegex("insonify: warning: small: the recordings need [0-9.]+ MB, [0-9]+ kB are "
                                    "free; a full disk ends the run, which keeps the pings made so far\n"
                                    "insonify: small/ahead.h5: cannot write ping [0-9]+: No space left on "
                                    "device; those before it stay readable\n"));
}

TEST_F(CliStreamsTest, APictureLeavesAFolderOfItsNameAlone) {
  folder.write("out/ahead_fan_0001.png/mine", "");
  const Outcome outcome = shell("insonify run fan.yaml -q -o out --no-view");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.err,
            "insonify: out/ahead_fan_0001.png: cannot write the picture: it exists and is not a regular file\n");
  EXPECT_THAT(files("out/ahead_fan_0001.png"), ElementsAre("mine"));
}

// A pipe has a name anybody may give it, in a world as well, and perhaps never a writer.
TEST_F(CliStreamsTest, APipeIsNoOtherInput) {
  ASSERT_EQ(shell("mkfifo pipe.obj pipe.csv pipe.h5").status, 0);
  EXPECT_EQ(shell("insonify run fan.yaml --set world=pipe.obj").err,
            fmt::format("insonify: {}: is a named pipe, not a file\n",
                        (std::filesystem::current_path() / "pipe.obj").string()));
  EXPECT_EQ(shell("insonify run fan.yaml --set trajectory=pipe.csv").err,
            "insonify: --set trajectory=pipe.csv: pipe.csv: is a named pipe, not a file\n");
  for (const std::string command : {"draw", "replay", "info", "compare pipe.h5", "export -o x.npz"}) {
    EXPECT_EQ(shell("timeout 10 " INSONIFY_CLI " " + command + " pipe.h5").err,
              "insonify: pipe.h5: is a named pipe, not a file\n")
        << command;
  }
}

TEST_F(CliStreamsTest, AScenarioMayComeThroughAPipe) {
  for (const char* line :
       {"insonify run /dev/stdin -o a --no-pictures < fan.yaml",
        "cat fan.yaml | insonify run /dev/stdin -o b --no-pictures", "insonify run <(cat fan.yaml) -o c --no-pictures",
        "mkfifo pipe; cat fan.yaml > pipe & insonify run pipe -o d --no-pictures"}) {
    const Outcome outcome = shell(line);
    EXPECT_EQ(outcome.status, 0) << line << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("ahead: 3 pings of 16 beams")) << line;
  }
  EXPECT_THAT(shell("insonify run <(cat fan.yaml) -o out --no-pictures").out,
              StartsWith("reading the scenario from /dev/fd/"));
}

}  // namespace
}  // namespace insonify::cli_streams_test
