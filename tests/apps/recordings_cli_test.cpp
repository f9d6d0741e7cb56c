// recordings_cli_test.cpp -- insonify run --record, info, replay and export, as a user calls them.

#include "apps/recordings_cli.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace insonify::recordings_cli_test {
namespace {

using nlohmann::json;
using testing::AnyOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

TEST_F(RecordingsCliTest, RecordChoosesTheFiles) {
  EXPECT_EQ(shell("insonify run fan.yaml -o h5 -q --no-pictures").status, 0);
  EXPECT_EQ(shell("insonify run fan.yaml -o mcap -q --no-pictures --record mcap").status, 0);
  EXPECT_EQ(shell("insonify run fan.yaml -o both -q --no-pictures --record h5,mcap").status, 0);
  EXPECT_EQ(shell("insonify run fan.yaml -o turned -q --no-pictures --record mcap,h5").status, 0);
  EXPECT_THAT(files("h5"), ElementsAre("ahead.h5"));
  EXPECT_THAT(files("mcap"), ElementsAre("ahead.mcap"));
  EXPECT_THAT(files("both"), ElementsAre("ahead.h5", "ahead.mcap"));
  EXPECT_EQ(files("turned"), files("both"));
  EXPECT_EQ(text_of("turned/ahead.h5"), text_of("h5/ahead.h5"));
  EXPECT_EQ(text_of("both/ahead.mcap"), text_of("mcap/ahead.mcap"));
  EXPECT_EQ(text_of("both/ahead.h5"), text_of("h5/ahead.h5"));
}

// A world with an include that is missing and walls that are ignored; what remains is a ball.
void write_pool(const WorkingFolder& folder) {
  folder.write("pool.sdf", R"(<sdf version='1.7'><world name='pool'>
  <include><uri>model://gone</uri></include>
  <model name='box_walls'><pose>3 0 0 0 0 0</pose><static>true</static><link name='l'><visual name='v'>
    <geometry><box><size>0.1 9 9</size></box></geometry></visual></link></model>
  <model name='ball'><pose>4.5 0 0 0 0 0</pose><static>true</static><link name='l'><visual name='v'>
    <geometry><sphere><radius>0.5</radius></sphere></geometry></visual></link></model>
</world></sdf>)");
}

TEST_F(RecordingsCliTest, RecordingsOfAWorldInPartsKeepTheirSettingsAndAreReplayed) {
  write_pool(folder);
  const std::string pool = " --set world=pool.sdf --set 'ignore=[box_*]' --no-pictures ";
  const Outcome run = shell("insonify run fan.yaml -o out -q --record h5,mcap" + pool);
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.err, HasSubstr("pool.sdf: 1 part of the world is skipped (an error with strict: true): "));
  EXPECT_THAT(run.err, Not(HasSubstr("ignore")));
  const std::string left_out =
      R"(/usr/bin/python3 -c 'import h5py; print(h5py.File("out/ahead.h5")["settings/ignore"][()])')";
  EXPECT_THAT(shell(left_out).out, HasSubstr("box_*"));
  for (const std::string kind : {"h5", "mcap"}) {
    const Outcome replay = shell("insonify replay out/ahead." + kind + " -o " + kind);
    EXPECT_EQ(replay.status, 0) << replay.err;
    EXPECT_FALSE(files(kind).empty()) << kind;
  }
}

TEST_F(RecordingsCliTest, AMissingPartOfTheWorldIsAnErrorWithStrict) {
  write_pool(folder);
  const Outcome refused = shell("insonify run fan.yaml -o out -q --strict --set world=pool.sdf");
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("pool.sdf:2:12: include 'model://gone' not found beside this file"));
  EXPECT_EQ(refused.err, shell("insonify run fan.yaml -o out -q --set strict=true --set world=pool.sdf").err);
  EXPECT_FALSE(std::filesystem::exists("out"));
}

