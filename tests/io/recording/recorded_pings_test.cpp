// recorded_pings_test.cpp -- recorded pings are read back unchanged, or refused with the reason.

#include "insonify/recorded_pings.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cmath>

#include "insonify/files.h"
#include "support/message_of.h"
#include "support/picture_files.h"
#include "support/working_folder.h"

namespace insonify::recorded_pings_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

// ---------------------------------------------------------------- Recordings

TEST(RecordedPingsTest, GiveBackWhatARecordingWasGiven) {
  const WorkingFolder folder;
  Scenario scenario;
  SonarConfig sonar;
  sonar.name = "ahead";
  sonar.beam_count = 2;
  sonar.bin_count = 3;
  {
    Recording recording("a.h5", scenario, Scene(), sonar);
    for (int number = 0; number < 2; ++number) {
      Ping ping;
      ping.number = number;
      ping.bin_count = 3;
      ping.beam_count = 2;
      ping.intensity = {0, 0.25F, 0.5F, 0.75F, 1, number / 2.0F};
      ping.instance.resize(6);
      ping.material.resize(6);
      ping.elevation.resize(6);
      recording.add(ping);
    }
  }
  const RecordedPings pings("a.h5");
  EXPECT_EQ(pings.ping_count(), 2U);
  EXPECT_EQ(pings.bin_count(), 3);
  EXPECT_EQ(pings.beam_count(), 2);
  EXPECT_EQ(pings.sonar(), "ahead");
  EXPECT_EQ(pings.full_scale(), 1);
  EXPECT_THAT(pings.intensity(0), ElementsAre(0, 0.25, 0.5, 0.75, 1, 0));
  EXPECT_THAT(pings.intensity(1), ElementsAre(0, 0.25, 0.5, 0.75, 1, 0.5));
}

// HDF5's own lock is one of the whole file, which another process may have, and NFS may refuse.
TEST(RecordedPingsTest, AreReadWithoutALock) {
  const WorkingFolder folder;
  SonarConfig sonar;
  sonar.beam_count = 2;
  sonar.bin_count = 3;
  { const Recording recording("a.h5", Scenario(), Scene(), sonar); }
  const int file = open("a.h5", O_RDONLY | O_CLOEXEC);
  ASSERT_EQ(flock(file, LOCK_EX | LOCK_NB), 0);
  EXPECT_EQ(RecordedPings("a.h5").beam_count(), 2);
  close(file);
}

// Data that pictures are drawn from.
TEST(RecordedPingsTest, GiveBackSettingsAndPings) {
  const WorkingFolder folder;
  Scenario scenario;
  scenario.ground_truth = GroundTruth::kNone;
  scenario.receiver.time_varied_gain = 30;
  scenario.receiver.gain_ranges = {1, 2};
  scenario.receiver.gains_db = {0, 6};
  scenario.receiver.azimuth_pattern = BeamPattern::kHann;
  scenario.receiver.noise = false;
  SonarConfig sonar;
  sonar.name = "around";
  sonar.type = SonarType::kMechanicallyScanned;
  sonar.head.mounting = Mounting::kVertical;
  sonar.beam_count = 1;
  sonar.bin_count = 3;
  sonar.azimuth_aperture = 0.05;
  sonar.head.step = 0.1;
  sonar.ping_period = 0.25;
  sonar.position = {1, 2, -3};
  Ping ping;
  ping.bin_count = 3;
  ping.beam_count = 1;
  ping.intensity = {0.5F, 0.25F, 1e-9F};
  ping.time = 7.5;
  ping.head_angle = -0.3;
  ping.world_from_sonar = {Vec3(4, 5, 6), orientation_from_rpy(0, 0, 1)};
  Recording("a.h5", scenario, Scene(), sonar).add(ping);

  const RecordedPings pings("a.h5");
  const Ping back = pings.ping(0);
  EXPECT_EQ(back.intensity, ping.intensity);
  EXPECT_EQ(back.time, 7.5);
  EXPECT_EQ(back.head_angle, -0.3);
  EXPECT_EQ(back.world_from_sonar.position, ping.world_from_sonar.position);
  EXPECT_EQ(back.world_from_sonar.orientation.coeffs(), ping.world_from_sonar.orientation.coeffs());
  const auto expect_same = [](const auto& wanted, const auto& found) {
    using Config = std::remove_cvref_t<decltype(wanted)>;
    std::vector<std::string> values[2];
    for (int i = 0; i < 2; ++i) {
      Config::visit_fields(i == 0 ? wanted : found, [&](const Field& field, const auto& member) {
        values[i].push_back(std::string(field.name) + " " + testing::PrintToString(member));
      });
    }
    EXPECT_EQ(values[0], values[1]);
  };
  expect_same(sonar, pings.sonar_config());
  expect_same(scenario.receiver, pings.receiver_config());
}

