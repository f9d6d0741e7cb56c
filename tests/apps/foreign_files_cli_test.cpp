// foreign_files_cli_test.cpp -- compare, draw and info over files of instruments, arrays and pictures.

#include <nlohmann/json.hpp>

#include "apps/cli.h"
#include "io/foreign/foreign_bytes.h"
#include "similarity/reference_pictures.h"
#include "support/picture_files.h"

namespace insonify::foreign_files_cli_test {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr int kSide = 64;

std::vector<std::uint8_t> bytes_of_picture(const GreyPicture& picture) {
  std::vector<std::uint8_t> bytes;
  for (const double value : picture.values) {
    bytes.push_back(static_cast<std::uint8_t>(std::lround(255 * value)));
  }
  return bytes;
}

// A ping of an Oculus with 64 beams from -32 to 31 degrees.
std::string oculus_picture(const GreyPicture& picture) {
  const std::vector<std::uint8_t> bytes = bytes_of_picture(picture);
  OculusBytes ping{.rows = kSide, .beams = kSide, .bearings = {}};
  for (int beam = 0; beam < kSide; ++beam) {
    ping.bearings.push_back(static_cast<std::int16_t>(100 * (beam - kSide / 2)));
  }
  ping.image.assign(bytes.begin(), bytes.end());
  return oculus_message(ping);
}

json compared(const std::string& arguments) {
  const Outcome outcome = shell("insonify compare --json " + arguments);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return json::parse(outcome.out);
}

class ForeignFilesTest : public CliTest {
 protected:
  const GreyPicture a = waves_and_squares(kSide), b = with_noise(a);
};

TEST_F(ForeignFilesTest, CountsOfAnInstrumentAreComparedAsThoseOfAPicture) {
  folder.write("a.raw", oculus_picture(a) + oculus_picture(b));
  write_levels("a.png", kSide, kSide, bytes_of_picture(a));
  write_levels("b.png", kSide, kSide, bytes_of_picture(b));
  EXPECT_EQ(compared("a.raw a.png --ping 0").at("mse"), 0);
  EXPECT_EQ(compared("a.raw b.png --ping 1").at("mse"), 0);
  const json both = compared("a.raw a.png"), pictures = compared("b.png a.png");
  EXPECT_EQ(both.at("pings"), (json{0, 1}));
  EXPECT_EQ(both.at("each").at(1).at("mse"), pictures.at("mse"));
  EXPECT_EQ(both.at("ms_ssim_scales"), 3);
  EXPECT_FALSE(both.contains("hint"));
  EXPECT_EQ(shell("insonify compare a.raw a.png --ping 2").err,
            "insonify: a.raw: there is no ping 2; it has 2, counted from 0\n");
}

TEST_F(ForeignFilesTest, CountsAgainstIntensitiesGiveAHint) {
  folder.write("a.raw", oculus_picture(a));
  std::vector<double> values(a.values);
  for (double& value : values) {
    value *= 1e-4;
  }
  write_intensity("b.h5", {1, kSide, kSide}, H5T_IEEE_F64LE, values, "fls", "calibrated");
  const std::string hint =
      "a.raw has counts, b.h5 intensities: their levels differ even where echoes agree; --counts compares counts, "
      "which "
      "receiver.counts: true adds to a simulation";
  EXPECT_EQ(compared("a.raw b.h5").at("hint"), hint);
  EXPECT_THAT(shell("insonify compare b.h5 a.raw").out, HasSubstr("hint: " + hint + "\n"));
  write_intensity("c.h5", {1, kSide, kSide}, H5T_IEEE_F64LE, values, "fls", "paper");
  EXPECT_FALSE(compared("a.raw c.h5").contains("hint"));
  EXPECT_FALSE(compared("a.raw a.raw").contains("hint"));
  for (double& value : values) {
    value = std::round(value * 2e6);
  }
  write_intensity("wide.h5", {1, kSide, kSide}, H5T_STD_I64LE, values);
  EXPECT_EQ(
      compared("wide.h5 a.raw").at("hint"),
      fmt::format("wide.h5 has integers up to {:.0f}, compared as fractions of 9.22e+18, the greatest of their type; "
                  "as counts of 8 or 16 bits they would be fractions of 255 or 65535",
                  std::ranges::max(values)));
  write_intensity("whole.h5", {1, kSide, kSide}, H5T_IEEE_F64LE, values);
  EXPECT_THAT(shell("insonify compare whole.h5 a.raw").err,
              HasSubstr("it must be from 0 to full scale, 1 (--full-scale 255: all are whole, as counts are)\n"));
}

TEST_F(ForeignFilesTest, PingsOfOneBeamAreOnePicture) {
  const std::vector<std::uint8_t> bytes = bytes_of_picture(a);
  std::vector<std::string> frames;
  std::string xtf;
  for (int column = 0; column < kSide; ++column) {
    std::string profile;
    for (int row = 0; row < kSide; ++row) {
      profile += static_cast<char>(bytes[row * kSide + column]);
    }
    frames.push_back(ping360_profile(static_cast<std::uint16_t>(2 * column), profile));
    const XtfBytes ping{.sample_bytes = 1,
                        .port = std::string(profile.rbegin(), profile.rend()),
                        .starboard = profile,
                        .samples = kSide};
    xtf += (xtf.empty() ? xtf_header(ping) : "") + xtf_packet(ping);
  }
  folder.write("a.bin", ping_viewer_log(frames));
  folder.write("a.xtf", xtf);
  write_levels("a.png", kSide, kSide, bytes);
  EXPECT_EQ(compared("a.bin a.png").at("mse"), 0);
  EXPECT_EQ(compared("a.xtf a.png --sonar starboard").at("mse"), 0);
  EXPECT_EQ(compared("a.png a.xtf --sonar port").at("mse"), 0);
  std::vector<std::uint8_t> both;  // All of port, then all of starboard.
  for (auto row = bytes.begin(); row != bytes.end(); row += kSide) {
    both.insert(both.end(), row, row + kSide);
    both.insert(both.end(), row, row + kSide);
  }
  write_levels("both.png", 2 * kSide, kSide, both);
  EXPECT_EQ(compared("a.xtf both.png").at("mse"), 0);
  EXPECT_THAT(shell("insonify compare a.xtf both.png").out,
              HasSubstr(fmt::format("{} pings of two beams, side by side: {} columns", kSide, 2 * kSide)));

  const Outcome scan = shell("insonify draw a.bin -o scan --pictures 1");
  EXPECT_EQ(scan.out, "scan/ping360_scan.png\nscan/ping360_polar.png\n");
  EXPECT_EQ(scan.err, "insonify: note: a.bin: no sound speed in it, 1500 m/s is assumed\n");
  const Outcome side = shell("insonify draw a.xtf -o side --sonar starboard");
  EXPECT_EQ(side.out, "side/starboard_waterfall.png\n");
  EXPECT_EQ(side.err, "");
  const Outcome sides = shell("insonify draw a.xtf -o sides");
  EXPECT_EQ(sides.out, "sides/side_scan_waterfall.png\n");
  EXPECT_EQ(sides.err, "");
}

TEST_F(ForeignFilesTest, FansArraysAndPicturesAreDrawn) {
  folder.write("a.raw", oculus_picture(a) + oculus_picture(b));
  const Outcome fan = shell("insonify draw a.raw -o fan --ping 1");
  EXPECT_EQ(fan.out, "fan/oculus_polar_0001.png\nfan/oculus_fan_0001.png\n");
  EXPECT_EQ(fan.err, "");
  // The same counts again, drawn from a picture: only the title and the axes differ, and it says what it assumes.
  write_levels("b.png", kSide, kSide, bytes_of_picture(b));
  const Outcome picture = shell("insonify draw b.png -o fan");
  EXPECT_EQ(picture.out, "fan/picture_polar_0000.png\nfan/picture_fan_0000.png\n");
  EXPECT_EQ(picture.err,
            "insonify: note: b.png: its rows are taken as bins of 0.01 m, the first as the nearest, its columns as a "
            "fan of 120 "
            "deg\n");
  EXPECT_EQ(
      shell("insonify draw a.raw -o counts --ping 0 --counts && insonify draw a.raw -o levels --ping 0 && diff -r "
            "counts levels")
          .status,
      0);
  EXPECT_EQ(shell("insonify draw b.png -o none --counts").err,
            "insonify: b.png: --counts: there are none in it, its numbers are floating-point\n");
}

TEST_F(ForeignFilesTest, InfoTellsFormatSonarAndShape) {
  folder.write("a.raw", oculus_picture(a) + oculus_picture(b));
  const Outcome outcome = shell("insonify info a.raw");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(
      outcome.out,
      "a.raw: Oculus, 0.0 MB\n  oculus: Blueprint Oculus, 2 pings from 0 to 0 s\n    64 beams x 64 bins from 0 to "
      "32 m, 2100 kHz\n  holds azimuth, intensity, range, time, world_from_sonar\n");
}

TEST_F(ForeignFilesTest, TheViewerShowsRunsOnly) {
  folder.write("a.raw", oculus_picture(a));
  EXPECT_EQ(shell("insonify replay --view a.raw").err,
            "insonify: a.raw: is not of a run of insonify, which --view shows; without it its pings are drawn\n");
  EXPECT_EQ(shell("insonify replay a.raw").out, "./oculus_polar_0000.png\n./oculus_fan_0000.png\n");
}

// Rows of port and starboard are pings.
TEST_F(ForeignFilesTest, OneArrayOfAnArchiveIsDrawn) {
  ASSERT_EQ(shell("'" INSONIFY_PYTHON "' -c 'import numpy as np; np.savez(\"a.npz\", port=np.ones((30, 20), np.uint8), "
                  "starboard=np.ones((30, 20), np.uint8), slant_range_m=20.0)'")
                .status,
            0);
  const Outcome drawn = shell("insonify draw a.npz --sonar port");
  EXPECT_EQ(drawn.out, "./array_waterfall.png\n");
  EXPECT_EQ(drawn.err, "insonify: note: a.npz: no frequency in it, 720 kHz is assumed\n");
}

TEST_F(ForeignFilesTest, WrongFilesAreOneLine) {
  folder.write("text.npy", "hello, this is text");
  folder.write("cut.xtf", padded("{", 500));
  for (const char* command : {"draw", "info", "compare text.npy"}) {
    const Outcome outcome = shell(fmt::format("insonify {} text.npy", command));
    EXPECT_EQ(outcome.status, 2) << command;
    EXPECT_EQ(outcome.err,
              "insonify: text.npy: byte 0: begins with \"hello,\"; an array of NumPy begins with \"\\x93NUMPY\"\n");
  }
  EXPECT_EQ(shell("insonify draw cut.xtf").err,
            "insonify: cut.xtf: byte 0: the file header of 1024 bytes is cut off: the file has 500\n");
}

// What ends the process that reads ends nothing else.
TEST_F(ForeignFilesTest, TheyAreReadByAProcessOfItsOwn) {
  folder.write("a.raw", oculus_picture(a));
  folder.write("reader", "#!/bin/sh\nkill -SEGV $$\n");
  const Outcome outcome = shell("chmod +x reader; INSONIFY_READER=$PWD/reader insonify draw a.raw");
  EXPECT_EQ(outcome.err, "insonify: a.raw: the reader of Oculus files crashed (SIGSEGV)\n");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(shell("insonify --in-process info a.raw").status, 0);
}

}  // namespace
}  // namespace insonify::foreign_files_cli_test
