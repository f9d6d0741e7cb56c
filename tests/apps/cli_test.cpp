// cli_test.cpp -- the command line as a user meets it: exit codes, messages, files made.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <set>
#include <sstream>

#include "support/scratch_folder.h"

namespace insonify {
namespace {

using testing::ContainsRegex;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

struct Outcome {
  int status = -1;
  std::string out, err;
};

// Runs a line of shell in the current folder; `insonify` in it is ours.
Outcome shell(const std::string& line) {
  const std::string script = fmt::format("insonify() {{ '{}' \"$@\"; }}\n{}", INSONIFY_CLI, line);
  std::ofstream("script.sh") << script;
  FILE* pipe = popen("bash script.sh 2> script.err < /dev/null", "r");
  Outcome outcome;
  std::array<char, 4096> buffer;
  for (std::size_t count = 0; (count = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) {
    outcome.out.append(buffer.data(), count);
  }
  outcome.status = WEXITSTATUS(pclose(pipe));
  std::ostringstream err;
  err << std::ifstream("script.err").rdbuf();
  outcome.err = err.str();
  std::filesystem::remove("script.sh");
  std::filesystem::remove("script.err");
  return outcome;
}

class CliTest : public testing::Test {
 protected:
  CliTest() {
    // A floor of 40 x 40 m, 2 m below the sonar.
    folder.write("floor.obj", "v -20 -20 -2\nv 20 -20 -2\nv 20 20 -2\nv -20 20 -2\nf 1 2 3\nf 1 3 4\n");
    folder.write("fan.yaml",
                 "world: floor.obj\npings: 3\nsonars:\n  - name: ahead\n    beam_count: 16\n    bin_count: 40\n"
                 "    max_range: 12\n    orientation_deg: [0, 20, 0]\n    sampling: {columns_per_beam: 2, rows: 20}\n");
    folder.write(
        "scan.yaml",
        "world: floor.obj\npings: 20\nsonars:\n  - name: around\n    preset: tritech-micron-dst\n"
        "    bin_count: 40\n    max_range: 12\n    step_deg: 18\n    sampling: {columns_per_beam: 2, rows: 20}\n");
  }

  std::set<std::string> files(const std::filesystem::path& in) const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path() / in)) {
      names.insert(entry.path().filename().string());
    }
    return names;
  }

  ScratchFolder folder;
};

// ---------------------------------------------------------------- run

TEST_F(CliTest, RunWritesRecordingAndPictures) {
  const Outcome outcome = shell("insonify run fan.yaml -o out/deep");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(files("out/deep"),
              ElementsAre("ahead.h5", "ahead_fan_0000.png", "ahead_fan_0001.png", "ahead_fan_0002.png",
                          "ahead_polar_0000.png", "ahead_polar_0001.png", "ahead_polar_0002.png", "ahead_view.png"));
  EXPECT_THAT(outcome.out, ContainsRegex("world: 1 object of [0-9]+ triangles, ready in [0-9.]+ s\n"));
  EXPECT_THAT(outcome.out, HasSubstr("ahead: 3 pings of 16 beams x 40 bins to 12 m\n  out/deep/ahead.h5\n"));
  EXPECT_THAT(outcome.out,
              ContainsRegex("3 pings in [0-9.]+ s: [0-9.]+ pings/s to compute, [0-9.]+ pings/s with files"));
}

TEST_F(CliTest, RunOfAScanningSonarDrawsItsTurnAtTheEnd) {
  const Outcome outcome = shell("insonify run scan.yaml -o out --no-view");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(files("out"), ElementsAre("around.h5", "around_polar.png", "around_scan.png"));
  EXPECT_THAT(outcome.out, HasSubstr("around: 20 pings of 1 beam x 40 bins to 12 m\n"));
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

TEST_F(CliTest, OptionsAndSettingsOverrideTheScenario) {
  const Outcome outcome = shell(
      "insonify run fan.yaml -o out --no-pictures --pings 2 --engine reference --threads 1 --seed 9 "
      "--set max_range=6 --set sonars[0].name=short");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("short: 2 pings of 16 beams x 40 bins to 6 m\n"));
}

