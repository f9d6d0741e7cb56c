// agreement_test.cpp -- every engine against the oracle, which tests every ray against every triangle, on random
// scenes.

#include "engines/agreement.h"

#include <algorithm>
#include <array>

namespace insonify::agreement_test {
namespace {

using namespace testing_scenes;

// Solid angles that surfaces nearer than bin 0 block.
void expect_same_blocked(const EchoGrid& a, const EchoGrid& b, int seed) {
  double apart = 0, sum = 0;
  for (int beam = 0; beam < a.beam_count(); ++beam) {
    apart += std::abs(double{a.met_before(beam)} - double{b.met_before(beam)});
    sum += double{a.met_before(beam)};
  }
  EXPECT_LE(apart, kEnergyTolerance * sum) << "seed " << seed;
}

// Labels must agree except in cells whose two strongest surfaces have nearly the same energy; the order of summation
// decides there.
void expect_same_labels(const EchoGrid& a, const EchoGrid& b, int seed) {
  constexpr double kOtherLabels = 1e-3;  // Share of the cells: single precision moves echoes between neighbouring bins.
  constexpr float kLead = 0.9F;          // The second strongest has at most this share of the strongest.
  int compared = 0, others = 0;
  for (int beam = 0; beam < a.beam_count(); ++beam) {
    for (int bin = 0; bin < a.bin_count(); ++bin) {
      float strongest = 0, second = 0;
      a.for_each_surface(beam, bin, [&](const SurfaceEcho& echo) {
        (strongest == 0 ? strongest : second) = std::max(second, echo.energy);
      });
      if (second < kLead * strongest) {
        ++compared;
        others += a.label(beam, bin).instance != b.label(beam, bin).instance ? 1 : 0;
      }
    }
  }
  EXPECT_LE(others, kOtherLabels * compared + 1) << "seed " << seed;
}

// The elevations that cells have, by the sums over their surfaces. Sums |a - b| are relative to energies times the
// fan's aperture, or its square.
void expect_same_elevations(const EchoGrid& a, const EchoGrid& b, double aperture, int seed) {
  constexpr double kElevationTolerance = 2 * kEnergyTolerance;
  double energy = 0, moments_apart = 0, squares_apart = 0;
  for (int beam = 0; beam < a.beam_count(); ++beam) {
    for (int bin = 0; bin < a.bin_count(); ++bin) {
      SurfaceEcho sum;
      const auto add = [&](const SurfaceEcho& echo, float sign) {
        sum.energy += echo.energy;
        sum.elevation_moment += sign * echo.elevation_moment;
        sum.elevation_square += sign * echo.elevation_square;
      };
      a.for_each_surface(beam, bin, [&](const SurfaceEcho& echo) { add(echo, 1); });
      b.for_each_surface(beam, bin, [&](const SurfaceEcho& echo) { add(echo, -1); });
      energy += 0.5 * double{sum.energy};
      moments_apart += std::abs(double{sum.elevation_moment});
      squares_apart += std::abs(double{sum.elevation_square});
    }
  }
  EXPECT_LE(moments_apart, kElevationTolerance * energy * aperture) << "seed " << seed;
  EXPECT_LE(squares_apart, kElevationTolerance * energy * aperture * aperture) << "seed " << seed;
}

// Two groups of beams of different widths with a gap between them.
// @param first  Share of the aperture that the first group covers, 0..0.9.
BearingGrid groups_with_gap(const SonarConfig& sonar, BeamShape shape, double first) {
  const double aperture = sonar.azimuth_aperture, second = 0.9 - first;
  const int count = sonar.beam_count / 2;
  BearingGrid cells = BearingGrid::even((0.5 - 0.5 * first) * aperture, first * aperture, count);
  cells.add(BearingGrid::even((0.5 * second - 0.5) * aperture, second * aperture, sonar.beam_count - count));
  cells.shape = shape;
  return cells;
}

// Settings of the calibrated model, each in some of the scenes: shapes of beams, gaps between them, arrays across
// bearings and elevations that send, receive or both, ranges that begin beyond some of the objects, and materials whose
// laws are tables over the angle of incidence.
FlatPlanSettings calibrated_settings(RandomScene& random, int seed) {
  SonarConfig& sonar = random.sonar;
  if (seed % 10 > 6) {
    sonar.min_range = 0.3 * sonar.max_range;
  }
  for (std::size_t i = 0; i < random.scene.materials.size(); ++i) {
    Material& material = random.scene.materials[i];
    if (seed % 5 == 1) {
      material.shear_speed = 1200;
    }
    if (seed % 5 == 2 && i % 2 == 0) {
      material.sea_wind = 4 + static_cast<double>(i);  // Scatters more than by its lobe and Lambert's law.
    }
    if (seed % 5 == 3) {
      material.rms_height = 1e-4;
    }
  }
  FlatPlanSettings settings{.sonar = sonar,
                            .model = EchoModel::kCalibrated,
                            .beam_shape = seed % 4 < 2 ? BeamShape::kWedge : BeamShape::kCone,
                            .elevation_array = seed % 8 < 4 ? std::optional<ArraySettings>() : ArraySettings{},
                            .secondary = seed % 2 == 0 ? SecondaryEchoes::kAll : SecondaryEchoes::kSelective,
                            .rough_mirrors = seed % 3 == 0,
                            .seed = static_cast<std::uint64_t>(seed)};
  if (seed % 8 > 5) {
    settings.sent_across = ElevationWay{ArraySettings{}, 0.5 * sonar.elevation_aperture};
  }
  if (seed % 6 == 5) {
    settings.cells = groups_with_gap(sonar, settings.beam_shape, seed % 12 == 5 ? 0.6 : 0.3);
    settings.columns_per_cell = 3;
  }
  if (seed % 11 == 4) {
    settings.max_surfaces = 2;
  }
  if (seed % 7 == 3) {  // One array sends and receives.
    for (int beam = 0; beam < sonar.beam_count; ++beam) {
      settings.array_gains.push_back(0.1F + 0.9F * static_cast<float>(beam) / static_cast<float>(sonar.beam_count));
    }
  } else if (seed % 7 == 5) {
    settings.sonar.transmit_width = 0.8 * sonar.azimuth_aperture;
  }
  return settings;
}

EchoGrid full_echoes_of(const std::string& engine, const Scene& scene, const FlatPlanSettings& settings,
                        const Pose& world_from_sonar) {
  const auto tested = test_engine(engine);
  tested->set_scene(scene);
  EchoGrid grid(settings.sonar.beam_count, settings.sonar.bin_count, kPathOrders, GroundTruth::kFull);
  tested->insonify(*make_flat_plan(settings), world_from_sonar, grid);
  return grid;
}

// At most this fraction of the samples may hit another surface: for rays through a shared edge either is right.
constexpr double kOtherSurface = 1e-5;

// Traces the rays of the lattice by Engine::trace, to compare hit by hit.
std::vector<Ray> lattice_rays(const RandomScene& random) {
  std::vector<Ray> rays;
  for (int column = 0; column < random.sonar.beam_count * *random.sonar.sampling.columns_per_beam; ++column) {
    for (int row = 0; row < *random.sonar.sampling.rows; ++row) {
      const double azimuth =
          random.sonar.azimuth_aperture *
          (0.5 - (column + 0.5) / (random.sonar.beam_count * *random.sonar.sampling.columns_per_beam));
      const double elevation = random.sonar.elevation_center +
                               random.sonar.elevation_aperture * ((row + 0.5) / *random.sonar.sampling.rows - 0.5);
      rays.push_back({random.pose.position, random.pose.orientation * point_from_spherical({1, azimuth, elevation}), 0,
                      random.sonar.max_range});
    }
  }
  return rays;
}

class EngineAgreementTest : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Engines, EngineAgreementTest, testing::ValuesIn(engines_to_compare()),
                         [](const auto& test) { return test.param; });

TEST_P(EngineAgreementTest, HitsTheSurfacesThatTheReferenceHits) {
  double samples = 0, other = 0, range_apart = 0, hits_compared = 0;
  for (int seed = 0; seed < kScenes; ++seed) {
    const RandomScene random(seed);
    const auto engine = test_engine(GetParam(), 2);
    const auto reference = test_engine("reference", 2);
    engine->set_scene(random.scene);
    reference->set_scene(random.scene);
    const std::vector<Ray> rays = lattice_rays(random);
    std::vector<Hit> a(rays.size()), b(rays.size());
    engine->trace(rays, a);
    reference->trace(rays, b);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      ++samples;
      if (a[i].instance != b[i].instance) {
        ++other;
      } else if (a[i].instance != kNoLabel) {
        ++hits_compared;
        range_apart += std::abs(a[i].distance - b[i].distance);
      }
    }
  }
  EXPECT_GT(hits_compared, 0.3 * samples);
  EXPECT_LE(other, kOtherSurface * samples);
  EXPECT_LE(range_apart / hits_compared, 1e-5);
}

