// sonar_equation_test.cpp -- the sonar equation against independently computed values; closed forms of floor, wall and
// volume also against sums over small patches.

#include "insonify/acoustics/sonar_equation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "insonify/acoustics/absorption.h"
#include "insonify/acoustics/backscatter.h"
#include "insonify/acoustics/target_strength.h"
#include "insonify/geometry.h"
#include "insonify/water.h"
#include "support/message_of.h"
#include "support/relative.h"

namespace insonify::sonar_equation_test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180;
constexpr double kAbsorption = 0.22346103868627712;  // Ainslie and McColm at 720 kHz, 10 degC, 35 PSU, pH 8 [dB/m].
const double kDeepFloor = std::pow(10, -2.7);        // Mackenzie's Lambert parameter.

double db(double ratio) {
  return 10 * std::log10(ratio);
}

// ---------------------------------------------------------------- Sonar equation

TEST(TransmissionLossTest, IsSpreadingAndAbsorption) {
  const double there_and_back_db[][2] = {
      {1, 0.44692207737255424}, {10, 44.46922077372554}, {50, 90.30490404206846}, {120, 136.7978991266115}};
  for (const auto& [range, expected] : there_and_back_db) {
    EXPECT_THAT(2 * transmission_loss_db(range, kAbsorption), RelativelyNear(expected));
  }
  EXPECT_THAT(transmission_loss_db(10, absorption_db_per_m(720e3, Water{})), RelativelyNear(22.23461038686277));
}

TEST(ThermalNoiseTest, IsThatOfMellen) {
  const double levels_db[][2] = {{100e3, 25},
                                 {375e3, 36.48062535455438},
                                 {720e3, 42.14664992862537},
                                 {1.2e6, 46.583624920952495},
                                 {3e6, 54.54242509439325}};
  for (const auto& [frequency, expected] : levels_db) {
    EXPECT_THAT(thermal_noise_level_db(frequency), RelativelyNear(expected));
  }
}

TEST(DirectivityIndexTest, IsTheShareOfTheSphere) {
  EXPECT_THAT(sector_directivity_index_db(1 * kDegree, 20 * kDegree), RelativelyNear(33.166322707556866));
  EXPECT_THAT(sector_directivity_index_db(3 * kDegree, 35 * kDegree), RelativelyNear(26.010394419297636));
  EXPECT_THAT(sector_directivity_index_db(2 * kDegree, 25 * kDegree), RelativelyNear(29.199357544902448));
  EXPECT_EQ(sector_directivity_index_db(2 * kPi, kPi), 0);
}

// A link at 720 kHz, B = 25 kHz, SL = 200 dB, 1 x 20 degrees, to a sphere of 0.5 m and to TS = 0 dB. At 120 m the
// signal is some 10 dB above the noise, which is how far a sonar of this class is said to see.
TEST(SonarEquationTest, GivesTheRangeOfASonar) {
  const double di = sector_directivity_index_db(1 * kDegree, 20 * kDegree);
  const double noise = noise_level_db(thermal_noise_level_db(720e3), 25e3, di);
  EXPECT_THAT(noise, RelativelyNear(52.95972730778889));
  EXPECT_THAT(noise - 200, RelativelyNear(-147.04027269221112));  // The noise of an empty ping, re source.
  const double sphere = target_strength_db(sphere_cross_section(0.5));
  const double at_10 = echo_level_db(200, transmission_loss_db(10, kAbsorption), sphere);
  const double at_50 = echo_level_db(200, transmission_loss_db(50, kAbsorption), sphere);
  const double at_120 = echo_level_db(200, transmission_loss_db(120, kAbsorption), 0);
  EXPECT_THAT(at_10, RelativelyNear(143.4895793997152));
  EXPECT_THAT(at_50, RelativelyNear(97.65389613137229));
  EXPECT_THAT(at_120, RelativelyNear(63.2021008733885));
  EXPECT_NEAR(at_10 - noise, 90.53, 0.005);
  EXPECT_NEAR(at_50 - noise, 44.69, 0.005);
  EXPECT_NEAR(at_120 - noise, 10.24, 0.005);
}

// ---------------------------------------------------------------- Floor

struct Bin {
  double start, end, level_db, absorbed_db;
};

// mu = -27 dB, 3 m above the floor, 1 degree; computed independently of this code, with absorption by quadrature.
constexpr Bin kFloorBins[] = {{5, 5.05, -83.10536700710671, -85.35105301195526},
                              {10, 10.05, -98.10318520972058, -102.58352780667443},
                              {20, 20.05, -113.12769357954411, -122.07728014007046},
                              {40, 40.05, -128.1656597441832, -146.05369946891113}};

TEST(LambertFloorTest, IsThatOfTheClosedForm) {
  for (const Bin& bin : kFloorBins) {
    EXPECT_THAT(db(lambert_floor_intensity(kDeepFloor, 3, kDegree, bin.start, bin.end)), RelativelyNear(bin.level_db));
    EXPECT_THAT(db(lambert_floor_intensity(kDeepFloor, 3, kDegree, bin.start, bin.end, kAbsorption)),
                RelativelyNear(bin.absorbed_db));
  }
}

