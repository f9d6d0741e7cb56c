// draw_test.cpp -- `insonify draw`, and what pictures of a run show.

#include <nlohmann/json.hpp>

#include "apps/cli.h"
#include "insonify/ground_truth.h"
#include "insonify/recorded_pings.h"
#include "insonify/stored_tables.h"

namespace insonify::draw_test {
namespace {

using testing::ContainsRegex;
using testing::ElementsAre;
using testing::HasSubstr;

TEST_F(CliTest, PicturesDrawnFromARecordingAreThoseOfTheRun) {
  const std::string paper = "--set model=paper --scale db --floor-db -30";
  for (const std::string& how :
       {std::string(), paper, std::string("--levels -90:-40 --colour-map grey --height 400")}) {
    const std::string drawn = how == paper ? "--scale db --floor-db -30" : how;
    for (const char* sonar : {"fan.yaml", "scan.yaml"}) {
      const Outcome outcome = shell(fmt::format(
          "rm -rf run drawn; insonify run {} -o run -q --no-view --pictures 3 {} && insonify draw run/*.h5 -o drawn "
          "--pictures 3 {} && mv run/*.h5 . && diff -r run drawn",
          sonar, how, drawn));
      EXPECT_EQ(outcome.status, 0) << sonar << how << outcome.err << outcome.out;
    }
  }
}

TEST_F(CliTest, DrawTakesThePingsThatAreNamed) {
  ASSERT_EQ(shell("insonify run fan.yaml -o run -q --no-pictures --pings 5").status, 0);
  const Outcome outcome = shell("insonify draw run/ahead.h5 --ping 1 --ping 3");
  EXPECT_EQ(outcome.out,
            "run/ahead_polar_0001.png\nrun/ahead_fan_0001.png\nrun/ahead_polar_0003.png\nrun/ahead_fan_0003.png\n");
  EXPECT_EQ(shell("insonify draw run/ahead.h5 --ping 1").err,
            "insonify: run/ahead_fan_0001.png exists already, with 3 more of an earlier run: --force replaces them, "
            "-o DIR writes to another folder\n");
  EXPECT_EQ(shell("insonify draw run/ahead.h5 --ping 0 --force").status, 0);
  EXPECT_THAT(files("run"), ElementsAre("ahead.h5", "ahead_fan_0000.png", "ahead_polar_0000.png"));
  const Outcome beyond = shell("insonify draw run/ahead.h5 --ping 5");
  EXPECT_EQ(beyond.status, 2);
  EXPECT_EQ(beyond.err, "insonify: run/ahead.h5: --ping 5 must be below 5, the number of its pings\n");
}

// Bytes 16 to 23 of a PNG are its width and height.
TEST_F(CliTest, PlainPicturesHaveAPixelForEachBinOrTheHeightAskedFor) {
  const std::string size = "od -An -j16 -N8 -tu1 ";
  const auto size_of = [&](const std::string& file) {
    std::istringstream bytes(shell(size + file).out);
    std::array<int, 8> byte{};
    for (int& one : byte) {
      bytes >> one;
    }
    return std::pair(256 * byte[2] + byte[3], 256 * byte[6] + byte[7]);
  };
  ASSERT_EQ(
      shell("insonify run fan.yaml -o run -q --no-pictures --pings 1 --set 'sonars=[{name: ahead, beam_count: 24, "
            "bin_count: 70, "
            "azimuth_aperture_deg: 60, min_range: 1, max_range: 8}]' --set model=calibrated --set receiver.counts=true "
            "--set receiver.full_scale_db=-60")
          .status,
      0);
  ASSERT_EQ(shell("insonify draw run/ahead.h5 -o plain --plain").status, 0);
  EXPECT_EQ(size_of("plain/ahead_polar_0000.png"), std::pair(24, 70));
  EXPECT_EQ(size_of("plain/ahead_fan_0000.png"), std::pair(80, 80));  // 8 m of 0.1 m; 2 sin 30 degrees of them across.
  ASSERT_EQ(shell("insonify draw run/ahead.h5 -o counted --plain --counts").status, 0);
  EXPECT_EQ(size_of("counted/ahead_polar_0000.png"), std::pair(24, 70));
  ASSERT_EQ(shell("insonify draw run/ahead.h5 -o tall --plain --height 300").status, 0);
  EXPECT_EQ(size_of("tall/ahead_polar_0000.png"), std::pair(400, 300));
  EXPECT_EQ(size_of("tall/ahead_fan_0000.png"), std::pair(300, 300));
}

TEST_F(CliTest, MasksHaveThePixelsOfPlainPictures) {
  ASSERT_EQ(shell("insonify run fan.yaml -o run -q --no-pictures --pings 1").status, 0);
  const Outcome outcome = shell("insonify draw run/ahead.h5 -o masks --masks");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(files("masks"),
              ElementsAre("ahead_fan_0000.png", "ahead_instance_fan_0000.png", "ahead_instance_polar_0000.png",
                          "ahead_labels.json", "ahead_material_fan_0000.png", "ahead_material_polar_0000.png",
                          "ahead_polar_0000.png"));
  EXPECT_EQ(
      shell("for shape in fan polar; do for layer in instance material; do cmp <(od -An -j16 -N8 -tu1 "
            "masks/ahead_${shape}_0000.png) <(od -An -j16 -N8 -tu1 masks/ahead_${layer}_${shape}_0000.png) || exit; "
            "done; done")
          .status,
      0);
  const GreyPicture mask = load_grey_picture("masks/ahead_instance_polar_0000.png");
  const StoredTables tables("run/ahead.h5");
  const auto names = nlohmann::json::parse(text_of("masks/ahead_labels.json"));
  EXPECT_TRUE(names["instance"][0].is_null());
  EXPECT_EQ(names["instance"][1], tables.texts("instance_names").at(0));
  const StoredTable& table = *tables.find("instance");
  ASSERT_EQ(mask.values.size(), table.shape[1] * table.shape[2]);
  std::vector<std::uint16_t> labels(mask.values.size());
  tables.read(table, std::array<TableSlice, 3>{{{0, 1}, {0, table.shape[1]}, {0, table.shape[2]}}},
              std::as_writable_bytes(std::span(labels)));
  int seen = 0;
  for (std::size_t bin = 0; bin < table.shape[1]; ++bin) {
    for (std::size_t beam = 0; beam < table.shape[2]; ++beam) {
      const std::uint16_t label = labels[bin * table.shape[2] + beam];
      const std::size_t row = table.shape[1] - 1 - bin;  // The farthest is at the top.
      EXPECT_EQ(std::lround(255 * mask.values[row * table.shape[2] + beam]), label == kNoLabel ? 0 : label + 1);
      seen += label == kNoLabel ? 0 : 1;
    }
  }
  EXPECT_GT(seen, 0);
  EXPECT_EQ(shell("insonify draw run/ahead.h5 -o masks --masks --force").status, 0);
  ASSERT_EQ(shell("insonify run fan.yaml -o none -q --no-pictures --pings 1 --set ground_truth=none").status, 0);
  EXPECT_EQ(shell("insonify draw none/ahead.h5 --masks").err,
            "insonify: none/ahead.h5: --masks: there are no labels in it; HDF5 recordings of a scenario with "
            "ground_truth: labels "
            "have them\n");
}

TEST_F(CliTest, MasksOfAScanAreOfAllItsPings) {
  ASSERT_EQ(shell("insonify run scan.yaml -o run -q --no-pictures && insonify draw run/around.h5 -o masks --masks "
                  "--pictures last")
                .status,
            0);
  EXPECT_THAT(files("masks"), ElementsAre("around_instance_polar.png", "around_instance_scan.png", "around_labels.json",
                                          "around_material_polar.png", "around_material_scan.png", "around_polar.png",
                                          "around_scan.png"));
}

TEST_F(CliTest, PicturesThatAreAllBlackAreToldOf) {
  const Outcome run = shell("insonify run fan.yaml -o run -q --no-view --levels 10:20");
  EXPECT_THAT(run.err, ContainsRegex("warning: the pictures of ahead are black: their brightest point has -[0-9.]+ dB, "
                                     "and --levels begins at 10 dB\n"));
  EXPECT_EQ(shell("insonify draw run/ahead.h5 -o drawn --color-map grey --levels 10:20").err, run.err);
  EXPECT_EQ(shell("insonify draw run/ahead.h5 -o again --levels -190:20").err, "");
}

// Counts of 4 bits, so that pictures of them have at most sixteen colours beside those of texts and lines.
TEST_F(CliTest, CountsAreDrawnByRunAndFromTheRecording) {
  const std::string counted =
      " --set model=calibrated --set receiver.counts=true --set receiver.full_scale_share=0.01 "
      "--set 'sonars[0].bits=4'";
  for (const char* sonar : {"fan.yaml", "scan.yaml"}) {
    const Outcome outcome = shell(fmt::format(
        "rm -rf run drawn; insonify run {} -o run -q --no-view --pictures 3 --counts {} && insonify draw run/*.h5 "
        "-o drawn --pictures 3 --counts && insonify draw run/*.h5 -o levels --force --pictures 3 && mv run/*.h5 . && "
        "diff -r run drawn && ! diff -rq run levels >/dev/null",
        sonar, counted));
    EXPECT_EQ(outcome.status, 0) << sonar << outcome.err << outcome.out;
  }
  const std::string refusal =
      "--counts: the pings of ahead have no counts; receiver.counts: true adds them, in the "
      "calibrated model";
  const Outcome run = shell("insonify run fan.yaml -o without -q --counts");
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr(refusal));
  ASSERT_EQ(shell("insonify run fan.yaml -o without -q --no-pictures").status, 0);
  EXPECT_THAT(shell("insonify draw without/ahead.h5 --counts").err, HasSubstr(refusal));
  EXPECT_EQ(shell("insonify draw without/ahead.h5 --counts --levels -90:-40").status, 2);
}

TEST_F(CliTest, SonarsWithoutCountsBesideOthersShowTheirLevels) {
  const std::string sonars =
      " --set model=calibrated --set 'sonars=[{name: counted, beam_count: 16, bin_count: 50, receiver: "
      "{counts: true}}, {name: side, beam_count: 16, bin_count: 50}]' --set receiver.full_scale_db=-60 --pictures 1 "
      "--no-view";
  const Outcome both = shell("insonify run fan.yaml -o both -q --counts" + sonars);
  EXPECT_EQ(both.status, 0);
  EXPECT_THAT(both.err, HasSubstr("warning: --counts: side has none (receiver.counts); its pictures show levels\n"));
  ASSERT_EQ(shell("insonify run fan.yaml -o levels -q" + sonars).status, 0);
  EXPECT_EQ(shell("cmp both/side_fan_*.png levels/side_fan_*.png").status, 0);
  EXPECT_EQ(shell("insonify draw both/counted.h5 -o drawn --counts --pictures 1 && cmp both/counted_fan_*.png "
                  "drawn/counted_fan_*.png")
                .status,
            0);
}

TEST_F(CliTest, CountsThatAreAllAlikeOrNotRecordedAreToldOf) {
  const std::string run =
      "insonify run fan.yaml -q --no-view --counts --set model=calibrated --set receiver.counts=true ";
  EXPECT_THAT(shell(run + "--set receiver.full_scale_db=-200 -o white").err,
              HasSubstr("warning: the pictures of ahead are white: all counts are 255; full scale is too low\n"));
  EXPECT_THAT(shell(run + "--set receiver.full_scale_db=100 -o black").err,
              HasSubstr("warning: the pictures of ahead are black: all counts are 0\n"));
  ASSERT_EQ(shell(run + "--set receiver.full_scale_db=-60 -o levels --record mcap").status, 0);
  const Outcome drawn = shell("insonify draw levels/ahead.mcap -o drawn --counts");
  EXPECT_EQ(drawn.status, 2);
  EXPECT_EQ(drawn.err,
            "insonify: levels/ahead.mcap: --counts: there are none in it; MCAP recordings hold levels only, HDF5 ones "
            "both\n");
}

TEST_F(CliTest, DrawFailsWhereItCannotWrite) {
  ASSERT_EQ(shell("insonify run fan.yaml -o run -q --no-pictures").status, 0);
  const Outcome outcome = shell("ulimit -f 4; insonify draw run/ahead.h5 -o drawn");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.err, "insonify: drawn/ahead_polar_0000.png: cannot write the picture: File too large\n");
}