TEST_F(RecordingsCliTest, RecordNamesItsChoices) {
  const Outcome outcome = shell("insonify run fan.yaml -o out --record bag");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.err, "insonify: --record: bag must be h5 or mcap, or several with commas (insonify run --help)\n");
}

TEST_F(RecordingsCliTest, AnEarlierMcapIsReplacedOnlyWithForce) {
  EXPECT_EQ(shell("insonify run fan.yaml -o out -q --no-pictures --record mcap --pings 2").status, 0);
  const Outcome refused = shell("insonify run fan.yaml -o out -q --no-pictures --record mcap");
  EXPECT_EQ(refused.status, 2);
  EXPECT_EQ(refused.err,
            "insonify: out/ahead.mcap exists already: --force replaces it, -o DIR writes to another folder\n");
  EXPECT_EQ(shell("insonify run fan.yaml -o out -q --no-pictures --record mcap --force").status, 0);
  EXPECT_EQ(info("out/ahead.mcap").at("sonars").at(0).at("pings"), 3);
  EXPECT_THAT(files("out"), ElementsAre("ahead.mcap"));
}

TEST_F(RecordingsCliTest, CtrlCKeepsThePingsMadeSoFar) {
  const Process process({"run", "fan.yaml", "-o", "out", "--no-pictures", "--record", "h5,mcap", "--pings", "1000000"});
  Process::wait_until([] {
    std::error_code ignored;
    const auto size = std::filesystem::file_size("out/ahead.mcap", ignored);
    return !ignored && size > 20'000;
  });
  process.send(SIGINT);
  EXPECT_EQ(process.end().status, 1);
  const json mcap = info("out/ahead.mcap");
  const json h5 = info("out/ahead.h5");
  EXPECT_EQ(mcap.at("state"), "whole");
  EXPECT_EQ(h5.at("state"), "whole");
  EXPECT_GT(mcap.at("sonars").at(0).at("pings"), 0);
  EXPECT_EQ(mcap.at("sonars").at(0).at("pings"), h5.at("sonars").at(0).at("pings"));
}

TEST_F(RecordingsCliTest, InfoTellsWhatARecordingHolds) {
  ASSERT_EQ(shell("insonify run scan.yaml -o out -q --no-pictures --record h5,mcap --seed 9").status, 0);
  const json h5 = info("out/around.h5");
  const json mcap = info("out/around.mcap");
  EXPECT_EQ(h5.at("format"), "HDF5");
  EXPECT_EQ(mcap.at("format"), "MCAP");
  for (const json& told : {h5, mcap}) {
    EXPECT_EQ(told.at("state"), "whole");
    EXPECT_EQ(told.at("seed"), 9);
    EXPECT_EQ(told.at("model"), "calibrated");
    EXPECT_EQ(told.at("engine"), "cpu");
    EXPECT_THAT(told.at("scenario").get<std::string>(), HasSubstr("tritech-micron-dst"));
    const json& sonar = told.at("sonars").at(0);
    EXPECT_EQ(sonar.at("name"), "around");
    EXPECT_EQ(sonar.at("type"), "msis");
    EXPECT_EQ(sonar.at("pings"), 20);
    EXPECT_EQ(sonar.at("bins"), 40);
    EXPECT_EQ(sonar.at("max_range"), 12.0);
    EXPECT_EQ(sonar.at("first_time"), 0.0);
    EXPECT_NEAR(sonar.at("last_time").get<double>(), h5.at("sonars").at(0).at("last_time").get<double>(), 1e-9);
    EXPECT_GT(sonar.at("last_time"), 0.1);
  }
  const Outcome text = shell("insonify info out/around.mcap");
  EXPECT_THAT(text.out, HasSubstr("out/around.mcap: MCAP, "));
  EXPECT_THAT(text.out,
              HasSubstr("model calibrated, engine cpu, seed 9\n  around: Tritech Micron DST, 20 pings from 0 to "));
  EXPECT_THAT(text.out, HasSubstr("1 beam x 40 bins from 0.3 to 12 m, 700 kHz, scanning\n"));
}