// -50 dB per decade of range: the area grows by 10, spreading takes 40, sin^2 of the grazing angle takes 20.
TEST(LambertFloorTest, FallsFiftyDecibelsADecade) {
  const double near = lambert_floor_intensity(0.01, 1, 0.02, 10, 10.001);
  const double far = lambert_floor_intensity(0.01, 1, 0.02, 100, 100.001);
  EXPECT_NEAR(db(far / near), -50, 0.01);
}

// The sum over patches of floor of mu cos^2(incidence) dA/r^4 10^(-alpha r/5), in rings of floor rather than of range.
TEST(LambertFloorTest, IsTheSumOfItsPatches) {
  const double altitude = 2.5;
  const double width = 0.03;
  double sum = 0;
  const double inner = std::sqrt(6 * 6 - altitude * altitude);
  const double outer = std::sqrt(15 * 15 - altitude * altitude);
  constexpr int kRings = 20000;
  const double step = (outer - inner) / kRings;
  for (int i = 0; i < kRings; ++i) {
    const double radius = inner + (i + 0.5) * step;
    const double range = std::hypot(radius, altitude);
    const double area = width * radius * step;
    sum += lambert_backscatter(0.05, std::acos(altitude / range)) * area / std::pow(range, 4) *
           std::pow(10, -0.2 * kAbsorption * range);
  }
  EXPECT_NEAR(lambert_floor_intensity(0.05, altitude, width, 6, 15, kAbsorption) / sum, 1, 1e-6);
}

TEST(LambertFloorTest, BeginsStraightBelow) {
  EXPECT_EQ(lambert_floor_intensity(0.01, 3, 0.02, 1, 2), 0);
  EXPECT_EQ(lambert_floor_intensity(0.01, 3, 0.02, 1, 3), 0);
  EXPECT_EQ(lambert_floor_intensity(0.01, 3, 0.02, 1, 4, 0.1), lambert_floor_intensity(0.01, 3, 0.02, 3, 4, 0.1));
}

// For any bin length and absorption, the parts of a bin sum to the whole.
TEST(LambertFloorTest, BinsAddUp) {
  for (const double absorption : {0.0, 0.01, 0.5, 3.0}) {
    for (const double start : {2.0, 100.0}) {
      const auto bin = [&](double from, double to) {
        return lambert_floor_intensity(0.01, 1, 0.02, from, to, absorption);
      };
      const double parts = bin(start, start + 1.7) + bin(start + 1.7, start + 9) + bin(start + 9, 200);
      EXPECT_THAT(parts, RelativelyNear(bin(start, 200))) << "at " << absorption << " dB/m from " << start << " m";
    }
  }
}

// ---------------------------------------------------------------- Wall

// mu = -27 dB, 10 m ahead, 1 degree wide and +-10 degrees high; computed independently of this code.
TEST(LambertWallTest, IsThatOfTheClosedForm) {
  const double levels_db[][2] = {{0, -69.23989881843399}, {30, -71.11397986755848}, {50, -74.99787391586094}};
  for (const auto& [azimuth_deg, expected] : levels_db) {
    const double azimuth = azimuth_deg * kDegree;
    EXPECT_THAT(db(lambert_wall_intensity(kDeepFloor, 10, azimuth, kDegree, 20 * kDegree)), RelativelyNear(expected));
    EXPECT_EQ(lambert_wall_intensity(kDeepFloor, 10, azimuth, kDegree, 20 * kDegree),
              lambert_wall_intensity(kDeepFloor, 10, -azimuth, kDegree, 20 * kDegree));
  }
}

// The sum over a narrow strip of wall, upwards, of mu cos^2(incidence) dA/r^4.
TEST(LambertWallTest, IsTheSumOfItsPatches) {
  const double distance = 7;
  const double azimuth = 0.5;
  const double width = 1e-4;
  const double half_height = 0.6;
  double sum = 0;
  constexpr int kRows = 4000;
  for (int row = 0; row < kRows; ++row) {
    const double elevation = half_height * ((row + 0.5) / kRows * 2 - 1);
    const double cosine = std::cos(azimuth) * std::cos(elevation);
    const double range = distance / cosine;
    const double solid_angle = std::cos(elevation) * 2 * half_height / kRows * width;
    const double area = range * range * solid_angle / cosine;
    sum += lambert_backscatter(0.05, std::acos(cosine)) * area / std::pow(range, 4);
  }
  EXPECT_NEAR(lambert_wall_intensity(0.05, distance, azimuth, width, 2 * half_height) / sum, 1, 1e-6);
}

// ---------------------------------------------------------------- Water