TEST_F(CliTest, TheSameSeedGivesTheSameFile) {
  const Outcome outcome = shell(
      "insonify run fan.yaml -q --no-pictures -o a --seed 5 && insonify run fan.yaml -q --no-pictures -o b --seed 5 "
      "--threads 3 && insonify run fan.yaml -q --no-pictures -o c --seed 6 && cmp a/ahead.h5 b/ahead.h5 && ! cmp -s "
      "a/ahead.h5 c/ahead.h5");
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
}

TEST_F(CliTest, InAPipeThereAreOnlyPlainLines) {
  EXPECT_THAT(shell("insonify run fan.yaml -o out").out, Not(testing::AnyOf(HasSubstr("\r"), HasSubstr("\x1b"))));
}

TEST_F(CliTest, OnATerminalABarTellsRateAndTimeLeft) {
  const Outcome outcome = shell(
      fmt::format("script -qec \"'{}' run fan.yaml -o out --no-pictures --set pings=3000\" /dev/null", INSONIFY_CLI));
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.out, ContainsRegex("\r\\[#*\\.*\\] [0-9]+/3000 pings  [0-9.]+ pings/s  [0-9]+ s left"));
}

// ---------------------------------------------------------------- What goes wrong

struct Mistake {
  const char* name;
  const char* line;
  int status;
  const char* message;
};

class MistakeTest : public CliTest, public testing::WithParamInterface<Mistake> {};

TEST_P(MistakeTest, IsOneLineAndAnExitStatus) {
  folder.write("wrong.yaml", "world: floor.obj\nsonars:\n  - name: ahead\n    max_rnage: 12\n");
  folder.write("taken", "");
  const Outcome outcome = shell(GetParam().line);
  EXPECT_EQ(outcome.err, GetParam().message + std::string("\n"));
  EXPECT_EQ(outcome.status, GetParam().status);
  EXPECT_EQ(outcome.out, "");
}

constexpr Mistake kMistakes[] = {
    {"NoCommand", "insonify", 2,
     "insonify: name a command; the commands are run, sonars, describe, bench, version (insonify --help)"},
    {"UnknownCommand", "insonify rnu fan.yaml", 2,
     "insonify: there is no command rnu; the commands are run, sonars, describe, bench, version (insonify --help)"},
    {"UnknownOption", "insonify run fan.yaml --frob", 2,
     "insonify: The following argument was not expected: --frob (insonify run --help)"},
    {"UnknownOptionBeforeTheCommand", "insonify --frob", 2,
     "insonify: there is no option --frob; the commands are run, sonars, describe, bench, version (insonify --help)"},
    {"NoScenario", "insonify run", 2, "insonify: SCENARIO is required (insonify run --help)"},
    {"TwoScenarios", "insonify run fan.yaml scan.yaml", 2,
     "insonify: The following argument was not expected: scan.yaml (insonify run --help)"},
    {"MissingScenario", "insonify run nowhere.yaml", 2, "insonify: nowhere.yaml: no such file"},
    {"MeshForAScenario", "insonify run floor.obj", 2,
     "insonify: floor.obj: is a mesh, not a scenario; write a YAML file that says world: floor.obj and lists sonars"},
    {"WrongScenario", "insonify run wrong.yaml", 2,
     "insonify: wrong.yaml:4:5: sonars[0].max_rnage is not a known key; did you mean max_range?"},
    {"WrongSetting", "insonify run fan.yaml --set max_range=-3", 2,
     "insonify: --set max_range=-3: sonars[0].max_range = -3 m must be greater than 0, at most 100000 m"},
    {"NoPings", "insonify run fan.yaml --pings 0", 2,
     "insonify: --pings: 0 must be a whole number, from 1 to 1000000000 (insonify run --help)"},
    {"UnknownEngine", "insonify run fan.yaml --engine gpu", 2,
     "insonify: --engine: gpu must be cpu or reference (insonify run --help)"},
    {"NegativeSeed", "insonify run fan.yaml --seed -1", 2,
     "insonify: --seed: -1 must be a whole number, from 0 to 18446744073709551615 (insonify run --help)"},
    {"WordForThreads", "insonify run fan.yaml --threads many", 2,
     "insonify: --threads: many must be a whole number, from 0 to 1024 (insonify run --help)"},
    {"UnknownPictures", "insonify run fan.yaml --pictures some", 2,
     "insonify: --pictures some must be all, last, none or a number of pings"},
    {"UnknownColourMap", "insonify run fan.yaml --colour-map jet", 2,
     "insonify: colour map \"jet\" must be one of inferno, copper, grey, blue"},
    {"UnknownScale", "insonify run fan.yaml --scale log", 2,
     "insonify: --scale: log must be linear or db (insonify run --help)"},
    {"FloorAboveZero", "insonify run fan.yaml --scale db --floor-db 3", 2,
     "insonify: display.floor_db = 3 dB must be less than 0 dB"},
    {"TinyPicture", "insonify run fan.yaml --height 3", 2,
     "insonify: display.height = 3 pixels must be from 240 to 8192 pixels"},
    {"FolderThatIsAFile", "insonify run fan.yaml -q -o taken", 1,
     "insonify: taken: cannot make this folder: Not a directory"},
    {"FolderInAFile", "insonify run fan.yaml -q -o taken/out", 1,
     "insonify: taken/out: cannot make this folder: Not a directory"},
    {"UnknownPreset", "insonify sonars gemini", 2,
     "insonify: \"gemini\" is not a preset; did you mean tritech-gemini-720i?"},
    {"UnknownMode", "insonify sonars soundmetrics-didson --mode medium", 2,
     "insonify: \"medium\" is not a mode of soundmetrics-didson, which has high and low"},
    {"UnknownSection", "insonify describe sea", 2,
     "insonify: there is no section sea; there are scenario, water, materials, sonars, sampling, receiver, paper, "
     "trajectory, motions, view"},
};