TEST_F(CliTest, DrawTellsWhatIsNoRecording) {
  EXPECT_EQ(shell("insonify draw nowhere.h5").err, "insonify: nowhere.h5: no such file\n");
  EXPECT_EQ(shell("insonify draw fan.yaml").status, 2);
}

// A point 20 dB stronger is drawn equally bright, and all else is dark without noise: only the colour bar differs.
TEST_F(CliTest, ColourBarsTellLevels) {
  folder.write("point.yaml", "sonars: [{max_range: 9}]\nreceiver: {noise: false}\npoints: [{position: [6, 0, 0]}]\n");
  ASSERT_EQ(shell("insonify run point.yaml -o weak -q --no-view").status, 0);
  ASSERT_EQ(shell("insonify run point.yaml -o strong -q --no-view --set 'points=[{position: [6, 0, 0], "
                  "target_strength_db: 20}]'")
                .status,
            0);
  ASSERT_EQ(shell("insonify run point.yaml -o again -q --no-view").status, 0);
  EXPECT_EQ(shell("cmp -s weak/sonar_fan_0000.png again/sonar_fan_0000.png").status, 0);
  EXPECT_EQ(shell("cmp -s weak/sonar_fan_0000.png strong/sonar_fan_0000.png").status, 1);
}

TEST_F(CliTest, ViewsMarkPoints) {
  const std::string run = "insonify run fan.yaml -q --pictures none --set model=calibrated";
  ASSERT_EQ(shell(run + " -o without").status, 0);
  ASSERT_EQ(shell(run + " -o with --set 'points=[{position: [6, 0, 0]}]'").status, 0);
  EXPECT_EQ(shell("cmp -s without/ahead_view.png with/ahead_view.png").status, 1);
}

// The view shows the whole sector, whichever edge the head starts from.
TEST_F(CliTest, TheViewOfAScanIsThatOfItsSector) {
  const std::string sector = "insonify run scan.yaml -q --pings 1 --set sector_width_deg=90 --set sector_center_deg=30";
  EXPECT_EQ(shell(sector + " -o forth && " + sector + " -o back --set step_deg=-18").status, 0);
  EXPECT_EQ(shell("cmp forth/around_view.png back/around_view.png").status, 0);
  EXPECT_EQ(shell(sector + " -o aside --set sector_center_deg=-30").status, 0);
  EXPECT_NE(shell("cmp -s forth/around_view.png aside/around_view.png").status, 0);
}

}  // namespace
}  // namespace insonify::draw_test
