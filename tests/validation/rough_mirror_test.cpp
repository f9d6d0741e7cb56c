// rough_mirror_test.cpp -- reflection by the randomly tilted facets of a rough mirror.

#include "echo/mirror/mirror_paths.h"
#include "echo/model/mirror_facet.h"
#include "insonify/error.h"
#include "validation/secondary_grid.h"

namespace insonify::validation::rough_mirror_test {
namespace {

// The two slopes of a facet are independent standard normal numbers, in every block of the lattice.
TEST(FacetSlopesTest, AreNormalAndIndependent) {
  for (const int size : {16, 128}) {
    double sum[2] = {}, squares[2] = {}, both = 0, within = 0;
    for (int column = 100; column < 100 + size; ++column) {
      for (int row = 30; row < 30 + size; ++row) {
        const FacetSlopes slopes = FacetSlopes::of(column, row, 12345);
        const double pair[] = {slopes.along, slopes.across};
        for (int i = 0; i < 2; ++i) {
          sum[i] += pair[i];
          squares[i] += pair[i] * pair[i];
          within += std::abs(pair[i]) < 1 ? 0.5 : 0;
        }
        both += pair[0] * pair[1];
      }
    }
    const double count = size * size, tolerance = 1.0 / size;
    for (int i = 0; i < 2; ++i) {
      EXPECT_NEAR(sum[i] / count, 0, tolerance) << size;
      EXPECT_NEAR(squares[i] / count, 1, 2 * tolerance) << size;
    }
    EXPECT_NEAR(both / count, 0, tolerance) << size;
    EXPECT_NEAR(within / count, 0.6827, tolerance) << size;
  }
}

// The mean share is the fraction of the incident energy that facets reflect away from the mirror; the rest is reflected
// into it. Reference values: quadrature over slopes with Smith's exact masking function (Smith, IEEE Trans. AP-15, 668
// (1967)), computed independently.
TEST(MirrorFacetTest, SharesSumToTheReflectedFraction) {
  struct Case {
    double slope, grazing_deg, reflected;
  };
  for (const Case& c : {Case{0.02, 5, 0.9939}, Case{0.02, 40, 1}, Case{0.1, 5, 0.9665}, Case{0.1, 15, 0.9670},
                        Case{0.1, 90, 1}, Case{0.3, 5, 0.9911}, Case{0.3, 15, 0.9579}, Case{0.3, 40, 0.9412}}) {
    const double grazing = c.grazing_deg * kDegree;
    const Triple direction{static_cast<float>(std::cos(grazing)), 0, static_cast<float>(-std::sin(grazing))};
    double sum = 0;
    constexpr int kSide = 300;
    for (int i = 0; i < kSide * kSide; ++i) {
      const FacetSlopes slopes = FacetSlopes::of(i / kSide, i % kSide, 7);
      const MirrorFacet facet = mirror_facet(direction, {0, 0, 1}, {}, static_cast<float>(c.slope), slopes);
      sum += facet.share;
      ASSERT_NEAR(facet.normal.dot(facet.normal), 1, 1e-5);
    }
    EXPECT_NEAR(sum / (kSide * kSide), c.reflected, 0.01) << c.slope << ", " << c.grazing_deg;
  }
}

// Reference values: e^-g with g = 4 k^2 h^2 cos^2 (Brekhovskikh and Lysanov, ch. 9) and c = 1500 m/s, by hand: at 720
// kHz k is 3015.9 per m, so that 0.1 mm at normal incidence has g = 0.36383 and 1.5801 dB.
TEST(FacetSlopeTest, ReflectsTheCoherentShareAsASmoothMirror) {
  struct Case {
    double frequency, height, incidence_deg, loss_db;
  };
  for (const Case& c :
       {Case{720e3, 0.1e-3, 0, 1.5801}, Case{720e3, 0.3e-3, 0, 14.2210}, Case{720e3, 0.3e-3, 60, 3.5552},
        Case{375e3, 0.3e-3, 0, 3.8577}, Case{1200e3, 0.1e-3, 30, 3.2919}, Case{100e3, 2e-3, 75, 0.8167}}) {
    Material material = glinting(1, 0.1);
    material.rms_height = c.height;
    const auto roughness = static_cast<float>(material.scattering(c.frequency).roughness);
    constexpr int kPicks = 200000;
    int smooth = 0;
    for (int i = 0; i < kPicks; ++i) {
      const float pick = (static_cast<float>(i) + 0.5F) / kPicks;
      smooth += facet_slope(0.1F, roughness, static_cast<float>(std::cos(c.incidence_deg * kDegree)), pick) == 0;
    }
    EXPECT_NEAR(-10 * std::log10(static_cast<double>(smooth) / kPicks), c.loss_db, 0.002) << c.height;
  }
}

// The variance of all orders together is that of the roughness, whatever its height; above g = 8 of every order. Orders
// beyond the last of sixteen have 0.4 % of the energy, and count as the last.
TEST(FacetSlopeTest, VariancesSumToThatOfTheRoughness) {
  for (const float g : {0.02F, 0.4F, 2.0F, 7.9F, 8.1F, 300.0F}) {
    constexpr int kPicks = 200000;
    double sum = 0;
    for (int i = 0; i < kPicks; ++i) {
      const float slope = facet_slope(0.05F, 4 * g, 0.5F, (static_cast<float>(i) + 0.5F) / kPicks);
      sum += slope * slope;
    }
    EXPECT_NEAR(sum / kPicks / (0.05 * 0.05), 1, 0.005) << g;
  }
  EXPECT_EQ(facet_slope(0.05F, 0, 1, 0.999F), 0);
  EXPECT_EQ(facet_slope(0.05F, kAllRough, 0.3F, 1e-4F), 0.05F);
}

// Engines differ in the sign of zero components of normals; it must not matter.
TEST(MirrorFacetTest, TheSignOfZeroDoesNotMatter) {
  const Triple direction{0.8F, 0.6F, 0};
  const MirrorFacet a = mirror_facet(direction, {-1, 0, 0.0F}, {}, 0.1F, {0.7F, -0.4F});
  const MirrorFacet b = mirror_facet(direction, {-1, 0, -0.0F}, {}, 0.1F, {0.7F, -0.4F});
  EXPECT_EQ(a.share, b.share);
  EXPECT_EQ(a.normal.y, b.normal.y);
  EXPECT_EQ(a.normal.z, b.normal.z);
}

// A relief that slopes away from the sonar, on a level bed at 10 degrees of grazing. Rays that leave the tilted surface
// but would go below the bed are not reflected.
TEST(MirrorFacetTest, NothingIsReflectedThroughASurfaceWithRelief) {
  const auto degrees = [](double angle) { return static_cast<float>(angle * kDegree); };
  const Triple direction{std::cos(degrees(10)), 0, -std::sin(degrees(10))};
  const float away = std::tan(degrees(3)), scale = 1 / std::sqrt(1 + away * away);
  const Triple bent{scale * away, 0, scale};  // (0, 0, 1) less the gradient, normalised.
  const Triple gradient{-away, 0, 0};
  int reflected = 0;
  for (int row = 0; row < 4000; ++row) {
    const MirrorFacet facet = mirror_facet(direction, bent, gradient, 0.05F, FacetSlopes::of(1, row, 3));
    if (facet.share > 0) {
      ++reflected;
      EXPECT_GT(direction.z - 2 * direction.dot(facet.normal) * facet.normal.z, -1e-6F);
    }
  }
  EXPECT_GT(reflected, 2000);
  EXPECT_LT(reflected, 4000);
}

// A path that meets the mirror on the way out and back meets the same facet: its share counts once.
TEST(MirrorFacetTest, ShareCountsOnceForBothWays) {
  Material material = diffuse(-10);
  const ScatterTable scatter(std::span(&material, 1), 720e3);
  MirrorPaths paths = {};
  std::ranges::fill(paths.surface, surface_label(0, 0));
  for (int lane = 0; lane < kPathLanes; ++lane) {
    paths.reflectance[lane] = paths.spread[lane] = paths.texture[lane] = 1;
    paths.there[lane] = paths.back[lane] = 5;
    paths.in[lane] = paths.out[lane] = paths.half[lane] = 1;
    paths.returned[lane] = 1;
    paths.share[lane] = lane == 0 ? 1.0F : 0.5F;
  }
  MirrorPowers powers;
  fill_mirror_powers(scatter, 0, paths, powers);
  ASSERT_GT(powers.twice[0], 0);
  EXPECT_FLOAT_EQ(powers.once[1], 0.5F * powers.once[0]);
  EXPECT_FLOAT_EQ(powers.twice[1], 0.5F * powers.twice[0]);
}

// The side to which the surface normal points does not matter, and the tangent frame is valid for all directions.
TEST(MirrorFacetTest, FacesTheSideOfTheSound) {
  for (const Triple& normal : {Triple{0, 0, 1}, Triple{0, 0, -1}, Triple{1, 0, 0}, Triple{0, -1, 0}}) {
    for (const float side : {1.0F, -1.0F}) {
      const MirrorFacet facet = mirror_facet(-1 * normal, side * normal, {}, 0.1F, {0.5F, -0.3F});
      EXPECT_NEAR(facet.normal.dot(normal), 1 / std::sqrt(1 + 0.01F * (0.25F + 0.09F)), 1e-6F);
      EXPECT_GT(facet.share, 0);
    }
  }
}

// The ghost of a sphere in a floor, in a vertical fan.
struct Ghost {
  double energy = 0;               // Energy of path order 2 from the mirror's side.
  double mean = 0, deviation = 0;  // Mean and standard deviation of its elevation [deg].
  double both_ways = 0;            // Energy of path order 3.
  double sharp = 0;                // Share of `energy` within kSharp of the image's elevation.
};

constexpr double kSharp = 2;  // [deg]

// @param height  Height of the sonar above the floor; that of the sphere is 10 m - height.
Ghost ghost_in(const Method& method, double rms_slope, bool rough, double height = 5, double rms_height = 0) {
  Scene scene = sphere_at({10, 0, 10 - 2 * height}, 0.3, diffuse(-10));
  Material mirror = glinting(1, rms_slope);
  mirror.rms_height = rms_height;
  const Scene floor = scene_of(make_plane(Vec3::UnitZ(), 60, 60), mirror, {.position = {5, 0, -height}});
  scene.materials.push_back(floor.materials.front());
  scene.instances.push_back(floor.instances.front());
  scene.instances.back().materials.assign(scene.instances.back().materials.size(), 1);

  SonarConfig sonar;
  sonar.beam_count = 300;
  sonar.azimuth_aperture = 150 * kDegree;
  sonar.elevation_aperture = 40 * kDegree;
  sonar.min_range = 1;
  sonar.max_range = 20;
  sonar.bin_count = 200;
  sonar.sampling = {8, 400};
  const Pose on_its_side{.orientation = orientation_from_rpy(90 * kDegree, 0, 0)};
  const EchoGrid grid = secondary_grid(method, scene, sonar, on_its_side, {.rough_mirrors = rough});
  Ghost ghost;
  double squares = 0;
  for (int beam = 0; beam < sonar.beam_count; ++beam) {
    const double elevation = sonar.beam_azimuth(beam) / kDegree;  // Port is up.
    for (const float energy : grid.energy(2, beam)) {
      if (elevation < -25) {  // The reciprocal path arrives from the sphere itself.
        ghost.energy += energy;
        ghost.mean += energy * elevation;
        ghost.sharp += std::abs(elevation + 45) < kSharp ? energy : 0;
        squares += energy * elevation * elevation;
      }
    }
    for (const float energy : grid.energy(3, beam)) {
      ghost.both_ways += energy;
    }
  }
  ghost.sharp /= ghost.energy;
  ghost.mean /= ghost.energy;
  ghost.deviation = std::sqrt(squares / ghost.energy - ghost.mean * ghost.mean);
  return ghost;
}

class RoughMirrorTest : public testing::TestWithParam<Method> {};

// A facet tilted by t shifts the direction of the image by 2 t R2 / (R1 + R2), with R1 the distance to the mirror and
// R2 from there to the target. Random tilts widen the image by that (a glitter path) and do not change its energy.
TEST_P(RoughMirrorTest, SpreadsTheImageInProportionToItsSlopes) {
  for (const double height : {3.0, 5.0, 7.0}) {
    const Ghost smooth = ghost_in(GetParam(), 0.05, false, height);
    EXPECT_NEAR(smooth.mean, -45, 0.7) << height;
    EXPECT_LT(smooth.deviation, 1) << height;
    const double reflected = 2 * (10 - height) / 10;
    for (const double slope : {0.03, 0.05}) {
      const Ghost rough = ghost_in(GetParam(), slope, true, height);
      const double added = std::sqrt(rough.deviation * rough.deviation - smooth.deviation * smooth.deviation) * kDegree;
      EXPECT_NEAR(added / (reflected * slope), 1, 0.1) << slope << ", " << height;
      EXPECT_NEAR(rough.mean, -45, 1.2) << slope << ", " << height;
      EXPECT_NEAR(10 * std::log10(rough.energy / smooth.energy), 0, 0.3) << slope << ", " << height;
      EXPECT_NEAR(10 * std::log10(rough.both_ways / smooth.both_ways), 0, 0.3) << slope << ", " << height;
    }
  }
}

TEST_P(RoughMirrorTest, WithoutSlopesIsSmooth) {
  const Ghost smooth = ghost_in(GetParam(), 1e-4, false), rough = ghost_in(GetParam(), 1e-4, true);
  EXPECT_NEAR(rough.energy / smooth.energy, 1, 0.01);
  EXPECT_NEAR(rough.deviation, smooth.deviation, 0.01);
}

// A mirror of a small roughness has a sharp image with the coherent share of the energy, over a wide one that holds the
// rest: orders n of a Poisson distribution, each a Gaussian of 2 R2/(R1 + R2) s sqrt(n/g) = s sqrt(n/g) here, where R1
// = R2. Incidence is at 45 degrees: g = 2 k^2 h^2.
TEST_P(RoughMirrorTest, ImageOfASmallRoughnessIsSharpAndWide) {
  constexpr double kSlope = 0.06, kFrequency = 720e3;
  for (const double height : {0.05e-3, 0.1e-3, 0.2e-3}) {
    const double wavenumber = 2 * kDegree * 180 * kFrequency / 1500;
    const double g = 2 * std::pow(wavenumber * height, 2);
    double sharp = 0, share = std::exp(-g);
    for (int n = 0; n < 40; ++n) {
      const double deviation = kSlope * std::sqrt(n / g);
      sharp += share * (n == 0 ? 1 : std::erf(kSharp * kDegree / (std::sqrt(2) * deviation)));
      share *= g / (n + 1);
    }
    const Ghost ghost = ghost_in(GetParam(), kSlope, false, 5, height), smooth = ghost_in(GetParam(), kSlope, false);
    EXPECT_NEAR(ghost.sharp, sharp, 0.05) << height;
    EXPECT_NEAR(10 * std::log10(ghost.energy / smooth.energy), 0, 0.3) << height;
    EXPECT_NEAR(10 * std::log10(ghost.both_ways / smooth.both_ways), 0, 0.3) << height;
  }
}

// The facets of a wide lobe are no mirror: the image is sharp, and has the coherent share alone, twice where both ways
// are by the mirror.
TEST_P(RoughMirrorTest, WideFacetsLeaveTheCoherentShare) {
  constexpr double kSlope = 0.3, kFrequency = 720e3;
  const Ghost smooth = ghost_in(GetParam(), kSlope, false);
  for (const double height : {0.07e-3, 0.15e-3, 0.25e-3}) {
    const double g = 2 * std::pow(2 * kDegree * 180 * kFrequency / 1500 * height, 2);
    const Ghost ghost = ghost_in(GetParam(), kSlope, false, 5, height);
    EXPECT_GT(ghost.sharp, 0.98) << height;
    EXPECT_NEAR(10 * std::log10(ghost.energy / smooth.energy), -10 * std::log10(std::exp(g)), 0.2) << height;
    EXPECT_NEAR(10 * std::log10(ghost.both_ways / smooth.both_ways), -20 * std::log10(std::exp(g)), 0.3) << height;
  }
  EXPECT_EQ(ghost_in(GetParam(), kSlope, false, 5, 2e-3).energy, 0);
  EXPECT_GT(ghost_in(GetParam(), kSlope, true, 5, 2e-3).energy, 0.5 * smooth.energy);
}

// A sonar between two parallel planes looks up at the upper one, a mirror with facets of the slope s; the lower one has
// a lobe of the slope w. Order 3 is the path over the mirror, the lower plane and the mirror again.
struct BetweenPlanes {
  double energy = 0, deviation = 0;  // Of path order 3: its sum, and the standard deviation of its azimuth [rad].
  double sharp = 0;                  // Its share within kNear of straight up.
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

// Where sound that left at a small angle a has been turned by slopes t1 (mirror), t2 (lower plane) and t3 (mirror), it
// is back at the sonar if a L + 2 t1 (L - R1) + 2 t2 (R1 + R2) + 2 t3 R1 = 0, with the whole way L = 2 (R1 + R2). So a
// is Gaussian with the variance s^2 ((1 + c')^2 + c^2) + w^2, c = R1/(R1 + R2) and c' = 1 - c; and the energy is that
// of the image at L whatever the slopes, 1/L^2.
TEST_P(RoughMirrorTest, SpreadsWhatReturnsOverItTwiceAsIndependentSlopesDo) {
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
TEST_P(RoughMirrorTest, IsSharpBothWaysWhereItIsCoherent) {
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

// From scenario to ping: ghosts in a windy sea are wider.
TEST(RoughMirrorScenarioTest, WidensTheGhostsOfAWindySea) {
  Scene scene = sphere_at({8, 0, -3}, 0.3, diffuse(-10));
  Scenario scenario;
  scenario.water.absorption = false;
  scenario.receiver.noise = scenario.receiver.speckle = false;
  scenario.secondary = SecondaryEchoes::kAll;
  SonarConfig sonar;
  sonar.name = "upright";
  sonar.azimuth_aperture = 120 * kDegree;
  sonar.position = {0, 0, -3};
  sonar.orientation = {90 * kDegree, 0, 0};
  sonar.max_range = 12;
  scenario.sonars = {sonar};
  double deviation[2] = {};
  for (const bool rough : {false, true}) {
    scenario.surface = SeaSurface{.level = 0, .wind_speed = rough ? 3.0 : 0.0};
    const Ping ping = Simulator(scenario, scene, 2).make_ping(0, 0);
    double sum = 0, moment = 0, squares = 0;
    for (int beam = 0; beam < ping.beam_count; ++beam) {
      const double elevation = sonar.beam_azimuth(beam) / kDegree;
      for (int bin = 0; bin < ping.bin_count; ++bin) {
        const double range = sonar.bin_range(bin);
        if (elevation > 20 && range > 8.3) {  // Excludes the direct echo of the surface, which is nearer.
          const double intensity = ping.intensity[ping.index(bin, beam)];
          sum += intensity;
          moment += intensity * elevation;
          squares += intensity * elevation * elevation;
        }
      }
    }
    deviation[rough ? 1 : 0] = std::sqrt(squares / sum - moment * moment / (sum * sum));
  }
  EXPECT_GT(deviation[1], 3 * deviation[0]);

  scenario.model = EchoModel::kPaper;
  scenario.rough_mirrors = true;
  scenario.surface.reset();
  EXPECT_THROW(scenario.validate(), Error);
}

// A plate of bare steel that leans back below the waves: sound goes from it to the surface and back over it. What the
// sea scatters less than its facets' lobe was taken off a lobe of another width, which left less than nothing.
TEST(RoughMirrorScenarioTest, PlatesUnderAWindySeaHaveFiniteEchoes) {
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

INSTANTIATE_TEST_SUITE_P(Methods, RoughMirrorTest, testing::Values(kRays, kRaster),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace insonify::validation::rough_mirror_test
