// noise_level_test.cpp -- solid angle of the receive pattern and level of the noise in a beam, against closed forms and
// brute force.

#include "receiver/noise/noise_level.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "insonify/array_pattern.h"

namespace insonify::noise_level_test {
namespace {

constexpr double kPi = std::numbers::pi;

SonarConfig fan(double width_deg, double height_deg) {
  SonarConfig sonar;
  sonar.azimuth_resolution = radians_from_degrees(width_deg);
  sonar.elevation_aperture = radians_from_degrees(height_deg);
  return sonar;
}

ReceiverConfig with(BeamPattern azimuth, BeamPattern elevation = BeamPattern::kTopHat) {
  ReceiverConfig receiver;
  receiver.azimuth_pattern = azimuth;
  receiver.elevation_pattern = elevation;
  return receiver;
}

double directivity_db(const SonarConfig& sonar, const ReceiverConfig& receiver) {
  return 10 * std::log10(4 * kPi / receive_solid_angle(sonar, receiver));
}

// 10 log10(4 pi / (width 2 sin(height / 2))) of the slice that its echoes come from, whatever its resolution.
TEST(NoiseLevelTest, TopHatHasTheDirectivityOfItsSlice) {
  for (const int beams : {60, 256, 480}) {
    for (const auto& [width, height, expected] : {std::tuple{1.0, 20.0, 33.166322707556866},
                                                  {0.5, 20.0, 36.176622664196675},
                                                  {2.0, 25.0, 29.199357544902448},
                                                  {0.25, 12.0, 41.39127926462472},
                                                  {1.0, 90.0, 27.06817498599278}}) {
      SonarConfig sonar = fan(width, height);
      sonar.azimuth_resolution = 0.02;
      sonar.azimuth_aperture = beams * radians_from_degrees(width);
      sonar.beam_count = beams;
      EXPECT_NEAR(directivity_db(sonar, with(BeamPattern::kTopHat)), expected, 1e-6) << beams << ", " << width;
    }
  }
  SonarConfig plain;
  plain.beam_count = 120;
  EXPECT_NEAR(directivity_db(plain, with(BeamPattern::kTopHat)), 33.166322707556866, 1e-9);
  // A sector from 10 to 30 degrees up: sin 30 - sin 10.
  plain.elevation_center = radians_from_degrees(20);
  EXPECT_NEAR(receive_solid_angle(plain, with(BeamPattern::kTopHat)), kPi / 180 * (0.5 - 0.17364817766693033), 1e-12);
}

// A line without a window: the integral of sinc^2 is wavelength / D, where the half-power width is 0.88589 of that.
// With a window it is larger by one over the taper efficiency: 1.5 for Hann, whose half-power width is 1.44058.
TEST(NoiseLevelTest, LineHasTheIntegralOfItsPattern) {
  const SonarConfig sonar = fan(1.4, 20);
  const double u = 2 * std::sin(radians_from_degrees(0.7)), height = 2 * std::sin(radians_from_degrees(10));
  EXPECT_NEAR(receive_solid_angle(sonar, with(BeamPattern::kRectangular)) / (u / 0.8858929413781328 * height), 1, 1e-6);
  EXPECT_NEAR(receive_solid_angle(sonar, with(BeamPattern::kHann)) / (1.5 * u / 1.4405795 * height), 1, 1e-5);
  // The head of a scanning sonar transmits with its array too, but noise is only received.
  SonarConfig head = sonar;
  head.type = SonarType::kMechanicallyScanned;
  head.beam_count = 1;
  EXPECT_EQ(receive_solid_angle(head, with(BeamPattern::kRectangular)),
            receive_solid_angle(sonar, with(BeamPattern::kRectangular)));
}

// The integral over the half-space in front, summed over a grid of bearing and elevation, for a line of elements too.
TEST(NoiseLevelTest, AgreesWithTheSumOverAllDirections) {
  for (const BeamPattern azimuth : {BeamPattern::kRectangular, BeamPattern::kTaylor, BeamPattern::kCosine}) {
    for (const int elements : {0, 80}) {
      for (const double width : {2.0, 5.0}) {
        const SonarConfig sonar = fan(width, 24);
        ReceiverConfig receiver = with(azimuth, BeamPattern::kHann);
        receiver.elements = elements;
        ArraySettings line;
        line.window = azimuth == BeamPattern::kTaylor   ? ArrayWindow::kTaylor
                      : azimuth == BeamPattern::kCosine ? ArrayWindow::kCosine
                                                        : ArrayWindow::kRectangular;
        line.elements = elements;
        const ArrayPattern across(line), up({.window = ArrayWindow::kHann});
        const double length = across.length(1, radians_from_degrees(width));
        const double height = up.length(1, radians_from_degrees(24));
        double bearings = 0, elevations = 0;
        constexpr int kSteps = 40000;
        for (int i = 0; i < kSteps; ++i) {
          const double angle = ((i + 0.5) / kSteps - 0.5) * kPi;
          bearings += across.intensity(length * std::sin(angle)) * kPi / kSteps;
          elevations += up.intensity(height * std::sin(angle)) * std::cos(angle) * kPi / kSteps;
        }
        EXPECT_NEAR(receive_solid_angle(sonar, receiver) / (bearings * elevations), 1, 0.01)
            << static_cast<int>(azimuth) << ", " << elements << ", " << width;
      }
    }
  }
}

// Errors of the parts across elevations widen the pattern: the sum over elevations of the same pattern. 24 degrees are
// 0.8858929 / (2 sin 12 deg) = 2.130487 wavelengths, 4.260974 parts, and 1 dB and 15 degrees are exp(0.0132555 +
// 0.0685389) - 1 = 0.0852324.
TEST(NoiseLevelTest, ErrorsAcrossElevationsWidenThePattern) {
  SonarConfig sonar = fan(2, 24);
  sonar.elevation_element_error_db = 1;
  sonar.elevation_element_error = radians_from_degrees(15);
  constexpr double kScattered = 0.0852324 / 4.260974;
  double filled = 0, perfect = 0;
  constexpr int kSteps = 40000;
  for (int i = 0; i < kSteps; ++i) {
    const double angle = ((i + 0.5) / kSteps - 0.5) * kPi;
    const auto square = [](double x) { return std::pow(std::sin(kPi * x) / (kPi * x), 2); };
    const double one = square(2.130487 * std::sin(angle));
    perfect += one * std::cos(angle);
    filled += (one + kScattered * square(0.5 * std::sin(angle))) / (1 + kScattered) * std::cos(angle);
  }
  const ReceiverConfig receiver = with(BeamPattern::kRectangular, BeamPattern::kRectangular);
  const double solid_angle = receive_solid_angle(sonar, receiver);
  EXPECT_NEAR(solid_angle / receive_solid_angle(fan(2, 24), receiver), filled / perfect, 1e-4);
  EXPECT_GT(filled / perfect, 1.04);
  // A top hat has no parts.
  EXPECT_EQ(receive_solid_angle(sonar, with(BeamPattern::kRectangular)),
            receive_solid_angle(fan(2, 24), with(BeamPattern::kRectangular)));
}

// 720 kHz, 25 kHz, 200 dB: -15 + 20 log10(720) + 43.97940 - 33.16632 - 200 = -147.04027 dB. Half as wide a beam hears
// half of that; its resolution does not matter.
TEST(NoiseLevelTest, IsThatOfTheSonarEquation) {
  SonarConfig sonar = fan(1, 20);
  for (const int beams : {60, 480}) {
    sonar.azimuth_resolution = 0.02;
    sonar.azimuth_aperture = beams * radians_from_degrees(1);
    sonar.beam_count = beams;
    EXPECT_NEAR(10 * std::log10(noise_intensity(sonar, with(BeamPattern::kTopHat), Pulse({}, 1500, 0.05))), -147.04027,
                1e-5);
  }
  sonar.azimuth_aperture *= 0.5;
  EXPECT_NEAR(10 * std::log10(noise_intensity(sonar, with(BeamPattern::kTopHat), Pulse({}, 1500, 0.05))),
              -147.04027 - 3.0103, 1e-5);
}

// Powers add. At 150 kHz: thermal 28.5218 dB; wind of 7 m/s 50 + 19.8431 + 43.5218 - 40 lg 150.4 = 26.2750; rain of 4
// mm/h 42.4 + 9.2717 - 23.5218 = 28.1499; ships 1: 50 + 56.5784 - 60 lg 150.03 = -23.9923; ambient 20. Powers: 711.51 +
// 424.14 = 1135.65; with 653.12, 0.0040 and 100: 1888.77.
TEST(NoiseSpectrumTest, SumsThePowersOfItsCauses) {
  SonarConfig sonar;
  sonar.frequency = 150e3;
  ReceiverConfig receiver;
  EXPECT_NEAR(noise_spectrum_db(sonar, receiver), 28.521825, 1e-6);
  receiver.wind_noise = 7;
  EXPECT_NEAR(noise_spectrum_db(sonar, receiver), 30.552437, 1e-5);
  receiver.rain_noise = 4;
  receiver.ship_noise = 1;
  receiver.ambient_noise_db = 20;
  EXPECT_NEAR(noise_spectrum_db(sonar, receiver), 32.761785, 1e-5);
  receiver = {};
  receiver.rain_noise = 0;  // Dry.
  EXPECT_NEAR(noise_spectrum_db(sonar, receiver), 28.521825, 1e-6);
  // The instrument's own 40 dB, ten thousand: 10711.51 in all.
  sonar.self_noise_db = 40;
  EXPECT_NEAR(noise_spectrum_db(sonar, receiver), 40.298507, 1e-5);
}

}  // namespace
}  // namespace insonify::noise_level_test