TEST_P(EngineAgreementTest, GivesTheEchoesOfTheReference) {
  for (int seed = 0; seed < kScenes; ++seed) {
    const RandomScene random(seed);
    const FlatPlanSettings settings{.sonar = random.sonar,
                                    .secondary = seed % 2 == 0 ? SecondaryEchoes::kAll : SecondaryEchoes::kSelective,
                                    .seed = static_cast<std::uint64_t>(seed)};
    const EchoGrid echoes = echoes_of(GetParam(), random.scene, settings, random.pose);
    const EchoGrid reference = echoes_of("reference", random.scene, settings, random.pose);
    expect_agreement(reference, echoes, seed);
    expect_same_labels(reference, echoes, seed);
  }
}

TEST_P(EngineAgreementTest, GivesTheCalibratedEchoesOfTheReference) {
  for (int seed = 0; seed < kScenes; ++seed) {
    RandomScene random(seed);
    FlatPlanSettings settings = calibrated_settings(random, seed);
    settings.materials = random.scene.materials;
    const EchoGrid echoes = full_echoes_of(GetParam(), random.scene, settings, random.pose);
    const EchoGrid reference = full_echoes_of("reference", random.scene, settings, random.pose);
    expect_agreement(reference, echoes, seed);
    expect_same_labels(reference, echoes, seed);
    expect_same_elevations(reference, echoes, settings.sonar.elevation_aperture, seed);
    expect_same_blocked(reference, echoes, seed);
  }
}