TEST_F(RecordingsCliTest, InfoRefusesWhatIsNoRecording) {
  folder.write("notes.txt", "nothing");
  const Outcome outcome = shell("insonify info notes.txt");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("insonify: notes.txt: is not a recording: it is neither HDF5 nor MCAP"));
  folder.write("dive.bag", "#ROSBAG V2.0\n");
  EXPECT_EQ(shell("insonify info dive.bag").err,
            "insonify: dive.bag: is not a recording: it is a bag of ROS, which insonify writes and does not read\n");
}

TEST_F(RecordingsCliTest, InfoGoesOnAfterAFileThatIsNoRecording) {
  ASSERT_EQ(shell("insonify run fan.yaml -o out -q --no-pictures").status, 0);
  const Outcome text = shell("insonify info gone.h5 out/ahead.h5 away.mcap");
  EXPECT_EQ(text.status, 2);
  EXPECT_EQ(text.err, "insonify: gone.h5: no such file\ninsonify: away.mcap: no such file\n");
  EXPECT_THAT(text.out, HasSubstr("out/ahead.h5: HDF5, "));
  const Outcome told = shell("insonify info gone.h5 out/ahead.h5 --json");
  EXPECT_EQ(told.status, 2);
  ASSERT_EQ(json::parse(told.out).size(), 1);
  EXPECT_EQ(json::parse(told.out).at(0).at("file"), "out/ahead.h5");
}

TEST_F(RecordingsCliTest, ReplayDrawsWhatTheRunHasDrawn) {
  ASSERT_EQ(shell("insonify run fan.yaml -o out -q --no-view --record h5,mcap").status, 0);
  ASSERT_EQ(shell("insonify replay out/ahead.h5 -o again").status, 0);
  EXPECT_EQ(text_of("again/ahead_fan_0002.png"), text_of("out/ahead_fan_0002.png"));
  EXPECT_EQ(shell("insonify replay out/ahead.mcap -o mcap").status, 0);
  EXPECT_EQ(files("mcap"), files("again"));
  const Outcome outcome = shell("insonify replay out/ahead.mcap -o x --sonar port");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.err, "insonify: out/ahead.mcap: has no sonar port; its sonar is ahead\n");
}

TEST_F(RecordingsCliTest, ExportWarnsOfAnUnfinishedRecording) {
  {
    const Process process(
        {"run", "fan.yaml", "-o", "out", "--no-pictures", "--pings", "1000000", "--set", "bin_count=1000"});
    Process::wait_until([] {
      std::error_code ignored;
      const auto size = std::filesystem::file_size("out/ahead.h5", ignored);
      return !ignored && size > 3'000'000;  // Some pings: the first does not fill the file that it begins.
    });
    process.send(SIGKILL);
    EXPECT_EQ(process.end().status, -1);
  }
  EXPECT_EQ(info("out/ahead.h5").at("state"), "unfinished");
  ASSERT_EQ(shell("cp --sparse=never out/ahead.h5 copy.h5").status, 0);
  EXPECT_EQ(info("copy.h5").at("state"), "unfinished");
  const Outcome outcome = shell("insonify export out/ahead.h5 -o out/run.mcap");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.out, "out/run.mcap\n");
  EXPECT_THAT(outcome.err, HasSubstr("warning: out/ahead.h5 is unfinished: the run that wrote it was killed; it has "));
  EXPECT_EQ(info("out/run.mcap").at("sonars").at(0).at("pings"), info("out/ahead.h5").at("sonars").at(0).at("pings"));
}

