// cli_test.cpp -- `insonify run`: exit codes, messages and output files.

#include "apps/cli.h"

#include "io/h5_read.h"

namespace insonify::cli_test {
namespace {

using testing::ContainsRegex;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

// In a folder that others can write to, anyone may have put links under the names that a run uses.
TEST_F(CliTest, ARunFollowsNoLinkThatItFindsInItsFolder) {
  folder.write("target", "precious");
  std::filesystem::create_directory("out");
  const std::set<std::string> names{"ahead.h5", "ahead_fan_0002.png", "ahead_polar_0002.png", "ahead_view.png"};
  for (const std::string& name : names) {
    std::filesystem::create_symlink("../target", "out/" + name);
    std::filesystem::create_symlink("../target", "out/" + name + ".new");
  }
  EXPECT_EQ(shell("insonify run fan.yaml -o out -q --pictures 1").status, 2);
  EXPECT_EQ(shell("insonify run fan.yaml -o out -q --pictures 1 --force").status, 0);
  EXPECT_EQ(text_of("target"), "precious");
  for (const std::string& name : names) {
    EXPECT_FALSE(std::filesystem::is_symlink("out/" + name)) << name;
    EXPECT_TRUE(std::filesystem::exists("out/" + name)) << name;
  }
}

TEST_F(CliTest, PicturesThatAKilledRunHadBegunAreRemoved) {
  folder.write("out/ahead_fan_0002.png.0123abcd.new", "half a picture");
  folder.write("out/ahead.png.0123abcd.new", "somebody else's");
  EXPECT_EQ(shell("insonify run fan.yaml -o out --no-pictures -q").status, 0);
  EXPECT_EQ(files("out"), (std::set<std::string>{"ahead.h5", "ahead.png.0123abcd.new"}));
}

TEST_F(CliTest, RunWritesRecordingAndPictures) {
  const Outcome outcome = shell("insonify run fan.yaml -o out/deep");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(files("out/deep"),
              ElementsAre("ahead.h5", "ahead_fan_0000.png", "ahead_fan_0001.png", "ahead_fan_0002.png",
                          "ahead_polar_0000.png", "ahead_polar_0001.png", "ahead_polar_0002.png", "ahead_view.png"));
  EXPECT_THAT(outcome.out,
              ContainsRegex("world: 1 object of 2 triangles, 40 x 40 x 0 m \\(x -20 to 20, y -20 to 20, z -2 to -2\\), "
                            "ready in [0-9.]+ s\n"));
  EXPECT_THAT(outcome.out,
              ContainsRegex(
                  "ahead: 3 pings of 16 beams x 40 bins to 12 m; first ping: echoes of 1 of 1 object, from [0-9.]+ to "
                  "[0-9.]+ m\n  out/deep/ahead.h5\n"));
  EXPECT_THAT(outcome.out,
              ContainsRegex("3 pings in [0-9.]+ s: [0-9.]+ pings/s to compute, [0-9.]+ pings/s with files"));
}

TEST_F(CliTest, RunOfAScanningSonarDrawsItsTurnAsItGoesOn) {
  const Outcome outcome = shell("insonify run scan.yaml -o out --no-view --pictures 4");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(files("out"), ElementsAre("around.h5", "around_polar.png", "around_scan.png", "around_scan_0004.png",
                                        "around_scan_0009.png", "around_scan_0014.png"));
  EXPECT_THAT(outcome.out,
              HasSubstr("around: 20 pings of 1 beam x 40 bins to 12 m; first ping: echoes of 1 of 1 object"));
}

TEST_F(CliTest, RunLastsAsLongAsItsSettingsSay) {
  EXPECT_THAT(shell("insonify run fan.yaml --no-pictures -o a --duration 0.5 --set ping_period=0.1").out,
              HasSubstr("ahead: 5 pings of"));
  EXPECT_THAT(shell("insonify run scan.yaml --no-pictures -o b --turns 2").out, HasSubstr("around: 40 pings of"));
  const Outcome both = shell("insonify run fan.yaml --no-pictures -o c --duration 2 --pings 3");
  EXPECT_EQ(both.status, 2);
  EXPECT_THAT(both.err, HasSubstr("--pings excludes --duration"));
  folder.write("both.yaml", "world: floor.obj\npings: 1\nduration: 3\nsonars: [{name: ahead}]\n");
  EXPECT_EQ(shell("insonify run both.yaml").err,
            "insonify: both.yaml:3:1: duration says when pings end, as pings = 1 does; leave one out\n");
}

TEST_F(CliTest, RunTellsOfRecordingsThatAKilledRunLeft) {
  folder.write("out/ahead.h5.0123abcd.new", "unfinished");
  folder.write("out/another.h5.0123abcd.new", "somebody else's");
  EXPECT_EQ(
      shell("insonify run fan.yaml --no-pictures -o out").err,
      "insonify: warning: out/ahead.h5.0123abcd.new is an unfinished recording, of a run that was killed or is still "
      "running\n");
}

TEST_F(CliTest, RunWritesBesideTheUserWhenNoFolderIsNamed) {
  EXPECT_EQ(shell("insonify run fan.yaml --no-pictures -q").status, 0);
  EXPECT_THAT(files("fan_pings"), ElementsAre("ahead.h5"));
}

TEST_F(CliTest, QuietRunSaysNothing) {
  const Outcome outcome = shell("insonify run fan.yaml --no-pictures --quiet -o out");
  EXPECT_EQ(outcome.out + outcome.err, "");
}

TEST_F(CliTest, RunDrawsAsManyPingsAsAreAskedFor) {
  EXPECT_EQ(shell("insonify run fan.yaml -o two --pings 10 --pictures 2 --no-view").status, 0);
  EXPECT_THAT(files("two"), ElementsAre("ahead.h5", "ahead_fan_0004.png", "ahead_fan_0009.png", "ahead_polar_0004.png",
                                        "ahead_polar_0009.png"));
  EXPECT_EQ(shell("insonify run fan.yaml -o last --pings 4 --pictures last --no-view").status, 0);
  EXPECT_THAT(files("last"), ElementsAre("ahead.h5", "ahead_fan_0003.png", "ahead_polar_0003.png"));
}

TEST_F(CliTest, PicturesOfAnEarlierRunAreRemoved) {
  ASSERT_EQ(shell("insonify run fan.yaml -o out -q").status, 0);
  for (const char* other : {"ahead_fan_12.png", "ahead_notes_0001.png", "behind_fan_0001.png", "ahead_fan_0001.jpg"}) {
    folder.write(std::filesystem::path("out") / other, "mine");
  }
  const Outcome outcome = shell("insonify run fan.yaml -o out --pings 1 --no-view --force");
  EXPECT_THAT(outcome.out, HasSubstr("\nremoved 7 pictures of an earlier run from out\n"));
  EXPECT_THAT(files("out"), ElementsAre("ahead.h5", "ahead_fan_0000.png", "ahead_fan_0001.jpg", "ahead_fan_12.png",
                                        "ahead_notes_0001.png", "ahead_polar_0000.png", "behind_fan_0001.png"));
}

TEST_F(CliTest, ARunReplacesNothingUnlessItIsForcedTo) {
  ASSERT_EQ(shell("insonify run fan.yaml -o out -q && cp -r out before").status, 0);
  const Outcome outcome = shell("insonify run fan.yaml -o out --seed 2");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.err,
            "insonify: out/ahead.h5 exists already, with 7 more of an earlier run: --force replaces them, -o DIR "
            "writes to another folder\n");
  EXPECT_EQ(shell("diff -r out before").status, 0);
  ASSERT_EQ(shell("rm out/*.png").status, 0);
  EXPECT_EQ(shell("insonify run fan.yaml -o out --seed 2").err,
            "insonify: out/ahead.h5 exists already: --force replaces it, -o DIR writes to another folder\n");
  ASSERT_EQ(
      shell("insonify run fan.yaml -o out -q --seed 2 --force && insonify run fan.yaml -o other -q --seed 2").status,
      0);
  EXPECT_EQ(shell("diff -r out other").status, 0);
}

// A file of at most 204 800 bytes holds the first pings.
TEST_F(CliTest, AForcedRunThatFailsLeavesTheEarlierOneAlone) {
  ASSERT_EQ(shell("insonify run fan.yaml -o out -q && cp -r out before").status, 0);
  const Outcome outcome = shell("ulimit -f 200; insonify run fan.yaml -o out -q --force --pings 1000 --no-view");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.err,
              testing::MatchesRegex(
                  "insonify: out/ahead.h5: cannot write ping ([0-9]+): File too large; those before it stay readable; "
                  "out/ahead.h5 is still that of the earlier run, [0-9]+ pings of this one are in "
                  "out/ahead.h5.[0-9a-f]+.new\n"));
  EXPECT_EQ(
      shell("diff -r out before").out, "Only in out: " + [&] {
        for (const std::string& file : files("out")) {
          if (file.ends_with(".new")) {
            return file + "\n";
          }
        }
        return std::string("nothing");
      }());
}

