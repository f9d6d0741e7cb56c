// sea_surface_test.cpp -- the windy sea surface of the calibrated model at every grazing angle: reflection loss of
// ghosts and backscatter, against the formulas of TR 9407 written out here.

#include "insonify/sea_surface.h"

#include "insonify/acoustics/surface_scattering.h"
#include "support/test_engine.h"
#include "validation/calibrated_scene.h"

namespace insonify::validation::sea_surface_test {
namespace {

// Loss of one reflection [dB] above 100 kHz: 1.26e-3 / sin(grazing) U^1.57 100^0.85, 100^0.85 = 50.1187.
double bubble_loss_db(double grazing, double wind) {
  const double of_wind = wind >= 6 ? std::pow(wind, 1.57) : std::pow(6, 1.57) * std::exp(1.2 * (wind - 6));
  return 1.26e-3 * 50.118723362727 * of_wind / std::sin(grazing);
}

// By hand for 10 m/s: 1.26e-3 x 37.1535 x 50.1187 = 2.34623 dB straight up; at sin = 0.1 23.4623, at 45
// degrees 3.31807.
TEST(SeaSurfaceLossTest, IsThatWorkedOutByHand) {
  EXPECT_NEAR(bubble_loss_db(0.5 * 3.14159265358979, 10), 2.34623, 1e-4);
  EXPECT_NEAR(bubble_loss_db(std::asin(0.1), 10), 23.4623, 1e-3);
  EXPECT_NEAR(bubble_loss_db(45 * kDegree, 10), 3.31807, 1e-4);
}

class SeaSurfaceEchoTest : public testing::TestWithParam<Method> {
 protected:
  static constexpr double kDepth = 3;

  // A fan with a vertical aperture of 120 degrees, 3 m below the surface.
  static Scenario under_the_sea(double wind, double range) {
    SonarConfig sonar;
    sonar.frequency = 375e3;
    sonar.beam_count = 16;
    sonar.azimuth_aperture = 8 * kDegree;
    sonar.elevation_aperture = 120 * kDegree;
    sonar.min_range = 0.5;
    sonar.max_range = range;
    sonar.bin_count = 2400;
    sonar.sampling = {4, 1000};
    sonar.position = {0, 0, -kDepth};
    Scenario scenario = calibrated(sonar, GetParam());
    scenario.surface = SeaSurface{.wind_speed = wind};
    scenario.secondary = SecondaryEchoes::kAll;
    return scenario;
  }