// A multibeam of three beams; every member of every sounding differs.
Ping ping_with_soundings(const SonarConfig& sonar) {
  Ping ping;
  ping.bin_count = sonar.bin_count;
  ping.beam_count = sonar.beam_count;
  ping.intensity.resize(12);
  for (int beam = 0; beam < 3; ++beam) {
    Sounding& sounding = ping.soundings.emplace_back();
    sounding.azimuth = static_cast<float>(sonar.beam_azimuth(beam));
    sounding.detection = std::array{Detection::kPhase, Detection::kNone, Detection::kAmplitude}[beam];
    if (sounding.found()) {
      const auto n = static_cast<float>(beam);
      sounding.range = 20 + n;
      sounding.uncertainty = 0.25F + n;
      sounding.quality = 1.5F + n;
      sounding.intensity = 1e-9F * (1 + n);
      sounding.snippet_begin = 1 + beam / 2;
      sounding.snippet_end = 3 + beam / 2;
    }
  }
  return ping;
}

TEST(RecordedPingsTest, GiveBackSoundings) {
  const WorkingFolder folder;
  Scenario scenario;
  scenario.ground_truth = GroundTruth::kNone;
  SonarConfig sonar;
  sonar.type = SonarType::kMultibeam;
  sonar.beam_count = 3;
  sonar.bin_count = 4;
  const Ping ping = ping_with_soundings(sonar);
  {
    Recording recording("a.h5", scenario, Scene(), sonar);
    recording.add(ping);
    Ping without = ping;
    without.soundings.pop_back();
    EXPECT_EQ(message_of([&] { recording.add(without); }), "a.h5: ping 0 holds 2 soundings, not 3");
  }
  const RecordedPings pings("a.h5");
  EXPECT_TRUE(pings.has_soundings());
  const std::vector<Sounding> back = pings.ping(0).soundings;
  ASSERT_EQ(back.size(), 3U);
  for (std::size_t beam = 0; beam < 3; ++beam) {
    const Sounding &wanted = ping.soundings[beam], &found = back[beam];
    EXPECT_EQ(found.azimuth, wanted.azimuth);
    EXPECT_EQ(found.detection, wanted.detection);
    EXPECT_TRUE(found.range == wanted.range || (std::isnan(found.range) && beam == 1)) << found.range;
    EXPECT_EQ(found.uncertainty, wanted.uncertainty);
    EXPECT_EQ(found.quality, wanted.quality);
    EXPECT_EQ(found.intensity, wanted.intensity);
    EXPECT_EQ(found.snippet_begin, wanted.snippet_begin);
    EXPECT_EQ(found.snippet_end, wanted.snippet_end);
  }
}

TEST(RecordedPingsTest, OfOtherSonarsHaveNoSoundings) {
  const WorkingFolder folder;
  Scenario scenario;
  scenario.ground_truth = GroundTruth::kNone;
  SonarConfig sonar;
  sonar.beam_count = 3;
  sonar.bin_count = 4;
  Recording("a.h5", scenario, Scene(), sonar).add(ping_with_soundings(sonar));
  const RecordedPings pings("a.h5");
  EXPECT_FALSE(pings.has_soundings());
  EXPECT_TRUE(pings.ping(0).soundings.empty());
}

TEST(RecordedPingsTest, OfOthersHaveNoSettings) {
  const WorkingFolder folder;
  write_intensity("bytes.h5", {1, 1, 3}, H5T_STD_U8LE, {0, 100, 255}, "oculus");
  const RecordedPings pings("bytes.h5");
  EXPECT_EQ(message_of([&] { (void)pings.sonar_config(); }),
            "bytes.h5: settings/sonar is not in the file: it was not recorded by insonify");
  EXPECT_EQ(message_of([&] { (void)pings.ping(0); }), "bytes.h5: time must have a number for each ping");
}

TEST(RecordedPingsTest, MayBeCompressed) {
  const WorkingFolder folder;
  Scenario scenario;
  scenario.ground_truth = GroundTruth::kNone;
  SonarConfig sonar;
  sonar.beam_count = 20;
  sonar.bin_count = 30;
  Ping ping;
  ping.bin_count = 30;
  ping.beam_count = 20;
  ping.intensity.assign(600, 0.5F);
  Recording("a.h5", scenario, Scene(), sonar, {.compress = true}).add(ping);
  EXPECT_EQ(RecordedPings("a.h5").intensity(0), std::vector<double>(600, 0.5));
}