TEST_F(CliTest, ARunThatFailsBeforeTheFirstPingLeavesNothing) {
  const Outcome outcome =
      shell("ulimit -f 1000; insonify run fan.yaml -o out -q --height 240 --set beam_count=256 --set bin_count=2000");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.err, "insonify: out/ahead.h5: cannot write ping 0: File too large\n");
  EXPECT_THAT(files("out"), ElementsAre());
}

TEST_F(CliTest, ALinkIsAnEarlierRecordingToo) {
  std::filesystem::create_directory("out");
  std::filesystem::create_symlink("/not/mounted/ahead.h5", "out/ahead.h5");
  EXPECT_EQ(shell("insonify run fan.yaml -q -o out").status, 2);
  EXPECT_TRUE(std::filesystem::is_symlink("out/ahead.h5"));
}

TEST_F(CliTest, ASettingTakesTheViewAway) {
  EXPECT_EQ(shell("insonify run fan.yaml -q --no-pictures --set view=null").status, 0);
}

TEST_F(CliTest, OptionsAndSettingsOverrideTheScenario) {
  const Outcome outcome = shell(
      "insonify run fan.yaml -o out --no-pictures --pings 2 --engine reference --threads 1 --seed 9 "
      "--set max_range=6 --set sonars[0].name=short");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              HasSubstr("short: 2 pings of 16 beams x 40 bins to 6 m; first ping: echoes of 1 of 1 object, from "));
}

