// surface_noise_test.cpp -- noise of wind and rain that comes from the surface, as beams that look up, ahead and down
// receive it.

#include "insonify/acoustics/sonar_equation.h"
#include "validation/calibrated_scene.h"

namespace insonify::validation::surface_noise_test {
namespace {

constexpr double kPi = std::numbers::pi;

double db(double value) {
  return 10 * std::log10(value);
}

// Beams of 4 x 20 degrees at 100 kHz in a wind of 15 m/s, 11.4 dB above thermal noise.
SonarConfig fan() {
  SonarConfig sonar;
  sonar.frequency = 100e3;
  sonar.beam_count = 30;
  sonar.azimuth_aperture = 120 * kDegree;
  sonar.elevation_aperture = 20 * kDegree;
  sonar.max_range = 20;
  sonar.bin_count = 1000;
  return sonar;
}

Scenario windy(const SonarConfig& sonar) {
  Scenario scenario = calibrated(sonar, kRays);
  scenario.receiver.noise = scenario.receiver.surface_noise = true;
  scenario.receiver.wind_noise = 15;
  return scenario;
}

// Mean over bins and pings of a group of beams, and the intensity of thermal noise in them: SL 200 dB, 25 kHz. 10 000
// bins and more have a standard deviation of 1 %, 0.04 dB.
double mean_of(const Scenario& scenario, int first, int last) {
  Simulator simulator(scenario, {}, 2);
  double sum = 0;
  int count = 0;
  for (int number = 0; number < 6; ++number) {
    const Ping ping = simulator.make_ping(0, number);
    for (int bin = 20; bin < ping.bin_count; ++bin) {
      for (int beam = first; beam < last; ++beam) {
        sum += double{ping.intensity[ping.index(bin, beam)]};
        ++count;
      }
    }
  }
  return sum / count;
}

double per_steradian(double spectrum_db) {
  return std::pow(10, (spectrum_db + db(25e3) - 200) / 10) / (4 * kPi);
}

// Thermal noise over the solid angle of a top hat, and the surface's 4 sin(t) per steradian re the mean over all
// directions, integrated over azimuth and elevation in steps.
double expected(double pitch_up, double azimuth, double lost, double roll = 0) {
  double solid = 0, above = 0;
  constexpr double kStep = 0.05 * kDegree;
  const Eigen::Quaterniond turn = orientation_from_rpy(roll, -pitch_up, 0);
  for (double elevation = -10 * kDegree + 0.5 * kStep; elevation < 10 * kDegree; elevation += kStep) {
    const Vec3 direction = turn * point_from_spherical({1, azimuth, elevation});
    const double weight = 4 * kDegree * std::cos(elevation) * kStep;
    solid += weight;
    above += direction.z() > 0 ? 4 * direction.z() * std::exp(-lost / direction.z()) * weight : 0;
  }
  return solid * per_steradian(thermal_noise_level_db(100e3)) + above * per_steradian(wind_noise_level_db(100e3, 15));
}

TEST(SurfaceNoiseTest, ComesFromAbove) {
  for (const double pitch : {0.0, 30.0, 75.0, -5.0, -40.0}) {
    Scenario scenario = windy(fan());
    scenario.sonars[0].orientation.y() = -pitch * kDegree;
    EXPECT_NEAR(db(mean_of(scenario, 14, 16)), db(expected(pitch * kDegree, 2 * kDegree, 0)), 0.15) << pitch;
  }
  // By hand, looking ahead: 4 (sin^2 10) / 2 over 2 sin 10 is sin 10 of isotropic noise, -7.6 dB.
  Scenario ahead = windy(fan());
  const double thermal = std::pow(10, -1.5 + 4), wind = std::pow(10, wind_noise_level_db(100e3, 15) / 10);
  const double level = mean_of(ahead, 10, 20);
  ahead.receiver.surface_noise = false;
  EXPECT_NEAR(db(level / mean_of(ahead, 10, 20)), db((thermal + wind * std::sin(10 * kDegree)) / (thermal + wind)),
              0.1);
}

// Rolled by 40 degrees to starboard, beams to port look up. Through a chirp in bins longer than it, too.
TEST(SurfaceNoiseTest, DependsOnTheBeamsBearing) {
  Scenario scenario = windy(fan());
  scenario.sonars[0].orientation.x() = 40 * kDegree;
  for (const bool pulse : {false, true}) {
    if (pulse) {
      scenario.receiver.pulse = PulseKind::kLfm;
      scenario.receiver.pulse_duration = 1e-3;
      scenario.receiver.pulse_bandwidth = 50e3;
    }
    const double port = expected(0, 56 * kDegree, 0, 40 * kDegree), middle = expected(0, 0, 0, 40 * kDegree);
    const double starboard = expected(0, -56 * kDegree, 0, 40 * kDegree);
    const double level = mean_of(scenario, 14, 16);
    EXPECT_NEAR(db(mean_of(scenario, 0, 2) / level), db(port / middle), 0.3) << pulse;
    EXPECT_NEAR(db(mean_of(scenario, 28, 30) / level), db(starboard / middle), 0.3) << pulse;
  }
}

// 0.04 dB/m over 60 m and more of water: straight up 2.4 dB.
TEST(SurfaceNoiseTest, IsAbsorbedOnItsWay) {
  Scenario scenario = windy(fan());
  scenario.water.absorption = true;
  scenario.water.absorption_db_per_m = 0.04;
  scenario.water.depth = 60;
  scenario.sonars[0].orientation.y() = -50 * kDegree;
  const double lost = 0.04 * 60 * std::log(10) / 10;
  EXPECT_NEAR(db(mean_of(scenario, 14, 16)), db(expected(50 * kDegree, 2 * kDegree, lost)), 0.15);
}

// A head that is mounted upright looks up and down in turn: 25 pings later it looks down.
TEST(SurfaceNoiseTest, HeadsHearItWhereTheyLook) {
  SonarConfig head = fan();
  head.type = SonarType::kMechanicallyScanned;
  head.beam_count = 1;
  head.azimuth_aperture = 4 * kDegree;
  head.head.mounting = Mounting::kVertical;
  head.head.step = 90 * kDegree;
  Scenario scenario = windy(head);
  Simulator simulator(scenario, {}, 1);
  double means[4] = {};
  for (int number = 0; number < 24; ++number) {
    for (const float value : simulator.make_ping(0, number).intensity) {
      means[number % 4] += double{value} / 6000;
    }
  }
  const double thermal = std::pow(10, -1.5 + 4), wind = std::pow(10, wind_noise_level_db(100e3, 15) / 10);
  // Straight up the noise is 4 <cos> = 3.96 times that of isotropic wind; straight down there is none.
  EXPECT_NEAR(db(means[1] / means[3]), db((thermal + 3.98 * wind) / thermal), 0.3);
}

}  // namespace
}  // namespace insonify::validation::surface_noise_test