TEST(RecordedPingsTest, MayBeWholeNumbersOfAnyone) {
  const WorkingFolder folder;
  write_intensity("bytes.h5", {1, 1, 3}, H5T_STD_U8LE, {0, 100, 255}, "oculus");
  const RecordedPings bytes("bytes.h5");
  EXPECT_EQ(bytes.full_scale(), 255);
  EXPECT_EQ(bytes.sonar(), "oculus");
  EXPECT_THAT(bytes.intensity(0), ElementsAre(0, 100, 255));
  write_intensity("words.h5", {1, 1, 1}, H5T_STD_U16BE, {1});
  EXPECT_EQ(RecordedPings("words.h5").full_scale(), 65535);
  write_intensity("signed.h5", {1, 1, 1}, H5T_STD_I16LE, {1});
  EXPECT_EQ(RecordedPings("signed.h5").full_scale(), 32767);
  EXPECT_EQ(RecordedPings("signed.h5").sonar(), "");
}

TEST(RecordedPingsTest, WhatIsNoRecordingIsToldWhy) {
  const WorkingFolder folder;
  const auto refusal = [](const char* path) { return message_of([=] { RecordedPings pings(path); }); };
  EXPECT_EQ(refusal("none.h5"), "none.h5: no such file");
  folder.write("text.h5", "intensity");
  EXPECT_THAT(refusal("text.h5"), StartsWith("text.h5: is not a recording: it is neither HDF5 nor MCAP"));
  write_intensity("flat.h5", {2, 3}, H5T_IEEE_F32LE, std::vector<double>(6));
  EXPECT_EQ(refusal("flat.h5"), "flat.h5: intensity has 2 axes; a recording has three: ping, bin, beam");
  write_intensity("empty.h5", {2, 0, 3}, H5T_IEEE_F32LE, {});
  EXPECT_EQ(refusal("empty.h5"),
            "empty.h5: intensity has 0 bins and 3 beams; a recording has from 1 to 1000000 of each");
  H5Fclose(H5Fcreate("bare.h5", H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  EXPECT_EQ(refusal("bare.h5"), "bare.h5: is not a recording: it has no dataset intensity");
}

// ---------------------------------------------------------------- Pictures

TEST(GreyPictureTest, LevelsAreFractionsOfFullScale) {
  const WorkingFolder folder;
  write_levels<std::uint8_t>("bytes.png", 3, 2, {0, 51, 255, 102, 153, 204});
  const GreyPicture bytes = load_grey_picture("bytes.png");
  EXPECT_EQ(bytes.name, "bytes.png");
  EXPECT_EQ(bytes.columns, 3);
  EXPECT_EQ(bytes.rows, 2);
  EXPECT_THAT(bytes.values, ElementsAre(0, 51 / 255.0, 1, 102 / 255.0, 153 / 255.0, 204 / 255.0));
  write_levels<std::uint16_t>("words.png", 2, 1, {258, 65535});
  EXPECT_THAT(load_grey_picture("words.png").values, ElementsAre(258 / 65535.0, 1));
}

TEST(GreyPictureTest, AGreyPictureMayBeStoredAsAColouredOne) {
  const WorkingFolder folder;
  write_levels<std::uint8_t>("rgb.png", 2, 1, {9, 9, 9, 51, 51, 51}, 3);
  EXPECT_THAT(load_grey_picture("rgb.png").values, ElementsAre(9 / 255.0, 51 / 255.0));
  write_levels<std::uint8_t>("alpha.png", 1, 1, {51, 255}, 2);
  EXPECT_THAT(load_grey_picture("alpha.png").values, ElementsAre(51 / 255.0));
}

TEST(GreyPictureTest, ColourAndTransparencyAreRefused) {
  const WorkingFolder folder;
  write_levels<std::uint8_t>("rgb.png", 2, 1, {9, 9, 9, 9, 9, 8}, 3);
  EXPECT_EQ(message_of([] { (void)load_grey_picture("rgb.png"); }),
            "rgb.png: the pixel in column 1, row 0 is coloured; a comparison needs a grey picture");
  write_levels<std::uint8_t>("alpha.png", 1, 2, {9, 255, 9, 254}, 2);
  EXPECT_EQ(message_of([] { (void)load_grey_picture("alpha.png"); }),
            "alpha.png: the pixel in column 0, row 1 is transparent; a comparison needs an opaque picture");
  folder.write("text.png", "hello, this is no picture");
  EXPECT_EQ(message_of([] { (void)load_grey_picture("text.png"); }), "text.png: cannot be read: Not a PNG file");
  EXPECT_EQ(message_of([] { (void)load_grey_picture("none.png"); }), "none.png: no such file");
}

}  // namespace
}  // namespace insonify::recorded_pings_test
