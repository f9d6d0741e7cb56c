// survey_test.cpp -- `insonify survey plan`, and runs of surveys.

#include "apps/cli.h"

namespace insonify::survey_test {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;

// Two lines, 6 m apart, at 3 m over the floor of CliTest. The sonar reaches 5 m: 4 m of ground to either side.
class SurveyCliTest : public CliTest {
 protected:
  SurveyCliTest() {
    folder.write("survey.yaml",
                 "world: floor.obj\n"
                 "sonars:\n"
                 "  - {name: side, type: sss, azimuth_aperture_deg: 1, elevation_aperture_deg: 60, max_range: 5,\n"
                 "     bin_count: 40, ping_period: 0.5, sampling: {columns_per_beam: 2, rows: 20}}\n"
                 "pattern:\n"
                 "  lines: {center: [0, 0], length: 20, width: 12, spacing: 6, altitude: 3, speed: 2}\n");
  }
};

TEST_F(SurveyCliTest, PlanHasLinesAndSonars) {
  // A turn is a half circle of 3 m: 9.42 m, 4.7 s. 49.42 m at 2 m/s take 24.7 s, in which the sonar pings 50 times.
  const Outcome outcome = shell("insonify survey plan survey.yaml");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(
      outcome.out,
      HasSubstr("line  from x, y    to x, y     begins  ends  altitude\n"
                "1     -10.0, -3.0  10.0, -3.0  0:00    0:10  3 m\n"
                "2     10.0, 3.0    -10.0, 3.0  0:15    0:25  3 m\n"
                "\n"
                "2 lines, 6 m apart: 40 m on lines, 49.425 m with turns, 0:25 at 2 m/s; steepest 0 deg; pings on "
                "turns too\n"));
  EXPECT_THAT(outcome.out, ContainsRegex("side   50     1 m    [0-9.]+ kB +8 m    25 %     100 %\n"));
}

TEST_F(SurveyCliTest, SwathsThatOnlyTouchOverlapByNothing) {
  const Outcome outcome =
      shell("insonify survey plan survey.yaml --set pattern.lines.spacing=8 --set pattern.lines.width=16");
  EXPECT_THAT(outcome.out, ContainsRegex("8 m    0 %      100 %\n"));
}

TEST_F(SurveyCliTest, PlanIsDrawn) {
  const Outcome outcome =
      shell("insonify survey plan survey.yaml -o plan.png --height 300 && od -An -j20 -N4 -tu1 plan.png");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, ContainsRegex("\nplan.png\n +0 +0 +1 +44\n"));  // 300 = 256 + 44.
}

TEST_F(SurveyCliTest, PlanIsAPng) {
  const Outcome outcome = shell("insonify survey plan survey.yaml -o plan.jpg");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.err, "insonify: --output plan.jpg: must end in .png\n");
  EXPECT_FALSE(std::filesystem::exists("plan.jpg"));
}

// A side-scan's line and its export as XTF: intensities and counts have no scale in common.
TEST_F(SurveyCliTest, WhatHasNoEffectOrCannotShareAChartIsTold) {
  folder.write("fan.yaml", "world: floor.obj\npings: 1\nsonars: [{name: fls, beam_count: 8, bin_count: 10}]\n");
  ASSERT_EQ(shell("insonify run survey.yaml -o a --no-pictures && insonify run fan.yaml -o f --no-pictures && "
                  "insonify export a/side.h5 -o a.xtf")
                .status,
            0);
  const auto told = [](const std::string& line, int status) {
    const Outcome outcome = shell(line);
    EXPECT_EQ(outcome.status, status) << line;
    return outcome.err;
  };
  EXPECT_EQ(told("insonify mosaic a/side.h5 a.xtf -o m.png", 2),
            "insonify: a/side.h5 has intensities (dB re source at 1 m), a.xtf has counts from 0 to 65535: they cannot "
            "share a chart\n");
  EXPECT_THAT(
      told("insonify mosaic a.xtf a.xtf -o m.png", 0),
      HasSubstr("note: a.xtf: its places begin at its first ping; where that lies in the other recordings is not "
                "known\n"));
  EXPECT_EQ(told("insonify draw f/fls.h5 -o d --corrected", 2),
            "insonify: --corrected has no effect on fls, only on waterfalls of side-scan sonars\n");
  EXPECT_EQ(told("insonify draw f/fls.h5 -o d --along distance", 2),
            "insonify: --along has no effect on fls, only on waterfalls of side-scan sonars\n");
  EXPECT_EQ(told("insonify draw a/side.h5 -o d --pictures 3", 0),
            "insonify: note: --pictures 3 has no effect on side: a waterfall shows all pings; --ping chooses them\n");
  EXPECT_EQ(told("insonify compare a/side.h5 a/side.h5 --ping 3", 2),
            "insonify: a/side.h5: its pings are columns of one picture, which needs 11: compare all, without --ping\n");
}

TEST_F(SurveyCliTest, PlanWarnsOfGapsBetweenSwaths) {
  const std::string wide = "--set pattern.lines.spacing=10 --set pattern.lines.width=20";
  EXPECT_EQ(shell("insonify survey plan survey.yaml " + wide).err,
            "insonify: warning: --set pattern.lines.spacing=10: pattern.lines.spacing = 10 m is more than the swath of "
            "side, 8 m at this altitude: there are gaps between lines\n");
  const Outcome level = shell(
      "insonify survey plan survey.yaml --set 'pattern.lines={center: [0, 0], length: 20, width: 20, spacing: 10, "
      "height: "
      "1}'");
  EXPECT_EQ(level.status, 0);
  EXPECT_EQ(level.err,
            "insonify: warning: lines are 10 m apart, the swath of side is 8 m wide: there are gaps between them\n");
}

TEST_F(SurveyCliTest, PlanNeedsAPatternAndABed) {
  const Outcome none = shell("insonify survey plan fan.yaml");
  EXPECT_EQ(none.status, 2);
  EXPECT_EQ(none.err, "insonify: fan.yaml:1:1: pattern is missing: the survey to plan\n");
  const Outcome beyond = shell("insonify survey plan survey.yaml --set pattern.lines.length=60");
  EXPECT_EQ(beyond.status, 2);
  EXPECT_EQ(beyond.err, "insonify: survey.yaml:6:3: pattern.lines: line 1 leaves the terrain at x = -30 m, y = -3 m\n");
  EXPECT_EQ(shell("insonify survey").err, "insonify: survey: name one of plan (insonify survey --help)\n");
}

TEST_F(SurveyCliTest, ARunFliesWhatThePlanSays) {
  EXPECT_THAT(shell("insonify run survey.yaml -o all --no-pictures").out, HasSubstr("side: 50 pings of 2 beams"));
  // Two lines of 10 s.
  EXPECT_THAT(shell("insonify run survey.yaml -o lines --no-pictures --set pattern.lines.turns=skip").out,
              HasSubstr("side: 40 pings of 2 beams"));
}

}  // namespace
}  // namespace insonify::survey_test
