// rough_mirror_return_test.cpp -- sound that goes over a rough mirror out and back.

#include <numbers>

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

constexpr double kFan = 60 * kDegree;
constexpr int kBeams = 480;
constexpr double kSpeed = 1500, kFrequency = 720e3;

BetweenPlanes between_planes(const Method& method, double up, double down, double slope, double lobe, bool rough,
                             double rms_height = 0, int beams = kBeams) {
  Material mirror = glinting(1, slope);
  mirror.rms_height = rms_height;
  Scene scene = scene_of(make_plane(-Vec3::UnitZ(), 400, 400), mirror, {.position = {0, 0, up}});
  const Scene floor = scene_of(make_plane(Vec3::UnitZ(), 400, 400), glinting(1, lobe), {.position = {0, 0, -down}});
  scene.materials.push_back(floor.materials.front());
  scene.instances.push_back(floor.instances.front());
  scene.instances.back().materials.assign(scene.instances.back().materials.size(), 1);
  SonarConfig sonar;
  sonar.beam_count = beams;
  sonar.azimuth_aperture = sonar.elevation_aperture = kFan;
  sonar.min_range = 1;
  sonar.max_range = 60;
  sonar.bin_count = 100;
  sonar.sampling = {kBeams / beams, 480};
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

// What the interference of the ways over two facets with the opposite ways adds to an energy of 1, in beams of the
// given width. Their bearings differ by a Gaussian of the deviation d = sqrt(2) 2 s c', of which the share
// erf(b/(sqrt(2) d)) - sqrt(2/pi) (d/b) (1 - e^(-b^2/(2 d^2))) has both in a beam of the width b. By the fourth moment
// of Rice's distribution 1 - C^2 is added of these, with the coherent share C; the rest of the slopes has the variance
// s^2/(1 - C).
double interference(double slope, double near_share, double rms_height, double width) {
  const double coherent = std::exp(-std::pow(4 * std::numbers::pi * kFrequency / kSpeed * rms_height, 2));
  const double apart = std::sqrt(2 / (1 - coherent)) * 2 * slope * (1 - near_share), ratio = width / apart;
  const double both =
      std::erf(ratio / std::sqrt(2.0)) - std::sqrt(2 / std::numbers::pi) / ratio * (1 - std::exp(-0.5 * ratio * ratio));
  return (1 - coherent * coherent) * both;
}

class RoughMirrorReturnTest : public testing::TestWithParam<Method> {};

// One beam receives all of it: 3.01 dB more than independent ways from a rough mirror, 10 log10(2 - C^2) from one with
// the coherent share C = e^-g: 2.16 dB for g = 0.524, and nothing from a smooth one.
TEST_P(RoughMirrorReturnTest, OppositeWaysInterfereInOneBeam) {
  constexpr double kUp = 9, kDown = 3, kSlope = 0.05, kLobe = 0.03;
  const double image = 1 / std::pow(2 * (2 * kUp + kDown), 2);
  const auto level = [&](bool rough, double rms_height) {
    const BetweenPlanes found = between_planes(GetParam(), kUp, kDown, kSlope, kLobe, rough, rms_height, 1);
    return 10 * std::log10(found.energy / image);
  };
  EXPECT_NEAR(level(true, 0), 3.01, 0.2);
  EXPECT_NEAR(level(false, 0.12e-3), 2.16, 0.2);
  EXPECT_NEAR(level(false, 1e-6), 0, 0.2);
}

// Where sound that left at a small angle a has been turned by slopes t1 (mirror), t2 (lower plane) and t3 (mirror), it
// is back at the sonar if a L + 2 t1 (L - R1) + 2 t2 (R1 + R2) + 2 t3 R1 = 0, with the whole way L = 2 (R1 + R2). So a
// is Gaussian with the variance s^2 ((1 + c')^2 + c^2) + w^2, c = R1/(R1 + R2) and c' = 1 - c; and the energy is that
// of the image at L whatever the slopes, 1/L^2, and what interference adds.
TEST_P(RoughMirrorReturnTest, SpreadsWhatReturnsOverItTwiceAsIndependentSlopesDo) {
  for (const auto& [up, down] : {std::pair{9.0, 0.5}, std::pair{3.0, 7.0}, std::pair{12.0, 2.0}}) {
    for (const auto& [slope, lobe] : {std::pair{0.05, 0.02}, std::pair{0.03, 0.06}}) {
      const double near = up, across = up + down, near_share = near / (near + across), far_share = 1 - near_share;
      const double variance = slope * slope * (std::pow(1 + far_share, 2) + std::pow(near_share, 2)) + lobe * lobe;
      const double image = 1 / std::pow(2 * (near + across), 2);
      for (const double rms_height : {0.0, 0.12e-3}) {  // Facets alone; and g = 0.52.
        const BetweenPlanes found = between_planes(GetParam(), up, down, slope, lobe, rms_height == 0, rms_height);
        const double added = interference(slope, near_share, rms_height == 0 ? 1e9 : rms_height, kFan / kBeams);
        EXPECT_NEAR(10 * std::log10(found.energy / image), 10 * std::log10(1 + added), 0.2)
            << up << ' ' << slope << ' ' << rms_height;
        EXPECT_NEAR(found.deviation / std::sqrt(variance), 1, 0.04) << up << ' ' << slope << ' ' << rms_height;
      }
    }
  }
}

// The same with the share of each pair of orders: n out and m back, Poisson with the mean g = 4 k^2 h^2, have the
// variances n s^2/g and m s^2/g.
TEST_P(RoughMirrorReturnTest, IsSharpBothWaysWhereItIsCoherent) {
  constexpr double kSlope = 0.04, kLobe = 0.02, kUp = 9, kAcross = 10;
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
