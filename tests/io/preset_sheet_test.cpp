// preset_sheet_test.cpp -- the numbers of every preset are those of its instrument's data sheet.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "insonify/files.h"

namespace insonify::preset_sheet_test {
namespace {

// Tolerance: one digit more than the data sheets have.
constexpr double kSheetTolerance = 1e-9;

struct Sheet {
  const char* name;
  const char* mode;
  double frequency;  // [Hz]
  int beams;
  double azimuth, elevation;  // Full apertures [deg].
  double near, far;           // [m]
  bool sounds = false;        // Whether it is a multibeam that sounds the bottom.
};

// Data sheets of the presets' instruments, row by row; Oculus M1200d and ARIS from their manuals.
constexpr Sheet kSheets[] = {
    {"tritech-gemini-720i", "", 720e3, 256, 120, 20, .2, 120},
    {"tritech-gemini-720is", "", 720e3, 512, 120, 20, .2, 120},
    {"tritech-gemini-720im", "", 720e3, 128, 90, 20, .2, 50},
    {"tritech-gemini-1200ik", "low", 720e3, 512, 120, 20, .1, 120},
    {"tritech-gemini-1200ik", "high", 1200e3, 512, 120, 12, .1, 50},
    {"blueprint-oculus-m370s", "", 375e3, 256, 130, 20, .2, 200},
    {"blueprint-oculus-m750d", "low", 750e3, 512, 130, 20, .1, 120},
    {"blueprint-oculus-m750d", "high", 1200e3, 512, 70, 12, .1, 40},
    {"blueprint-oculus-m1200d", "low", 1200e3, 512, 130, 20, .1, 40},
    {"blueprint-oculus-m1200d", "high", 2100e3, 512, 60, 12, .1, 10},
    {"blueprint-oculus-m3000d", "low", 1200e3, 512, 130, 20, .1, 30},
    {"blueprint-oculus-m3000d", "high", 3000e3, 512, 40, 20, .1, 5},
    {"teledyne-blueview-p900-45", "", 900e3, 256, 45, 20, .4, 100},
    {"teledyne-blueview-p900-130", "", 900e3, 768, 130, 20, .4, 100},
    {"teledyne-blueview-m900-2250", "low", 900e3, 768, 130, 20, 1, 100},
    {"teledyne-blueview-m900-2250", "high", 2250e3, 768, 130, 20, .5, 10},
    {"soundmetrics-aris-explorer-3000", "high", 3000e3, 128, 30, 15, .7, 5},
    {"soundmetrics-aris-explorer-3000", "low", 1800e3, 64, 30, 15, .7, 15},
    {"soundmetrics-aris-explorer-1800", "high", 1800e3, 96, 28, 14, .7, 15},
    {"soundmetrics-aris-explorer-1800", "low", 1100e3, 48, 28, 14, .7, 35},
    {"soundmetrics-didson", "high", 1800e3, 96, 29, 14, 1, 12},
    {"soundmetrics-didson", "low", 1100e3, 48, 29, 14, 1, 40},
    {"kongsberg-m3", "imaging", 500e3, 256, 120, 30, .2, 150},
    {"kongsberg-m3", "enhanced", 500e3, 256, 140, 30, .2, 150},
    {"kongsberg-m3", "profiling", 500e3, 256, 120, 3, .2, 150},
    {"tritech-micron-dst", "", 700e3, 1, 3, 35, .3, 75},
    {"tritech-super-seaking", "low", 325e3, 1, 3, 20, .4, 300},
    {"tritech-super-seaking", "high", 675e3, 1, 1.5, 40, .4, 100},
    {"bluerobotics-ping360", "", 750e3, 1, 2, 25, 0, 50},  // From 0.75 m by its sheet, but it records from 0.
    {"imagenex-881a", "310khz", 310e3, 1, 4, 40, .15, 200},
    {"imagenex-881a", "675khz", 675e3, 1, 1.8, 20, .15, 200},
    {"imagenex-881a", "1000khz", 1000e3, 1, .9, 10, .15, 200},
    {"edgetech-4125", "400khz", 400e3, 2, .46, 50, 1.5, 150},
    {"edgetech-4125", "900khz", 900e3, 2, .28, 50, .8, 75},
    {"edgetech-4125", "600khz", 600e3, 2, .33, 50, 1.2, 120},
    {"edgetech-4125", "1600khz", 1600e3, 2, .2, 50, .6, 35},
    {"edgetech-4200", "300khz", 300e3, 2, .28, 50, 3, 230},
    {"klein-3500", "455khz", 455e3, 2, .34, 45, 1.5, 150},
    {"klein-3500", "900khz", 900e3, 2, .34, 45, .8, 75},
    {"starfish-452f", "", 450e3, 2, .8, 60, .5, 100},
    {"starfish-990f", "", 1000e3, 2, .3, 60, .5, 35},
    {"deepvision-de680", "", 680e3, 2, .7, 60, .8, 100},
    {"marinesonic-arc-scout", "900khz", 900e3, 2, .4, 50, .8, 75},
    {"r2sonic-2024", "200khz", 200e3, 256, 130, 20, 2, 500, true},
    {"r2sonic-2024", "400khz", 400e3, 256, 130, 20, 2, 200, true},
    {"kongsberg-em2040", "300khz", 300e3, 256, 140, 20, .5, 400, true},
    {"norbit-iwbms", "400khz", 400e3, 256, 140, 20, .2, 275, true},
    {"reson-seabat-t50-p", "400khz", 400e3, 512, 150, 20, .5, 250, true},
    {"cerulean-surveyor-240-16", "", 240e3, 64, 80, 30, .5, 150, true},
};

class SheetTest : public testing::TestWithParam<Sheet> {};

TEST_P(SheetTest, PresetHasItsNumbers) {
  const Sheet& sheet = GetParam();
  const SonarConfig sonar = load_preset(sheet.name, sheet.mode).sonar;
  EXPECT_NEAR(sonar.frequency, sheet.frequency, kSheetTolerance);
  EXPECT_EQ(sonar.beam_count, sheet.beams);
  EXPECT_NEAR(degrees_from_radians(sonar.azimuth_aperture), sheet.azimuth, kSheetTolerance);
  EXPECT_NEAR(degrees_from_radians(sonar.elevation_aperture), sheet.elevation, kSheetTolerance);
  EXPECT_NEAR(sonar.min_range, sheet.near, kSheetTolerance);
  EXPECT_NEAR(sonar.max_range, sheet.far, kSheetTolerance);
  EXPECT_EQ(sonar.type, sheet.sounds       ? SonarType::kMultibeam
                        : sheet.beams == 1 ? SonarType::kMechanicallyScanned
                        : sheet.beams == 2 ? SonarType::kSideScan
                                           : SonarType::kForwardLooking);
}

INSTANTIATE_TEST_SUITE_P(All, SheetTest, testing::ValuesIn(kSheets), [](const auto& sheet) {
  std::string name = std::string(sheet.param.name) + "_" + sheet.param.mode;
  std::ranges::replace(name, '-', '_');
  return name;
});

}  // namespace
}  // namespace insonify::preset_sheet_test
