// rough_mirror_return_test.cpp -- sound that goes over a rough mirror out and back.

#include "validation/secondary_grid.h"

namespace insonify::validation::rough_mirror_return_test {
namespace {

// A sonar between two parallel planes looks up at the upper one, a mirror with facets of the slope s; the lower one has
// a lobe of the slope w. Order 3 is the path over the mirror, the lower plane and the mirror again.
struct BetweenPlanes {
  double energy = 0;     // Energy of path order 3.
  double deviation = 0;  // Standard deviation of its azimuth [rad].
  double sharp = 0;      // Its share within kNear of straight up.
};

constexpr double kNear = 2 * kDegree;

BetweenPlanes between_planes(const Method& method, double up, double down, double slope, double lobe, bool rough,
                             double rms_height = 0) {
  Material mirror = glinting(1, slope);
  mirror.rms_height = rms_height;
  Scene scene = scene_of(make_plane(-Vec3::UnitZ(), 400, 400), mirror, {.position = {0, 0, up}});
  const Scene floor = scene_of(make_plane(Vec3::UnitZ(), 400, 400), glinting(1, lobe), {.position = {0, 0, -down}});
  scene.materials.push_back(floor.materials.front());
  scene.instances.push_back(floor.instances.front());
  scene.instances.back().materials.assign(scene.instances.back().materials.size(), 1);
  SonarConfig sonar;
  sonar.beam_count = 120;
  sonar.azimuth_aperture = sonar.elevation_aperture = 60 * kDegree;
  sonar.min_range = 1;
  sonar.max_range = 60;
  sonar.bin_count = 100;
  sonar.sampling = {4, 480};
  const Pose upwards{.orientation = orientation_from_rpy(0, -90 * kDegree, 0)};
  const EchoGrid grid = secondary_grid(method, scene, sonar, upwards, {.rough_mirrors = rough});
  BetweenPlanes found;
  for (int beam = 0; beam < sonar.beam_count; ++beam) {
    const double azimuth = sonar.beam_azimuth(beam);
    for (const float energy : grid.energy(3, beam)) {
      found.energy += energy;
      found.deviation += energy * azimuth * azimuth;
      found.sharp += std::abs(azimuth) < kNear ? energy : 0;
    }
  }
  found.deviation = std::sqrt(found.deviation / found.energy);
  found.sharp /= found.energy;
  return found;
}

class RoughMirrorReturnTest : public testing::TestWithParam<Method> {};

// Where sound that left at a small angle a has been turned by slopes t1 (mirror), t2 (lower plane) and t3 (mirror), it
// is back at the sonar if a L + 2 t1 (L - R1) + 2 t2 (R1 + R2) + 2 t3 R1 = 0, with the whole way L = 2 (R1 + R2). So a
// is Gaussian with the variance s^2 ((1 + c')^2 + c^2) + w^2, c = R1/(R1 + R2) and c' = 1 - c; and the energy is that
// of the image at L whatever the slopes, 1/L^2.
TEST_P(RoughMirrorReturnTest, SpreadsWhatReturnsOverItTwiceAsIndependentSlopesDo) {
  for (const auto& [up, down] : {std::pair{9.0, 0.5}, std::pair{3.0, 7.0}, std::pair{12.0, 2.0}}) {
    for (const auto& [slope, lobe] : {std::pair{0.05, 0.02}, std::pair{0.03, 0.06}}) {
      const double near = up, across = up + down, near_share = near / (near + across), far_share = 1 - near_share;
      const double variance = slope * slope * (std::pow(1 + far_share, 2) + std::pow(near_share, 2)) + lobe * lobe;
      const double image = 1 / std::pow(2 * (near + across), 2);
      for (const double rms_height : {0.0, 0.12e-3}) {  // Facets alone; and g = 0.52.
        const BetweenPlanes found = between_planes(GetParam(), up, down, slope, lobe, rms_height == 0, rms_height);
        EXPECT_NEAR(10 * std::log10(found.energy / image), 0, 0.2) << up << ' ' << slope << ' ' << rms_height;
        EXPECT_NEAR(found.deviation / std::sqrt(variance), 1, 0.04) << up << ' ' << slope << ' ' << rms_height;
      }
    }
  }
}

// The same with the share of each pair of orders: n out and m back, Poisson with the mean g = 4 k^2 h^2, have the
// variances n s^2/g and m s^2/g.
TEST_P(RoughMirrorReturnTest, IsSharpBothWaysWhereItIsCoherent) {
  constexpr double kSlope = 0.04, kLobe = 0.02, kUp = 9, kAcross = 10, kFrequency = 720e3;
  for (const double height : {0.05e-3, 0.1e-3, 0.2e-3}) {
    const double g = std::pow(2 * 2 * kDegree * 180 * kFrequency / 1500 * height, 2);
    const double near_share = kUp / (kUp + kAcross), far_share = 1 - near_share;
    const auto share = [g](int n) { return std::exp(n * std::log(g) - g - std::lgamma(n + 1)); };
    double sharp = 0;
    for (int out = 0; out < 40; ++out) {
      for (int back = 0; back < 40; ++back) {
        const double variance =
            kSlope * kSlope / g * (out * std::pow(1 + far_share, 2) + back * std::pow(near_share, 2)) + kLobe * kLobe;
        sharp += share(out) * share(back) * std::erf(kNear / std::sqrt(2 * variance));
      }
    }
    const BetweenPlanes found = between_planes(GetParam(), kUp, kAcross - kUp, kSlope, kLobe, false, height);
    EXPECT_NEAR(found.sharp, sharp, 0.02) << height;
  }
}

// Small rough faces, some of them in part of a beam only: their few rays are traced together with those of others, and
// the glint by which the sound returns is larger than the face. Each beam has what the reference engine has.
TEST_P(RoughMirrorReturnTest, OverSmallFacesIsThatOfTheReference) {
  Material mirror = glinting(1, 0.08);
  mirror.rms_height = 1e-4;
  Scene scene = scene_of(make_plane(-Vec3::UnitZ(), 0.6, 0.4), mirror, {.position = {0.3, 0.5, 3}});
  for (const auto& [size, material, place] :
       {std::tuple{0.1, 0, Vec3(0, -0.2, 2.5)}, std::tuple{30.0, 1, Vec3(0, 0, -1)}}) {
    const Scene more = scene_of(make_plane((material == 0 ? -1.0 : 1.0) * Vec3::UnitZ(), size, size), glinting(1, 0.06),
                                {.position = place});
    scene.instances.push_back(more.instances.front());
    scene.instances.back().materials.assign(scene.instances.back().materials.size(), material);
    if (material == 1) {
      scene.materials.push_back(more.materials.front());
    }
  }
  SonarConfig sonar;
  sonar.beam_count = 30;
  sonar.azimuth_aperture = sonar.elevation_aperture = 50 * kDegree;
  sonar.max_range = 12;
  sonar.bin_count = 60;
  sonar.sampling = {4, 150};
  const Pose upwards{.orientation = orientation_from_rpy(0, -90 * kDegree, 0)};
  const EchoGrid grid = secondary_grid(GetParam(), scene, sonar, upwards),
                 expected = secondary_grid(kReference, scene, sonar, upwards);
  int heard = 0;
  for (int beam = 0; beam < sonar.beam_count; ++beam) {
    const auto here = grid.energy(3, beam), there = expected.energy(3, beam);
    double sum = 0, difference = 0;
    for (std::size_t bin = 0; bin < there.size(); ++bin) {
      sum += there[bin];
      difference += std::abs(here[bin] - there[bin]);
    }
    heard += sum > 0 ? 1 : 0;
    EXPECT_LE(difference, 5e-3 * sum) << beam;
  }
  EXPECT_GT(heard, 5);
}

// A plate of bare steel that leans back below the waves: sound goes from it to the surface and back over it. What the
// sea scatters less than its facets' lobe was taken off a lobe of another width, which left less than nothing.
TEST(RoughMirrorReturnScenarioTest, PlatesUnderAWindySeaHaveFiniteEchoes) {
  const auto steel = std::ranges::find(material_library(), "steel", &Material::name);
  ASSERT_NE(steel, material_library().end());
  for (const char* engine : {"cpu", "reference"}) {
    for (const double lean : {20.0, 40.0, 48.0}) {
      for (const double wind_speed : {1.0, 3.0, 8.0}) {
        Scenario scenario;
        scenario.engine = engine;
        scenario.receiver.noise = false;
        scenario.surface = SeaSurface{.level = 0, .wind_speed = wind_speed};
        SonarConfig sonar;
        sonar.position = {0, 0, -3};
        sonar.elevation_aperture = 40 * kDegree;
        sonar.max_range = 20;
        sonar.beam_count = 32;
        sonar.bin_count = 200;
        sonar.sampling = {4, 160};
        scenario.sonars = {sonar};
        const Scene scene =
            scene_of(make_box({0.5, 12, 8}), *steel,
                     {.position = {8, 0, -3}, .orientation = orientation_from_rpy(0, lean * kDegree, 0)});
        const Ping ping = Simulator(scenario, scene, 2).make_ping(0, 0);
        EXPECT_TRUE(std::ranges::all_of(ping.intensity, [](float value) { return value >= 0 && std::isfinite(value); }))
            << engine << ' ' << lean << ' ' << wind_speed;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, RoughMirrorReturnTest, testing::Values(kRays, kRaster),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace insonify::validation::rough_mirror_return_test