// A sphere before two beams: across the gap between them its normals turn by far more than within a beam.
TEST_P(EngineAgreementTest, NormalsOfDifferentGroupsOfBeamsAreNotCompared) {
  SonarConfig sonar;
  sonar.beam_count = 2;
  sonar.bin_count = 100;
  sonar.max_range = 10;
  sonar.elevation_aperture = radians_from_degrees(20);
  sonar.sampling = {.columns_per_beam = 2, .rows = 40};
  const Scene scene = SceneMaker().add_sphere({6, 0.1, 0.2}, 1.2, 0.8, 0.05).scene();
  for (const int columns : {1, 2}) {
    FlatPlanSettings settings{.sonar = sonar,
                              .columns_per_cell = columns,
                              .model = EchoModel::kCalibrated,
                              .materials = scene.materials,
                              .secondary = SecondaryEchoes::kNone};
    for (const double port_edge : {8, -2}) {
      settings.cells.add(radians_from_degrees(port_edge - 3), radians_from_degrees(port_edge),
                         radians_from_degrees(port_edge - 6));
    }
    const EchoGrid reference = echoes_of("reference", scene, settings);
    EXPECT_GT(total(reference, 1), 0);
    expect_agreement(reference, echoes_of(GetParam(), scene, settings), columns);
  }
}