  // Intensity of all beams within 2 cm and more of a range, less what is there without the target.
  static double level_db(const Ping& ping, const SonarConfig& sonar, double range, double half_width) {
    double sum = 0;
    const std::vector<double> rows = by_range(ping);
    for (int bin = 0; bin < ping.bin_count; ++bin) {
      sum += std::abs(sonar.bin_range(bin) - range) < half_width ? rows[bin] : 0;
    }
    return 10 * std::log10(sum);
  }
};

// Ghosts of an ideal point at the depth of the sonar, x ahead: the grazing angle on the surface is atan(2 depth / x).
// 6.0, 20, 44.8 and 58 degrees.
TEST_P(SeaSurfaceEchoTest, GhostsOfPointsLoseByTheirGrazingAngle) {
  for (const double ahead : {57.0, 16.5, 6.04, 3.7}) {
    for (const double wind : {4.0, 10.0, 13.0}) {
      const double grazing = std::atan(2 * kDepth / ahead), far = std::hypot(ahead, 2 * kDepth);
      const auto levels = [&](double of_wind) {
        Scenario scenario = under_the_sea(of_wind, far + 3);
        scenario.points = {{.position = {ahead, 0, -kDepth}, .target_strength_db = 20}};
        const SonarConfig& sonar = scenario.sonars[0];
        const Ping ping = ping_of(scenario, {});
        Scenario without = scenario;
        without.points.clear();
        const Ping bare = ping_of(without, {});
        Ping ghosts = ping;
        for (std::size_t i = 0; i < ghosts.intensity.size(); ++i) {
          ghosts.intensity[i] -= bare.intensity[i];
        }
        const double narrow = 2 * sonar.bin_length();
        return std::pair(level_db(ghosts, sonar, 0.5 * (ahead + far), narrow), level_db(ghosts, sonar, far, narrow));
      };
      const auto [once_calm, twice_calm] = levels(0);
      const auto [once, twice] = levels(wind);
      const double loss = bubble_loss_db(grazing, wind);
      if (loss < 40) {  // Less is left than the rounding of the surface's own echo.
        EXPECT_NEAR(once - once_calm, -loss, 0.05) << ahead << " m, " << wind << " m/s";
      }
      if (loss < 20) {
        EXPECT_NEAR(twice - twice_calm, -2 * loss, 0.1) << ahead << " m, " << wind << " m/s";
      }
    }
  }
}

// The same of a small sphere, by rays that the surface reflects: path orders 2 and 3 of the grid.
TEST_P(SeaSurfaceEchoTest, GhostsOfBodiesLoseByTheirGrazingAngle) {
  struct Place {
    double ahead, aperture_deg;
  };
  for (const Place& place : {Place{30, 30.0}, Place{6, 120.0}}) {
    const double ahead = place.ahead, aperture = place.aperture_deg;
    for (const double wind : {7.0, 10.0}) {
      const auto levels = [&](double of_wind) {
        Scenario scenario = under_the_sea(0, ahead + 4);
        SonarConfig sonar = scenario.sonars[0];
        sonar.elevation_aperture = aperture * kDegree;
        sonar.azimuth_aperture = 2 * kDegree;
        sonar.beam_count = 4;
        Material sea = sea_surface_material({.wind_speed = of_wind}, sonar.frequency);
        sea.rms_height = 0;  // A sharp ghost: waves would blur it.
        const Scene scene = scene_of_all(
            {plane(-Vec3::UnitZ(), Vec3::Zero(), sea), sphere_at({ahead, 0, -kDepth}, 0.25, diffuse(-10), 0.1)});
        const auto engine = test_engine(GetParam().engine, 2);
        engine->set_scene(scene);
        EchoGrid grid(sonar.beam_count, sonar.bin_count, kPathOrders);
        engine->insonify(*make_flat_plan({.sonar = sonar,
                                          .water = {.absorption = false},
                                          .model = EchoModel::kCalibrated,
                                          .materials = scene.materials,
                                          .primary = GetParam().primary,
                                          .secondary = SecondaryEchoes::kAll}),
                         {.position = {0, 0, -kDepth}}, grid);
        const double far = std::hypot(ahead, 2 * kDepth);
        double sums[2] = {};
        for (int order = 2; order <= 3; ++order) {
          for (int beam = 0; beam < sonar.beam_count; ++beam) {
            for (int bin = 0; bin < sonar.bin_count; ++bin) {
              const double range = sonar.bin_range(bin) - (order == 2 ? 0.5 * (ahead + far) : far);
              sums[order - 2] += range > -0.27 && range < 0.1 ? grid.energy(order, beam)[bin] : 0;
            }
          }
        }
        return std::pair(10 * std::log10(sums[0]), 10 * std::log10(sums[1]));
      };
      const auto [once_calm, twice_calm] = levels(0);
      const auto [once, twice] = levels(wind);
      // Points of the sphere that insonify by the surface lie up to 0.25 m nearer: the grazing angle is larger by up to
      // 0.25 / far, the loss less by that share.
      const double grazing = std::atan(2 * kDepth / ahead), loss = bubble_loss_db(grazing, wind);
      const double tolerance = 0.06 + loss * 0.25 / (2 * kDepth);
      EXPECT_NEAR(once - once_calm, -loss, tolerance) << ahead << " m, " << wind << " m/s";
      EXPECT_NEAR(twice - twice_calm, -2 * loss, 2 * tolerance) << ahead << " m, " << wind << " m/s";
    }
  }
}

// Backscatter of the surface alone. Ring of the surface at the slant range r, seen under the grazing angle g with sin g
// = depth / r, of a fan psi wide: dI = s_b psi dr / r^3 (area r dr dpsi). Absorption is off.
TEST_P(SeaSurfaceEchoTest, BackscatterIsThatOfTheReportAtEveryAngle) {
  for (const double wind : {0.8, 10.0, 17.0}) {
    Scenario scenario = under_the_sea(wind, 30);
    scenario.secondary = SecondaryEchoes::kNone;
    SonarConfig& sonar = scenario.sonars[0];
    sonar.elevation_aperture = 84 * kDegree;
    sonar.elevation_center = 46 * kDegree;
    sonar.azimuth_aperture = 2 * kDegree;
    sonar.beam_count = 4;
    sonar.min_range = 2.9;
    sonar.bin_count = 1084;
    sonar.sampling = {2, 8000};
    const std::vector<double> rows = by_range(ping_of(scenario, {}));
    for (const double grazing_deg : {8.0, 12.0, 20.0, 35.0, 50.0, 62.0, 70.0, 75.0, 80.0}) {
      const double middle = kDepth / std::sin(grazing_deg * kDegree);
      double received = 0, expected = 0;
      for (int bin = 0; bin < sonar.bin_count; ++bin) {
        const double range = sonar.bin_range(bin);
        if (std::abs(range - middle) < 0.02 * middle && range > kDepth + sonar.bin_length()) {
          received += rows[bin];
          constexpr int kParts = 40;  // The echo changes fast near the vertical.
          for (int part = 0; part < kParts; ++part) {
            const double r = range + ((part + 0.5) / kParts - 0.5) * sonar.bin_length();
            expected += sea_surface_backscatter(std::asin(kDepth / r), sonar.frequency, wind) * sonar.azimuth_aperture *
                        sonar.bin_length() / (kParts * r * r * r);
          }
        }
      }
      EXPECT_NEAR(10 * std::log10(received / expected), 0, 0.15) << grazing_deg << " degrees, " << wind << " m/s";
    }
  }
}

constexpr auto kName = [](const auto& test) { return test.param.name; };
INSTANTIATE_TEST_SUITE_P(Methods, SeaSurfaceEchoTest, testing::Values(kReference, kRays), kName);

}  // namespace
}  // namespace insonify::validation::sea_surface_test