// Whatever the size of the file, and however much of it a file system or a copy leaves out as holes.
TEST_F(RecordingsCliTest, AWholeRecordingIsToldFromOthersByWhatItSays) {
  for (int pings = 17; pings < 23; ++pings) {
    ASSERT_EQ(shell(fmt::format("insonify run fan.yaml -o out -q --no-pictures --force --pings {}", pings)).status, 0);
    EXPECT_EQ(info("out/ahead.h5").at("state"), "whole") << pings;
    ASSERT_EQ(shell("cp --sparse=always out/ahead.h5 copy.h5").status, 0);
    EXPECT_EQ(info("copy.h5").at("state"), "whole") << pings;
  }
  const Outcome full =
      shell("bash -c 'ulimit -f 400; " INSONIFY_CLI " run fan.yaml -o full -q --no-pictures --pings 100000'");
  EXPECT_EQ(full.status, 1) << full.err;
  EXPECT_EQ(info("full/ahead.h5").at("state"), "disk_full");
  ASSERT_EQ(shell("cp --sparse=never full/ahead.h5 copy.h5").status, 0);
  EXPECT_EQ(info("copy.h5").at("state"), "disk_full");
}

TEST_F(RecordingsCliTest, AVideoThatFindsTheDiskFullSaysSo) {
  if (shell("ffmpeg -version").status != 0) {
    GTEST_SKIP() << "there is no ffmpeg";
  }
  ASSERT_EQ(shell("insonify run fan.yaml -o out -q --no-pictures --pings 20").status, 0);
  const Outcome full =
      shell("bash -c 'trap \"\" XFSZ; ulimit -f 4; " INSONIFY_CLI " export out/ahead.h5 -o ahead.mp4'");
  EXPECT_EQ(full.status, 1);
  EXPECT_THAT(full.err,
              AnyOf("insonify: ahead.mp4: cannot write: File too large\n",  // Where ffmpeg ends with a failure.
                    "insonify: ahead.mp4: cannot write: ffmpeg has left half a video; the disk may be full\n"));
  EXPECT_FALSE(std::filesystem::exists("ahead.mp4"));
}

TEST_F(RecordingsCliTest, ValuesThatAreCutAreTold) {
  const char* const cut = " of ahead are above the highest level, -150 dB, and are clipped; the loudest has -";
  const Outcome run = shell("insonify run fan.yaml -o out -q --no-pictures --record h5,mcap --levels=-200:-150");
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.err, HasSubstr("insonify: warning: out/ahead.mcap: "));
  EXPECT_THAT(run.err, HasSubstr(cut));
  for (const char* ending : {"mcap", "bag"}) {
    const Outcome outcome = shell(fmt::format("insonify export out/ahead.h5 -o cut.{} --levels=-200:-150", ending));
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(outcome.err, HasSubstr(cut));
    EXPECT_EQ(shell(fmt::format("insonify export out/ahead.h5 -o whole.{} --levels=-200:0", ending)).err, "");
    // What was cut has the highest level now, and is told again as it is.
    EXPECT_EQ(shell(fmt::format("insonify export cut.mcap -o again.{} --levels=-200:-150", ending)).err, "") << ending;
  }
}

TEST_F(RecordingsCliTest, ExportRefusesOptionsWithoutEffect) {
  ASSERT_EQ(shell("insonify run fan.yaml -o out -q --no-pictures --pings 2").status, 0);
  const auto message = [](const std::string& options) {
    const Outcome outcome = shell("insonify export out/ahead.h5 -o out/" + options);
    EXPECT_EQ(outcome.status, 2) << options;
    EXPECT_EQ(outcome.out, "") << options;
    return outcome.err;
  };
  EXPECT_EQ(message("z.npz --bits 8 --rate 5"), "insonify: --bits has no effect on .npz, only on .mcap, .bag\n");
  EXPECT_EQ(message("z.npz --rate 5"), "insonify: --rate has no effect on .npz, only on .mp4, .gif\n");
  EXPECT_EQ(message("z.ZARR/ --store"), "insonify: --store has no effect on .zarr, only on .npz\n");
  EXPECT_EQ(message("z.mcap --height 300"), "insonify: --height has no effect on .mcap, only on .mp4, .gif\n");
  EXPECT_EQ(message("z.npz --levels -90:-40"),
            "insonify: --levels has no effect on .npz, only on .mp4, .gif, .mcap, .bag\n");
  EXPECT_EQ(message("z.zarr --color-map grey"),
            "insonify: --colour-map has no effect on .zarr, only on .mp4, .gif, .mcap, .bag\n");
  EXPECT_THAT(message("z.txt --bits 8"), HasSubstr("z.txt: its ending must be "));
  EXPECT_THAT(files("out"), ElementsAre("ahead.h5"));
  EXPECT_EQ(shell("insonify export out/ahead.h5 -o out/z.npz --store").status, 0);
  EXPECT_EQ(shell("insonify export out/ahead.h5 -o out/z.mcap --bits 8 --levels -90:-40 --colour-map grey").status, 0);
}

