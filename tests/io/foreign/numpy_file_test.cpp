// numpy_file_test.cpp -- arrays that NumPy and `insonify export` write: numbers, axes and what is refused.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "insonify/export.h"
#include "insonify/files.h"
#include "io/foreign/foreign_bytes.h"

namespace insonify::numpy_file_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class NumpyFileTest : public testing::Test {
 protected:
  void SetUp() override {
    const std::string script = INSONIFY_SOURCE_DIR "/tests/io/foreign/write_arrays.py";
    ASSERT_EQ(std::system(("\"" INSONIFY_PYTHON "\" \"" + script + "\"").c_str()), 0);  // NOLINT: only in tests.
  }
  const WorkingFolder folder;
};

TEST_F(NumpyFileTest, ThreeAxesArePingsBinsAndBeams) {
  for (const char* name : {"u1.npy", "fortran.npy"}) {
    const RecordedPings pings(name);
    EXPECT_EQ(pings.ping_count(), 2U) << name;
    EXPECT_EQ(pings.bin_count(), 3) << name;
    EXPECT_EQ(pings.beam_count(), 4) << name;
    EXPECT_THAT(pings.intensity(1), ElementsAre(12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23)) << name;
    EXPECT_EQ(pings.full_scale(), 255) << name;
  }
  EXPECT_THAT(RecordedPings("big.npy").intensity(0),
              ElementsAre(0, 1000, 2000, 3000, 4000, 5000, 6000, 7000, 8000, 9000, 10000, 11000));
  EXPECT_EQ(RecordedPings("big.npy").full_scale(), 65535);
}

TEST_F(NumpyFileTest, FewerAxesAreOnePingAndOneBeam) {
  const RecordedPings one("f8.npy"), line("big_f4.npy");
  EXPECT_EQ(one.ping_count(), 1U);
  EXPECT_EQ(one.bin_count(), 2);
  EXPECT_EQ(one.beam_count(), 3);
  EXPECT_THAT(one.intensity(0), ElementsAre(0, 0.2, 0.4, 0.6000000000000001, 0.8, 1));
  EXPECT_EQ(one.full_scale(), 1);
  EXPECT_EQ(line.beam_count(), 1);
  EXPECT_THAT(line.intensity(0), ElementsAre(0, 0.25, 0.5, 0.75, 1));
  EXPECT_THAT(RecordedPings("f2.npy").intensity(0),
              ElementsAre(0.5, 1, 65504, 0, std::ldexp(1, -24), std::ldexp(1, -14)));
  EXPECT_THAT(RecordedPings("bool.npy").intensity(0), ElementsAre(1, 0));
}

// NumPy's usual integers have 64 bits, whatever they hold.
TEST_F(NumpyFileTest, WideIntegersAreCountsWhereTheyFit) {
  EXPECT_EQ(RecordedPings("i8.npy").full_scale(), 255);
  EXPECT_THAT(RecordedPings("i8.npy").intensity(0), ElementsAre(0, 7, 255, 1));
  EXPECT_THAT(RecordedPings("i8.npy").notes(),
              ElementsAre("integers of type <i8 up to 255 are taken as counts of 8 bits"));
  EXPECT_EQ(RecordedPings("u4.npy").full_scale(), 65535);
  EXPECT_THAT(RecordedPings("i2.npy").intensity(0), ElementsAre(-1, 7, 256, 1));
  EXPECT_EQ(RecordedPings("i2.npy").full_scale(), 1);
}

TEST_F(NumpyFileTest, WhatIsNotInAnArrayIsAssumedAndTold) {
  const RecordedPings pings("u1.npy");
  EXPECT_THAT(pings.assumed(), ElementsAre("no ranges in it, bins of 0.01 m are assumed; no bearings in it, a fan of "
                                           "120 deg is assumed; no frequency in it, 720 kHz is assumed"));
  EXPECT_NEAR(pings.sonar_config().max_range, 0.03, 1e-12);
}

// Bearings are positive to starboard. The lengths of the axes say which is which.
TEST_F(NumpyFileTest, AnArchiveSaysItsAxes) {
  const RecordedPings turned("beam_bin.npz"), one("bin_beam.npz");
  EXPECT_EQ(turned.bin_count(), 3);
  EXPECT_EQ(turned.beam_count(), 4);
  EXPECT_THAT(turned.intensity(1), ElementsAre(12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23));
  EXPECT_EQ(one.intensity(0), turned.intensity(1));
  EXPECT_THAT(one.assumed(), IsEmpty());
  const SonarConfig sonar = turned.sonar_config();
  EXPECT_NEAR(degrees_from_radians(sonar.beam_azimuth(0)), 30, 1e-9);
  EXPECT_EQ(sonar.min_range, 0.5);
  EXPECT_EQ(sonar.max_range, 3.5);
}

TEST_F(NumpyFileTest, SidesAreChosenByName) {
  EXPECT_EQ(opening("sides.npz"), "sides.npz: has the arrays port, starboard; choose one with --sonar");
  EXPECT_EQ(opening("sides.npz", "down"), "sides.npz: has no array down; it has port, starboard");
  const RecordedPings side("sides.npz", "starboard");
  EXPECT_EQ(side.ping_count(), 3U);
  EXPECT_EQ(side.beam_count(), 1);
  EXPECT_THAT(side.intensity(2), ElementsAre(20, 21, 22, 23));
  EXPECT_EQ(side.sonar_config().max_range, 30);
  EXPECT_EQ(opening("axes.npz"), "axes.npz: has no array of two or three axes in 1 array");
}