INSTANTIATE_TEST_SUITE_P(All, MistakeTest, testing::ValuesIn(kMistakes),
                         [](const auto& mistake) { return std::string(mistake.param.name); });

// ---------------------------------------------------------------- The other commands

TEST_F(CliTest, VersionNamesTheEngines) {
  const Outcome outcome = shell("insonify version");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.out, ContainsRegex("^insonify [0-9]+\\.[0-9]+\\.[0-9]+\nengines: cpu, reference\n$"));
  EXPECT_EQ(shell("insonify --version").out, outcome.out);
}

TEST_F(CliTest, HelpShowsExamplesAndExitStatus) {
  const Outcome outcome = shell("insonify run --help");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.out, HasSubstr("insonify run scenes/ferry.yaml -o out --pings 3 --set max_range=30"));
  EXPECT_THAT(outcome.out, HasSubstr("0 done, 1 failed while running or stopped, 2 wrong input"));
}

TEST_F(CliTest, SonarsListsEveryModeOfEveryPreset) {
  const Outcome outcome = shell("insonify sonars");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.out, ContainsRegex("\nblueprint-oculus-m750d +low \\* +fls +750 +512 +130 x 20 +0.1 - 120\n"));
  EXPECT_THAT(outcome.out, ContainsRegex("\n +high +fls +1200 +512 +70 x 12 +0.1 - 40\n"));
  EXPECT_THAT(outcome.out, ContainsRegex("\ntritech-micron-dst +standard +msis +700 +1 +3 x 35 +0.3 - 75\n"));
}

TEST_F(CliTest, SonarsTellsConfidenceAndSourceOfEachFact) {
  const Outcome outcome = shell("insonify sonars tritech-gemini-720i");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.out, ContainsRegex("\nbeam_count +256 +A +Cerqueira et al."));
  EXPECT_THAT(outcome.out, ContainsRegex("\nrange_resolution +0.008 +m +B +Tritech data sheet, recalled\n"));
}

TEST_F(CliTest, DescribeTellsUnitLimitsDefaultAndMeaning) {
  const Outcome outcome = shell("insonify describe water");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.out, ContainsRegex("  temperature_c = 10 degC +from -6 to 35\n      Water temperature.\n"));
}

TEST_F(CliTest, TheReferencePageIsUpToDate) {
  std::ostringstream page;
  page << std::ifstream(INSONIFY_SOURCE_DIR "/docs/reference/scenario.md").rdbuf();
  EXPECT_EQ(shell("insonify describe --markdown").out, page.str())
      << "docs/reference/scenario.md: made by insonify describe --markdown; make it again";
}

}  // namespace
}  // namespace insonify