TEST_F(CliTest, TheSameSeedGivesTheSameFile) {
  const Outcome outcome = shell(
      "insonify run fan.yaml -q --no-pictures -o a --seed 5 && insonify run fan.yaml -q --no-pictures -o b --seed 5 "
      "--threads 3 && insonify run fan.yaml -q --no-pictures -o c --seed 6 && cmp a/ahead.h5 b/ahead.h5 && ! cmp -s "
      "a/ahead.h5 c/ahead.h5");
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
}

TEST_F(CliTest, CompressedRecordingsHoldTheSame) {
  const Outcome outcome = shell(
      "insonify run fan.yaml -q --no-pictures -o a --pings 5 && insonify run fan.yaml -q --no-pictures -o b --pings 5 "
      "--compress");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const H5Reader plain("a/ahead.h5"), compressed("b/ahead.h5");
  EXPECT_EQ(plain.values<float>("intensity"), compressed.values<float>("intensity"));
  EXPECT_EQ(plain.values<std::uint16_t>("instance"), compressed.values<std::uint16_t>("instance"));
  EXPECT_EQ(plain.values<double>("time"), compressed.values<double>("time"));
  EXPECT_LT(compressed.storage("instance"), plain.storage("instance") / 4);
}

TEST_F(CliTest, InAPipeThereAreOnlyPlainLines) {
  EXPECT_THAT(shell("insonify run fan.yaml -o out").out, Not(testing::AnyOf(HasSubstr("\r"), HasSubstr("\x1b"))));
}

TEST_F(CliTest, OnATerminalABarTellsRateAndTimeLeft) {
  const Outcome outcome = shell(fmt::format(
      "TERM=xterm script -qec \"'{}' run fan.yaml -o out --no-pictures --set pings=3000\" /dev/null", INSONIFY_CLI));
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.out, ContainsRegex("\r\\[#*\\.*\\] [0-9]+/3000 pings  [0-9.]+ pings/s  [0-9]+ s left"));
}

TEST_F(CliTest, ANarrowTerminalGetsWhatFitsIt) {
  const Outcome outcome = shell(fmt::format(
      "TERM=xterm script -qec \"stty cols 40; '{}' run fan.yaml -o out --no-pictures --pings 3000\" /dev/null",
      INSONIFY_CLI));
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.out, HasSubstr("\rLoading fan.yaml ...\x1b[K"));
  EXPECT_THAT(outcome.out, ContainsRegex("\r\\[#*\\.*\\] [0-9]+/3000 pings  [0-9]+ s left"));
  std::istringstream drawn(outcome.out);
  for (std::string line; std::getline(drawn, line, '\r');) {
    if (const std::size_t end = line.find("\x1b[K"); end != std::string::npos) {
      EXPECT_LT(end, 40U) << line;
    }
  }
}

TEST_F(CliTest, ADumbTerminalGetsPlainLines) {
  const Outcome outcome =
      shell(fmt::format("TERM=dumb script -qec \"'{}' run fan.yaml -o out --no-pictures\" /dev/null", INSONIFY_CLI));
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.out, Not(HasSubstr("\x1b")));
}

}  // namespace
}  // namespace insonify::cli_test