// An export of a recording is read as the recording itself.
TEST_F(NumpyFileTest, AnExportIsTheRecording) {
  SonarConfig sonar;
  sonar.name = "around";
  sonar.type = SonarType::kMechanicallyScanned;
  sonar.beam_count = 1;
  sonar.bin_count = 3;
  sonar.azimuth_aperture = 0.1;
  {
    Recording recording("a.h5", Scenario(), Scene(), sonar);
    for (int number = 0; number < 2; ++number) {
      Ping ping;
      ping.number = static_cast<std::uint64_t>(number);
      ping.time = 0.5 * number;
      ping.head_angle = 0.25 * number;
      ping.bin_count = 3;
      ping.beam_count = 1;
      ping.intensity = {1, 0.25F, number / 2.0F};
      ping.instance.resize(3);
      ping.material.resize(3);
      ping.elevation.resize(3);
      recording.add(ping);
    }
  }
  const std::filesystem::path recorded = "a.h5";
  export_recordings({&recorded, 1}, "a.npz");
  const RecordedPings pings("a.npz"), original("a.h5");
  EXPECT_EQ(pings.model(), original.model());
  EXPECT_EQ(pings.sonar(), "around");
  EXPECT_EQ(pings.ping_count(), 2U);
  EXPECT_EQ(pings.intensity(1), original.intensity(1));
  EXPECT_EQ(pings.ping(1).time, 0.5);
  EXPECT_EQ(pings.ping(1).head_angle, 0.25);
  EXPECT_EQ(pings.sonar_config().azimuth_aperture, 0.1);
  EXPECT_EQ(pings.sonar_config().source_level_db, sonar.source_level_db);
  EXPECT_THAT(pings.assumed(), IsEmpty());
}

TEST_F(NumpyFileTest, WhatIsNotNumbersIsRefused) {
  EXPECT_EQ(opening("c8.npy"),
            "c8.npy: holds values of type <c8; real numbers of at most 64 bits are read, as "
            "numpy.abs(x) ** 2 makes");
  EXPECT_EQ(opening("object.npy"), "object.npy: holds type |O; arrays of numbers are read, no objects and no records");
  EXPECT_THAT(opening("record.npy"), HasSubstr("arrays of numbers are read, no objects and no records"));
  EXPECT_EQ(opening("text.npy"), "text.npy: holds values of type <U2; real numbers of at most 64 bits are read");
  EXPECT_EQ(opening("four.npy"),
            "four.npy: its array has 4 axes (2 x 2 x 2 x 2); must have [bin, beam] or [ping, bin, beam]");
  EXPECT_EQ(opening("none.npy"), "none.npy: its array is empty: 0 x 3");
}

std::string npy(const std::string& dictionary, const std::string& numbers) {
  return "\x93NUMPY" + std::string("\1\0", 2) + little(static_cast<std::uint16_t>(dictionary.size())) + dictionary +
         numbers;
}

TEST_F(NumpyFileTest, DamagedAndGiantArraysAreOneMessage) {
  folder.write("text.npy", "hello, this is text");
  EXPECT_EQ(opening("text.npy"),
            "text.npy: byte 0: begins with \"hello,\"; an array of NumPy begins with \"\\x93NUMPY\"");
  folder.write("cut.npy", npy("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }", "12345678"));
  EXPECT_EQ(opening("cut.npy"), "cut.npy: byte 69: 6 numbers of type <f4 need 24 bytes; the file has 8 more");
  folder.write("giant.npy", npy("{'descr': '<f8', 'fortran_order': False, 'shape': (99999999999, 99999999999), }", ""));
  EXPECT_EQ(opening("giant.npy"),
            "giant.npy: an array of 99999999999 x 99999999999 numbers is too large: at most 16 GiB are read");
  folder.write("shape.npy", npy("{'descr': '<f8', 'fortran_order': False, 'shape': (2, -3), }", ""));
  EXPECT_EQ(opening("shape.npy"), "shape.npy: its shape has  -3, must have whole numbers");
  folder.write("key.npy", npy("{'descr': '<f8', 'shape': (2, 3), }", ""));
  EXPECT_THAT(opening("key.npy"), HasSubstr("key.npy: its header has no fortran_order: "));
  folder.write("head.npy", std::string("\x93NUMPY\2\0\xff\xff\xff\xff", 12));
  EXPECT_EQ(opening("head.npy"),
            "head.npy: byte 8: its header of 4294967295 bytes is cut off or too long, the limit is 65536");
}

TEST_F(NumpyFileTest, DamagedArchivesAndBombsAreOneMessage) {
  folder.write("text.npz", "hello, this is text");
  EXPECT_EQ(opening("text.npz"), "text.npz: is not a whole ZIP archive: it has no directory at its end");
  EXPECT_THAT(opening("claims.npz"),
              testing::MatchesRegex("claims.npz: intensity.npy: has 192 bytes, [0-9]+ packed; must "
                                    "have 12800000128"));
  std::string zeros = read_bytes("zeros.npz");
  EXPECT_EQ(opening("zeros.npz"), "no error");
  folder.write("cut.npz", zeros.substr(0, zeros.size() / 2));
  EXPECT_EQ(opening("cut.npz"), "cut.npz: is not a whole ZIP archive: it has no directory at its end");
  zeros[zeros.size() / 2] ^= 0x55;
  folder.write("bit.npz", zeros);
  EXPECT_THAT(opening("bit.npz"), HasSubstr("bit.npz: "));
}

}  // namespace
}  // namespace insonify::numpy_file_test