TEST_F(RecordingsCliTest, ARecordingWithoutPingsIsWrongInputForAll) {
  ASSERT_EQ(shell("insonify run fan.yaml -o out -q --no-pictures --record h5,mcap").status, 0);
  // A killed run has left the start of its file.
  const std::string whole = text_of("out/ahead.mcap");
  const std::size_t chunk = whole.find("zstd") - 41;  // Opcode, length, two times, size, checksum, length of "zstd".
  folder.write("empty.mcap", whole.substr(0, chunk + 5));
  EXPECT_EQ(info("empty.mcap").at("sonars").at(0).at("pings"), 0);
  for (const char* words : {"replay empty.mcap", "export empty.mcap -o x.npz", "export empty.mcap -o x.mcap"}) {
    const Outcome outcome = shell(std::string("insonify ") + words);
    EXPECT_EQ(outcome.status, 2) << words;
    EXPECT_EQ(outcome.err, "insonify: empty.mcap: there is no ping in it\n") << words;
  }
}

TEST_F(RecordingsCliTest, ExportRefusesRecordingsOfDifferentRuns) {
  ASSERT_EQ(shell("insonify run fan.yaml -o a -q --no-pictures --record h5,mcap").status, 0);
  ASSERT_EQ(shell("insonify run scan.yaml -o b -q --no-pictures").status, 0);
  ASSERT_EQ(shell("insonify run scan.yaml -o c -q --no-pictures --seed 7").status, 0);
  for (const char* ending : {"npz", "mcap", "zarr"}) {
    const Outcome scenarios = shell(fmt::format("insonify export a/ahead.h5 b/around.h5 -o x.{}", ending));
    EXPECT_EQ(scenarios.status, 2);
    EXPECT_EQ(
        scenarios.err,
        "insonify: a/ahead.h5 and b/around.h5 are of different runs: their scenarios differ; export each run to a "
        "file of its own\n");
  }
  const Outcome seeds = shell("insonify export a/ahead.mcap c/around.h5 -o x.npz");
  EXPECT_EQ(seeds.status, 2);
  EXPECT_EQ(
      seeds.err,
      "insonify: a/ahead.mcap and c/around.h5 are of different runs: their seeds are 1 and 7; export each run to a "
      "file of its own\n");
}

TEST_F(RecordingsCliTest, McapOfARunIsTheSameBytesEachTime) {
  for (const char* folder_name : {"a", "b"}) {
    ASSERT_EQ(
        shell(fmt::format("insonify run fan.yaml -o {} -q --no-pictures --record mcap --pings 4", folder_name)).status,
        0);
  }
  EXPECT_EQ(text_of("a/ahead.mcap"), text_of("b/ahead.mcap"));
}

TEST_F(RecordingsCliTest, CompressHasNoEffectOnMcapAlone) {
  const Outcome outcome = shell("insonify run fan.yaml -o out -q --no-pictures --record mcap --compress");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.err, "insonify: --compress has no effect on --record mcap, only on h5\n");
  EXPECT_EQ(shell("insonify run fan.yaml -o out -q --no-pictures --record h5,mcap --compress").status, 0);
}

}  // namespace
}  // namespace insonify::recordings_cli_test
