// about_test.cpp -- `insonify version`, `sonars`, `describe` and help.

#include "apps/cli.h"

namespace insonify::about_test {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;

TEST_F(CliTest, VersionNamesTheEngines) {
  const Outcome outcome = shell("insonify version");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(
      outcome.out,
      ContainsRegex("^insonify [0-9]+\\.[0-9]+\\.[0-9]+\nengines: cpu, gpu, reference\ndevices of engine gpu: .+\n$"));
  EXPECT_EQ(shell("insonify --version").out, outcome.out);
}

TEST_F(CliTest, HelpShowsExamplesAndExitStatus) {
  const Outcome outcome = shell("insonify run --help");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.out, HasSubstr("insonify run scenes/ferry.yaml -o out --pings 3 --set max_range=30"));
  EXPECT_THAT(outcome.out, HasSubstr("0 done, 1 failed while running or stopped, 2 wrong input"));
}

TEST_F(CliTest, TheFirstLineOfHelpWorksInAnEmptyFolder) {
  const std::string help = shell("insonify --help").out;
  const std::string words = "Start with:  ";
  const std::size_t start = help.find(words);
  ASSERT_NE(start, std::string::npos);
  const std::string line = help.substr(start + words.size(), help.find('\n', start) - start - words.size());
  EXPECT_EQ(line, "insonify run sphere");
  const Outcome outcome = shell(line + " --pings 1 --no-pictures -q");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(files("sphere_pings").size(), 1U) << outcome.out;
}

TEST_F(CliTest, AFileIsRunRatherThanASceneOfItsName) {
  folder.write("ferry", "");
  EXPECT_EQ(shell("insonify run ferry").err, "insonify: ferry: the file is empty\n");
}

TEST_F(CliTest, ScenesAreListedWithWhatTheyShow) {
  const Outcome outcome = shell("insonify scenes");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.out, ContainsRegex("\nferry +A wrecked ferry, seen by a forward-looking sonar that closes in"));
  EXPECT_THAT(outcome.out, ContainsRegex("\nferry_calibrated +the same in the calibrated model\n"));
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
  EXPECT_EQ(shell("insonify describe --markdown").out, text_of(INSONIFY_SOURCE_DIR "/docs/reference/scenario.md"))
      << "docs/reference/scenario.md: made by insonify describe --markdown; make it again";
}

}  // namespace
}  // namespace insonify::about_test