// Calm, so that the surface mirrors all that it meets, and with waves, whose facets return echoes by many paths.
TEST_P(EngineAgreementTest, GivesTheEchoesOfTheReferenceUnderASea) {
  for (int seed = 0; seed < kScenes; ++seed) {
    RandomScene random(seed);
    const double wind_speed = seed % 4 == 0 ? 0 : 0.3 * (seed % 8);
    add_sea(random.scene, random.pose.position + Vec3(0, 0, 1 + 0.05 * seed), wind_speed, random.sonar.frequency);
    const FlatPlanSettings settings{.sonar = random.sonar,
                                    .model = EchoModel::kCalibrated,
                                    .materials = random.scene.materials,
                                    .beam_shape = seed % 4 < 2 ? BeamShape::kWedge : BeamShape::kCone,
                                    .secondary = seed % 2 == 0 ? SecondaryEchoes::kAll : SecondaryEchoes::kSelective,
                                    .rough_mirrors = seed % 5 == 0,
                                    .seed = static_cast<std::uint64_t>(seed)};
    const EchoGrid echoes = echoes_of(GetParam(), random.scene, settings, random.pose);
    const EchoGrid reference = echoes_of("reference", random.scene, settings, random.pose);
    expect_agreement(reference, echoes, seed);
    expect_same_labels(reference, echoes, seed);
  }
}

// Bodies and bed behind and within plates and nets; those of every third scene have none, and some are opaque.
TEST_P(EngineAgreementTest, SeesThroughSurfacesAsTheReferenceDoes) {
  for (int seed = 0; seed < kScenes; seed += 2) {
    RandomScene random(seed);
    let_sound_through(random.scene);
    if (seed % 10 == 4) {
      random.sonar.min_range = 0.4 * random.sonar.max_range;  // Beyond some of the surfaces.
    }
    const FlatPlanSettings settings{.sonar = random.sonar,
                                    .model = EchoModel::kCalibrated,
                                    .materials = random.scene.materials,
                                    .beam_shape = seed % 4 < 2 ? BeamShape::kWedge : BeamShape::kCone,
                                    .elevation_array = seed % 8 < 4 ? std::optional<ArraySettings>() : ArraySettings{},
                                    .secondary = seed % 6 < 4 ? SecondaryEchoes::kNone : SecondaryEchoes::kSelective,
                                    .seed = static_cast<std::uint64_t>(seed)};
    const EchoGrid echoes = echoes_of(GetParam(), random.scene, settings, random.pose);
    const EchoGrid reference = echoes_of("reference", random.scene, settings, random.pose);
    expect_agreement(reference, echoes, seed);
    expect_same_labels(reference, echoes, seed);
    expect_same_blocked(reference, echoes, seed);
  }
}

TEST_P(EngineAgreementTest, MovesInstancesAsTheReferenceDoes) {
  for (int seed = 0; seed < 20; ++seed) {
    const RandomScene random(seed);
    const FlatPlanSettings settings{.sonar = random.sonar,
                                    .secondary = seed % 2 == 0 ? SecondaryEchoes::kAll : SecondaryEchoes::kSelective};
    const auto tested = test_engine(GetParam(), 2);
    const auto reference = test_engine("reference", 2);
    for (TestEngine* engine : {tested.get(), reference.get()}) {
      engine->set_scene(random.scene);
      random.move_all([&](int instance, const Pose& pose) { engine->move_instance(instance, pose); });
    }
    const EchoGrid a = echoes_of(*reference, settings, random.pose);
    const EchoGrid b = echoes_of(*tested, settings, random.pose);
    expect_agreement(a, b, seed);
  }
}

// Fills the stack below this frame with ones, which the next function called then finds in its uninitialised memory.
[[gnu::noinline]] void fill_stack() {
  std::array<volatile unsigned char, 200'000> bytes;
  for (volatile unsigned char& byte : bytes) {
    byte = 0xff;
  }
}

// See CpuScene::occlude(): with coherent packets this call never returned where Embree is compiled for and uses
// AVX-512.
TEST(CpuEngineTest, ReturnLegsAmongMovingInstancesEndWhateverTheStackHolds) {
  const RandomScene random(4);
  ASSERT_TRUE(std::ranges::any_of(random.scene.instances, &Instance::moving));
  const auto engine = test_engine("cpu", 1);
  engine->set_scene(random.scene);
  const FlatPlanSettings settings{.sonar = random.sonar, .secondary = SecondaryEchoes::kAll};
  fill_stack();
  echoes_of(*engine, settings, random.pose);
  EXPECT_GT(engine->ray_counts().return_legs, 0U);
}

}  // namespace
}  // namespace insonify::agreement_test