// S_v = -70 dB, 1 x 20 degrees, bins of 5 cm; computed independently of this code.
TEST(VolumeReverberationTest, IsThatOfTheClosedForm) {
  const double levels_db[][2] = {{5, -119.20713784852252}, {10, -125.20618464154067}, {20, -131.2159677501773}};
  for (const auto& [start, expected] : levels_db) {
    EXPECT_THAT(db(volume_reverberation_intensity(1e-7, kDegree, 20 * kDegree, start, start + 0.05)),
                RelativelyNear(expected));
  }
}

TEST(VolumeReverberationTest, FallsTwentyDecibelsADecade) {
  const double near = volume_reverberation_intensity(1e-7, 0.02, 0.4, 10, 10.001);
  const double far = volume_reverberation_intensity(1e-7, 0.02, 0.4, 100, 100.001);
  EXPECT_NEAR(db(far / near), -20, 0.01);
}

// In a thin bin absorption takes 2 alpha r.
TEST(VolumeReverberationTest, IsAbsorbedBothWays) {
  const double free = volume_reverberation_intensity(1e-7, 0.02, 0.4, 30, 30.0001);
  const double absorbed = volume_reverberation_intensity(1e-7, 0.02, 0.4, 30, 30.0001, 0.5);
  EXPECT_NEAR(db(absorbed / free), -2 * 0.5 * 30, 1e-3);
}

TEST(SonarEquationTest, RefusesArgumentsOutOfLimits) {
  const auto message = [](auto act) { return message_of([&] { static_cast<void>(act()); }); };
  EXPECT_EQ(message([] { return transmission_loss_db(0, 0.1); }),
            "transmission_loss_db.range = 0 m must be greater than 0 m");
  EXPECT_EQ(message([] { return transmission_loss_db(1, -0.1); }),
            "transmission_loss_db.absorption_db_per_m = -0.1 dB/m must be at least 0 dB/m");
  EXPECT_EQ(message([] { return thermal_noise_level_db(0); }),
            "thermal_noise_level_db.frequency = 0 Hz must be greater than 0 Hz");
  EXPECT_EQ(
      message([] { return sector_directivity_index_db(0.1, 4); }),
      "sector_directivity_index_db.elevation_width_deg = 229.1831181 deg must be greater than 0, at most 180 deg");
  EXPECT_EQ(message([] { return noise_level_db(40, -1, 30); }),
            "noise_level_db.bandwidth = -1 Hz must be greater than 0 Hz");
  EXPECT_EQ(message([] { return lambert_floor_intensity(0.01, 0, 0.02, 1, 2); }),
            "lambert_floor_intensity.altitude = 0 m must be greater than 0 m");
  EXPECT_EQ(message([] { return volume_reverberation_intensity(1e-7, 0.02, 0.4, 3, 2); }),
            "volume_reverberation_intensity.bin_end = 2 m must be greater than bin_start = 3 m");
  EXPECT_EQ(message([] { return lambert_wall_intensity(0.1, 5, 2, 0.02, 0.4); }),
            "lambert_wall_intensity.azimuth_deg = 114.591559 deg must be from -90 to 90 deg");
}

// By hand, f in kHz. Wind 9 m/s at 0.6 kHz: 50 + 22.5 - 4.436975 - 40 lg 1.0 = 68.063025. Wind 10 at 100: 50
// + 23.717082
// + 40 - 40 lg 100.4 = 33.647734. Calm at 300: 50 + 49.542425 - 40 lg 300.4 = 0.434428. Ships 0.7 at 0.07: 40 + 4 + 26
// lg 0.07 - 60 lg 0.1 = 73.972549. Rain of 10 mm/h at 2, 10 and 200: 57.8, 57.8, 57.8 - 26.0206.
TEST(AmbientNoiseTest, HasTheLevelsOfWindShipsAndRain) {
  EXPECT_NEAR(wind_noise_level_db(600, 9), 68.063025, 1e-6);
  EXPECT_NEAR(wind_noise_level_db(100e3, 10), 33.647734, 1e-6);
  EXPECT_NEAR(wind_noise_level_db(300e3, 0), 0.434428, 1e-6);
  EXPECT_NEAR(ship_noise_level_db(70, 0.7), 73.972549, 1e-6);
  EXPECT_NEAR(rain_noise_level_db(2e3, 10), 57.8, 1e-6);
  EXPECT_NEAR(rain_noise_level_db(10e3, 10), 57.8, 1e-6);
  EXPECT_NEAR(rain_noise_level_db(200e3, 10), 31.779400, 1e-6);
}

// Above 10 kHz wind and rain fall by 20 dB a decade, to 0.05 dB, and ships by 34.
TEST(AmbientNoiseTest, FallsWithFrequency) {
  EXPECT_NEAR(wind_noise_level_db(50e3, 5) - wind_noise_level_db(500e3, 5), 20, 0.15);
  EXPECT_NEAR(rain_noise_level_db(50e3, 5) - rain_noise_level_db(500e3, 5), 20, 1e-9);
  EXPECT_NEAR(ship_noise_level_db(50e3, 0) - ship_noise_level_db(500e3, 0), 34, 0.02);
}

}  // namespace
}  // namespace insonify::sonar_equation_test
